// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "meshing/faces/face_geometry.hpp"

namespace millfoam::meshing {

/// Two faces that cross or touch.
struct Crossing {
  std::array<int, 2> faces{};                       ///< indices of the two
  Eigen::Vector3d where = Eigen::Vector3d::Zero();  ///< a point near to it, m
};

/// The faces without a common point that cross or touch, by CGAL's boxes and exact predicates. Pairs with a
/// common point are not looked at: in a mesh they are most of the pairs near each other.
std::vector<Crossing> find_crossings(const Points& points, const std::vector<Face>& faces);

/// The triangles that cross or overlap, those with a common corner too (CGAL's Polygon_mesh_processing).
/// Where they are not manifold, or some have no area, as find_crossings() does it.
std::vector<Crossing> crossing_triangles(const Points& points, const std::vector<Face>& triangles);

}  // namespace millfoam::meshing
