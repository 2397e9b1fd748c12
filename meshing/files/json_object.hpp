// SPDX-License-Identifier: GPL-3.0-or-later
// For sources only: no public header names a JSON type.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace millfoam {

/// A JSON file that cannot be what it must be. The message names the file, the key, its value, and what was
/// expected.
class JsonError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// What JsonObject reads as a Value: bool, whole and other numbers, std::string, and lists (std::vector,
/// std::array), tables (std::map by std::string) and std::optional (null) of these. `is` tells whether a
/// value is one, `words` is one or many of them in messages.
template <typename Value>
struct JsonKind {
  static constexpr bool is_truth = std::is_same_v<Value, bool>;
  static constexpr bool is_number = std::is_arithmetic_v<Value>;
  static_assert(is_number || std::is_same_v<Value, std::string>);
  static bool is(const nlohmann::json& json) {
    if (is_truth) return json.is_boolean();
    if (is_number) return std::is_integral_v<Value> ? json.is_number_integer() : json.is_number();
    return json.is_string();
  }
  static std::string words(bool many = false) {
    if (is_truth) return "true or false";
    const std::string name = !is_number ? "text" : std::is_integral_v<Value> ? "whole number" : "number";
    return many ? name + 's' : is_number ? "a " + name : name;
  }
};

template <typename Value>
struct JsonKind<std::optional<Value>> {
  static bool is(const nlohmann::json& json) { return json.is_null() || JsonKind<Value>::is(json); }
  static std::string words(bool many = false) { return JsonKind<Value>::words(many) + " or null"; }
};

template <typename Value>
struct JsonKind<std::vector<Value>> {
  static bool is(const nlohmann::json& json) {
    return json.is_array() && std::all_of(json.begin(), json.end(), JsonKind<Value>::is);
  }
  static std::string words(bool many = false) {
    return (many ? "lists of " : "a list of ") + JsonKind<Value>::words(true);
  }
};

template <typename Value, std::size_t size>
struct JsonKind<std::array<Value, size>> {
  static bool is(const nlohmann::json& json) {
    return JsonKind<std::vector<Value>>::is(json) && json.size() == size;
  }
  static std::string words(bool many = false) {
    return (many ? "lists of " : "a list of ") + std::to_string(size) + ' ' + JsonKind<Value>::words(true);
  }
};

template <typename Value>
struct JsonKind<std::map<std::string, Value>> {
  static bool is(const nlohmann::json& json) {
    return json.is_object() && std::all_of(json.begin(), json.end(), JsonKind<Value>::is);
  }
  static std::string words(bool many = false) {
    return (many ? "objects of " : "an object of ") + JsonKind<Value>::words(true);
  }
};

/// An object of a JSON file that a program has written. A key with null is as one that is not there.
class JsonObject {
 public:
  /// The whole of a file; nothing where it cannot be opened.
  /// @param file  its name
  /// @param advice  ends every message, for example ": run millDem again"
  ///
  /// Throws JsonError, with the line, for a text that is not JSON or no object.
  static std::optional<JsonObject> read(const std::filesystem::path& file, const std::string& advice = "");

  /// The same of a file's text.
  JsonObject(const std::string& text, const std::filesystem::path& file, const std::string& advice = "");

  /// The whole of a file; nothing where it cannot be opened or is not an object whose "format" is this.
  static std::optional<JsonObject> of_format(const std::filesystem::path& file, const std::string& format);

  /// Throws JsonError unless the key "format" is this.
  void require_format(const std::string& format) const;

  /// The value of a key; nothing without it. Throws JsonError for one of another kind.
  template <typename Value>
  std::optional<Value> find(const std::string& key) const {
    return find<Value>(key, JsonKind<Value>::words(), [](const Value&) { return true; });
  }

  /// The same of values that `allowed` accepts, which are `expected` in words. Throws JsonError for any
  /// other.
  template <typename Value, typename Allowed>
  std::optional<Value> find(const std::string& key, const std::string& expected,
                            const Allowed& allowed) const {
    const nlohmann::json* json = json_of(key);
    if (json == nullptr) return std::nullopt;
    if (!JsonKind<Value>::is(*json) || !allowed(json->get<Value>())) refuse(key, expected);
    return json->get<Value>();
  }

  /// The value of a key. Throws JsonError without it, and for one of another kind.
  template <typename Value>
  Value get(const std::string& key) const {
    if (auto value = find<Value>(key)) return *value;
    refuse(key, JsonKind<Value>::words());
  }

  /// Whether the key is there, if only with null.
  bool contains(const std::string& key) const { return json_.contains(key); }

  /// The object of a key, whose keys messages name as "key.theirs". `find_object` gives nothing without it.
  /// Throw JsonError for what is no object, `object` also without the key.
  JsonObject object(const std::string& key) const;
  std::optional<JsonObject> find_object(const std::string& key) const;

  /// The objects of the list of a key, whose keys messages name as "key[0].theirs". Throws JsonError without
  /// it, and for any other list.
  std::vector<JsonObject> objects(const std::string& key) const;

  /// Throws JsonError: "file: key 'key' is VALUE, expected EXPECTED", or that it is missing, and the advice.
  [[noreturn]] void refuse(const std::string& key, const std::string& expected) const;

 private:
  JsonObject(const JsonObject& parent, const std::string& place, const nlohmann::json& json);
  const nlohmann::json* json_of(const std::string& key) const;

  std::string file_;
  std::string advice_;
  std::string place_;  ///< what goes before a key in messages: empty, or "mill."
  nlohmann::json json_;
};

}  // namespace millfoam

/// For nlohmann's JSON: null is nothing.
template <typename Value>
struct nlohmann::adl_serializer<std::optional<Value>> {
  template <typename Json>
  static void from_json(const Json& json, std::optional<Value>& value) {
    value = json.is_null() ? std::nullopt : std::optional<Value>(json.template get<Value>());
  }
  template <typename Json>
  static void to_json(Json& json, const std::optional<Value>& value) {
    json = value ? Json(*value) : Json();
  }
};
