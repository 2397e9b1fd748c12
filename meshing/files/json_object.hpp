// SPDX-License-Identifier: GPL-3.0-or-later
// For sources only: no public header names a JSON type.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
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

/// Whether a JSON value is a whole number that an integral type has.
template <typename Integer>
bool is_whole_number(const nlohmann::json& json) {
  using Limits = std::numeric_limits<Integer>;
  if (json.is_number_unsigned())
    return json.get<std::uint64_t>() <= static_cast<std::uint64_t>(Limits::max());
  return json.is_number_integer() && json.get<std::int64_t>() >= static_cast<std::int64_t>(Limits::min());
}

/// What JsonObject reads as a Value: bool, whole and other numbers, std::string, and lists (std::vector,
/// std::array), tables (std::map by std::string) and std::optional (null) of these.
template <typename Value>
struct JsonKind {
  /// Whether a JSON value is a Value.
  static bool is(const nlohmann::json& json) {
    if constexpr (std::is_same_v<Value, bool>) {
      return json.is_boolean();
    } else if constexpr (std::is_integral_v<Value>) {
      return is_whole_number<Value>(json);
    } else if constexpr (std::is_arithmetic_v<Value>) {
      return json.is_number();
    } else {
      static_assert(std::is_same_v<Value, std::string>);
      return json.is_string();
    }
  }

  /// One Value, or many of them, in messages.
  static std::string words(bool many = false) {
    if (std::is_same_v<Value, bool>) return many ? "values true or false" : "true or false";
    if (!std::is_arithmetic_v<Value>) return many ? "texts" : "text";
    const std::string name = std::is_integral_v<Value> ? "whole number" : "number";
    return many ? name + 's' : "a " + name;
  }
};

/// JsonKind of null or a Value.
template <typename Value>
struct JsonKind<std::optional<Value>> {
  /// Whether a JSON value is null or a Value.
  static bool is(const nlohmann::json& json) { return json.is_null() || JsonKind<Value>::is(json); }
  /// One or many in messages.
  static std::string words(bool many = false) { return JsonKind<Value>::words(many) + " or null"; }
};

/// JsonKind of a list.
template <typename Value>
struct JsonKind<std::vector<Value>> {
  /// Whether a JSON value is a list of Values.
  static bool is(const nlohmann::json& json) {
    return json.is_array() && std::all_of(json.begin(), json.end(), JsonKind<Value>::is);
  }
  /// One or many in messages.
  static std::string words(bool many = false) {
    return (many ? "lists of " : "a list of ") + JsonKind<Value>::words(true);
  }
};

/// JsonKind of a list of `size` values.
template <typename Value, std::size_t size>
struct JsonKind<std::array<Value, size>> {
  /// Whether a JSON value is a list of `size` Values.
  static bool is(const nlohmann::json& json) {
    return JsonKind<std::vector<Value>>::is(json) && json.size() == size;
  }
  /// One or many in messages.
  static std::string words(bool many = false) {
    return (many ? "lists of " : "a list of ") + std::to_string(size) + ' ' + JsonKind<Value>::words(true);
  }
};

/// JsonKind of an object whose values are of one kind.
template <typename Value>
struct JsonKind<std::map<std::string, Value>> {
  /// Whether a JSON value is an object of Values.
  static bool is(const nlohmann::json& json) {
    return json.is_object() && std::all_of(json.begin(), json.end(), JsonKind<Value>::is);
  }
  /// One or many in messages.
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
  /// Throws JsonError, with the line, for a text that is not JSON or no object, and for a folder.
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
    return get<Value>(key, JsonKind<Value>::words(), [](const Value&) { return true; });
  }

  /// The same of values that `allowed` accepts, which are `expected` in words.
  template <typename Value, typename Allowed>
  Value get(const std::string& key, const std::string& expected, const Allowed& allowed) const {
    if (auto value = find<Value>(key, expected, allowed)) return *value;
    refuse(key, expected);
  }

  /// The value of a key that must be there; nothing for null. Throws JsonError for one of another kind.
  template <typename Value>
  std::optional<Value> get_or_null(const std::string& key) const {
    if (!contains(key)) refuse(key, JsonKind<std::optional<Value>>::words());
    return find<Value>(key);
  }

  /// Whether the key is there, if only with null.
  bool contains(const std::string& key) const { return json_.contains(key); }

  /// The object of a key, whose keys messages name as "key.theirs". Throws JsonError without it, and for what
  /// is no object.
  JsonObject object(const std::string& key) const;

  /// The same; nothing without the key.
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
  /// Reads a value, or nothing.
  template <typename Json>
  static void from_json(const Json& json, std::optional<Value>& value) {
    value = json.is_null() ? std::nullopt : std::optional<Value>(json.template get<Value>());
  }
  /// Writes a value, or null.
  template <typename Json>
  static void to_json(Json& json, const std::optional<Value>& value) {
    json = value ? Json(*value) : Json();
  }
};
