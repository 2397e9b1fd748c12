// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/polygons/polygon_set.hpp"

#include <algorithm>

namespace millfoam::meshing {

std::string place(const PolygonSet& set, int polygon) {
  const Polygon& at = set.polygons[static_cast<std::size_t>(polygon)];
  const std::string& file = set.files.empty() ? set.source : set.files[static_cast<std::size_t>(at.group)];
  if (at.line > 0) return file + ':' + std::to_string(at.line);
  return file + ": face " + std::to_string(at.number > 0 ? at.number : polygon + 1);
}

int group_index(PolygonSet& set, const std::string& name) {
  const auto found = std::find(set.groups.begin(), set.groups.end(), name);
  if (found == set.groups.end()) set.groups.push_back(name);
  return static_cast<int>(std::find(set.groups.begin(), set.groups.end(), name) - set.groups.begin());
}

}  // namespace millfoam::meshing
