// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace millfoam::meshing {

/// The constrained Delaunay triangulation of a polygon's inside (CGAL). `edges` are its sides as point
/// indices, in any order; points that are on no side lie inside and become vertices too. Returns
/// anticlockwise triangles.
std::vector<std::array<int, 3>> fill_polygon(const std::vector<Eigen::Vector2d>& points,
                                             const std::vector<std::array<int, 2>>& edges);

}  // namespace millfoam::meshing
