// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/mill_key.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <sstream>

namespace millfoam::dem_driver {

namespace {

/// The entry of that name in a map, or of that number in a list, and its line, from 0.
struct Entry {
  YAML::Node node;
  int line = 0;
};

Entry find_entry(const YAML::Node& parent, const std::string& name) {
  if (parent.IsSequence()) {
    const YAML::Node item = parent[std::stoul(name)];
    return {item, item.Mark().line};
  }
  if (parent.IsMap()) {
    for (const auto& entry : parent)
      if (entry.first.IsScalar() && entry.first.Scalar() == name)
        return {entry.second, entry.first.Mark().line};
  }
  return {YAML::Node(YAML::NodeType::Undefined), 0};
}

/// Line of a key in the file, or of the innermost section around it that is there, from 1.
int line_of(const std::filesystem::path& file, std::string key) {
  std::replace(key.begin(), key.end(), '[', '.');
  key.erase(std::remove(key.begin(), key.end(), ']'), key.end());
  std::istringstream names(key);
  Entry place{YAML::LoadFile(file.string()), 0};
  for (std::string name; std::getline(names, name, '.');) {
    const Entry next = find_entry(place.node, name);
    if (!next.node.IsDefined()) break;
    place.node.reset(next.node);
    place.line = next.line;
  }
  return place.line + 1;
}

}  // namespace

KeyError::KeyError(const std::string& key, const std::string& value, const std::string& expected)
    : std::runtime_error("key '" + key + "' = " + value + ": expected " + expected), key_(key) {}

std::string with_place(const std::filesystem::path& file, const KeyError& error) {
  std::string place = file.string();
  try {
    place += ':' + std::to_string(line_of(file, error.key()));
  } catch (const YAML::Exception&) {  // changed or removed since it was read
  }
  return place + ": " + error.what();
}

}  // namespace millfoam::dem_driver
