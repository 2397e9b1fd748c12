// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <random>
#include <string>
#include <vector>

#include "meshing/polygons/polygon_set.hpp"
#include "meshing/volume/volume_mesh.hpp"

namespace millfoam::meshing {

/// Adds a polygon with its own points; its line is 10 times its number, counted from 1.
inline void add_polygon(PolygonSet& set, const std::vector<Eigen::Vector3d>& corners,
                        const std::string& group = "walls") {
  Polygon polygon;
  for (const Eigen::Vector3d& corner : corners) {
    polygon.points.push_back(static_cast<int>(set.points.size()));
    set.points.push_back(corner);
  }
  polygon.group = group_index(set, group);
  polygon.line = 10 * (static_cast<int>(set.polygons.size()) + 1);
  set.polygons.push_back(polygon);
}

/// Adds a prism over a polygon in the plane z = low; sides in the order of its edges, then bottom and top.
inline void add_prism(PolygonSet& set, const std::vector<Eigen::Vector2d>& section, double low, double high) {
  const auto at = [&](std::size_t i, double z) {
    const Eigen::Vector2d& p = section[i % section.size()];
    return Eigen::Vector3d(p.x(), p.y(), z);
  };
  std::vector<Eigen::Vector3d> bottom, top;
  for (std::size_t i = 0; i < section.size(); ++i) {
    add_polygon(set, {at(i, low), at(i + 1, low), at(i + 1, high), at(i, high)}, "sides");
    bottom.push_back(at(i, low));
    top.push_back(at(i, high));
  }
  add_polygon(set, bottom, "bottom");
  add_polygon(set, top, "top");
}

/// Adds a cube of a given side; its faces look to -y, +x, +y, -x, -z and +z.
inline void add_cube(PolygonSet& set, const Eigen::Vector3d& low, double side) {
  const double x = low.x(), y = low.y();
  add_prism(set, {{x, y}, {x + side, y}, {x + side, y + side}, {x, y + side}}, low.z(), low.z() + side);
}

inline PolygonSet empty_set() {
  PolygonSet set;
  set.source = "hand.obj";
  return set;
}

/// The unit cube from the origin.
inline PolygonSet cube() {
  PolygonSet set = empty_set();
  add_cube(set, {0, 0, 0}, 1);
  return set;
}

/// The faces of a mesh in any order, of any orientation, beginning with any of their points.
inline PolygonSet taken_apart(const VolumeMesh& mesh, unsigned seed) {
  std::mt19937 random(seed);
  PolygonSet set = empty_set();
  set.points = mesh.points;
  const auto add = [&](std::size_t f, const std::string& group) {
    Polygon polygon{{mesh.faces[f].begin(), mesh.faces[f].end()}, group_index(set, group), 0};
    std::rotate(polygon.points.begin(), polygon.points.begin() + random() % 4, polygon.points.end());
    if (random() % 2 == 0) std::reverse(polygon.points.begin(), polygon.points.end());
    set.polygons.push_back(polygon);
  };
  for (std::size_t f = 0; f < mesh.neighbour.size(); ++f) add(f, "internal");
  for (const Patch& patch : mesh.patches) {
    if (patch.open) set.open.insert(patch.name);
    for (int f = patch.start; f < patch.start + patch.size; ++f) add(static_cast<std::size_t>(f), patch.name);
  }
  std::shuffle(set.polygons.begin(), set.polygons.end(), random);
  return set;
}

}  // namespace millfoam::meshing
