// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/polygon_set.hpp"

#include <algorithm>

namespace millfoam::meshing {

std::string place(const PolygonSet& set, int polygon) {
  const int line = set.polygons[static_cast<std::size_t>(polygon)].line;
  if (line > 0) return set.source + ':' + std::to_string(line);
  return set.source + ": face " + std::to_string(polygon + 1);
}

int group_index(PolygonSet& set, const std::string& name) {
  const auto found = std::find(set.groups.begin(), set.groups.end(), name);
  if (found == set.groups.end()) set.groups.push_back(name);
  return static_cast<int>(std::find(set.groups.begin(), set.groups.end(), name) - set.groups.begin());
}

}  // namespace millfoam::meshing
