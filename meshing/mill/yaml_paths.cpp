// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/mill/yaml_paths.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>

#include "meshing/mill/mill_error.hpp"

namespace millfoam::meshing {
namespace {

/// The number of an item of a list.
/// @param place  of the change, for messages
std::size_t item_number(const std::string& place, const YAML::Node& list, const std::string& name) {
  std::size_t number = 0;
  const char* end = name.data() + name.size();
  const auto [stop, error] = std::from_chars(name.data(), end, number);
  if (error != std::errc{} || stop != end || number >= list.size())
    throw MillError(place + ": '" + name + "': expected a number of the list's items, from 0 to " +
                    std::to_string(list.size() - 1) + ", as in classes[0]");
  return number;
}

/// Throws for a key of that name in a value that can have none.
void require_map(const std::string& place, const YAML::Node& node, const std::string& name) {
  if (!node.IsMap() && !node.IsNull())
    throw MillError(place + ": '" + name + "' is set in '" + node.Scalar() +
                    "', which holds no keys: expected a map");
}

/// The item or entry of that name in a node, made where it is missing in a map.
YAML::Node child(const std::string& place, YAML::Node node, const std::string& name) {
  if (node.IsSequence()) return node[item_number(place, node, name)];
  require_map(place, node, name);
  if (!node[name].IsDefined()) node[name] = YAML::Node(YAML::NodeType::Map);
  return node[name];
}

}  // namespace

std::vector<std::string> names_of(const std::string& path) {
  std::vector<std::string> names(1);
  for (std::size_t at = 0; at < path.size(); ++at) {
    if (path[at] == '.' || path[at] == '[') {
      if (names.back().empty()) return {};
      names.emplace_back();
    } else if (path[at] == ']') {
      const bool number =
          !names.back().empty() && std::all_of(names.back().begin(), names.back().end(), [](char c) {
            return std::isdigit(static_cast<unsigned char>(c)) != 0;
          });
      if (!number || (at + 1 < path.size() && path[at + 1] != '.')) return {};
      if (at + 1 < path.size()) ++at, names.emplace_back();
    } else {
      names.back() += path[at];
    }
  }
  if (names.back().empty()) return {};
  return names;
}

std::string section_around(const std::string& path) {
  const std::size_t cut = path.find_last_of(".[");
  return cut == std::string::npos ? "" : path.substr(0, cut);
}

void require_lists(const std::string& place, const YAML::Node& root, const std::string& path) {
  for (std::size_t at = path.find('['); at != std::string::npos; at = path.find('[', at + 1)) {
    const std::string list = path.substr(0, at);
    YAML::Node node;
    node.reset(root);
    for (const std::string& name : names_of(list)) {
      if (node.IsSequence())
        node.reset(node[item_number(place, node, name)]);
      else
        node.reset(node.IsMap() && node[name].IsDefined() ? node[name] : YAML::Node());
    }
    if (node.IsSequence()) continue;
    throw MillError(place + ": the mill has no list '" + list +
                    "': expected an item of a list that it has, or the whole list, as in " + list + "=[…]");
  }
}

bool remove_key(const std::string& place, const YAML::Node& root, const std::vector<std::string>& names) {
  YAML::Node node;
  node.reset(root);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string& name = names[i];
    const bool last = i + 1 == names.size();
    if (node.IsSequence()) {
      const std::size_t number = item_number(place, node, name);
      if (last)
        node[number] = YAML::Node();
      else
        node.reset(node[number]);
      continue;
    }
    require_map(place, node, name);
    if (node.IsNull() || !node[name].IsDefined()) return false;
    if (last)
      node.remove(name);
    else
      node.reset(node[name]);
  }
  return true;
}

void assign_key(const std::string& place, const YAML::Node& root, const std::vector<std::string>& names,
                const YAML::Node& value) {
  YAML::Node node;
  node.reset(root);
  for (std::size_t i = 0; i + 1 < names.size(); ++i) node.reset(child(place, node, names[i]));
  const std::string& last = names.back();
  child(place, node, last);
  if (node.IsSequence())
    node[item_number(place, node, last)] = value;
  else
    node[last] = value;
}

}  // namespace millfoam::meshing
