// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/files/json_object.hpp"

#include <algorithm>
#include <cstddef>
#include <fstream>
#include <iterator>

namespace millfoam {

using Json = nlohmann::json;

std::optional<JsonObject> JsonObject::read(const std::filesystem::path& file, const std::string& advice) {
  if (std::filesystem::is_directory(file))
    throw JsonError(file.string() + ": is a folder, expected a file of JSON" + advice);
  std::ifstream in(file, std::ios::binary);
  if (!in) return std::nullopt;
  return JsonObject({std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()}, file, advice);
}

JsonObject::JsonObject(const std::string& text, const std::filesystem::path& file, const std::string& advice)
    : file_(file.string()), advice_(advice) {
  try {
    json_ = Json::parse(text);
  } catch (const Json::parse_error& error) {
    const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(error.byte, text.size()));
    throw JsonError(file_ + ':' + std::to_string(1 + std::count(text.begin(), end, '\n')) +
                    ": this is not JSON, expected an object" + advice_);
  } catch (const Json::exception& error) {
    throw JsonError(file_ + ": " + error.what() + advice_);
  }
  if (!json_.is_object())
    throw JsonError(file_ + ": expected an object of JSON, {\"key\": value, ...}" + advice_);
}

JsonObject::JsonObject(const JsonObject& parent, const std::string& place, const Json& json)
    : file_(parent.file_), advice_(parent.advice_), place_(parent.place_ + place + '.'), json_(json) {}

std::optional<JsonObject> JsonObject::of_format(const std::filesystem::path& file,
                                                const std::string& format) {
  try {
    auto found = read(file);
    if (found) found->require_format(format);
    return found;
  } catch (const JsonError&) {
    return std::nullopt;
  }
}

void JsonObject::require_format(const std::string& format) const {
  if (find<std::string>("format") == format) return;
  throw JsonError(file_ + ": is not of the format " + format + advice_);
}

const Json* JsonObject::json_of(const std::string& key) const {
  const auto found = json_.find(key);
  return found == json_.end() || found->is_null() ? nullptr : &*found;
}

std::optional<JsonObject> JsonObject::find_object(const std::string& key) const {
  const Json* json = json_of(key);
  if (json == nullptr) return std::nullopt;
  if (!json->is_object()) refuse(key, "an object");
  return JsonObject(*this, key, *json);
}

JsonObject JsonObject::object(const std::string& key) const {
  if (auto found = find_object(key)) return *found;
  refuse(key, "an object");
}

std::vector<JsonObject> JsonObject::objects(const std::string& key) const {
  const Json* json = json_of(key);
  const auto is_object = [](const Json& entry) { return entry.is_object(); };
  if (json == nullptr || !json->is_array() || !std::all_of(json->begin(), json->end(), is_object))
    refuse(key, "a list of objects");
  std::vector<JsonObject> found;
  for (const Json& entry : *json)
    found.push_back(JsonObject(*this, key + '[' + std::to_string(found.size()) + ']', entry));
  return found;
}

void JsonObject::refuse(const std::string& key, const std::string& expected) const {
  throw JsonError(file_ + ": key '" + place_ + key + "' is " +
                  (contains(key) ? json_.at(key).dump() : "missing") + ", expected " + expected + advice_);
}

}  // namespace millfoam
