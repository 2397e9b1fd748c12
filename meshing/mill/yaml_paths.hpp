// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <yaml-cpp/yaml.h>

#include <string>
#include <vector>

/// Paths of keys, as in "charge.classes[0].mass", and what they name in the nodes of a mill.
namespace millfoam::meshing {

/// "a.b[2].c" as {"a", "b", "2", "c"}; empty when it is not a path.
std::vector<std::string> names_of(const std::string& path);

/// The path of the section or list that a key is in; empty for a section of the root.
std::string section_around(const std::string& path);

/// Throws MillError where a path names an item of a list that is not there: `assign_key` would make a map of
/// it.
/// @param place  of the change, for messages
/// @param root   that the path begins at
/// @param path   of the key
void require_lists(const std::string& place, const YAML::Node& root, const std::string& path);

/// Removes the key at a path from its map, or makes an item of a list null. Returns whether it was there.
/// Throws MillError for a path into a value that holds no keys, and for a list that has no such item.
/// @param place  of the change, for messages
/// @param root   that the path begins at
/// @param names  of the path
bool remove_key(const std::string& place, const YAML::Node& root, const std::vector<std::string>& names);

/// Gives the key at a path a value, and makes the maps around it that are missing. Throws as remove_key.
void assign_key(const std::string& place, const YAML::Node& root, const std::vector<std::string>& names,
                const YAML::Node& value);

}  // namespace millfoam::meshing
