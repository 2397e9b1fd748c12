// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "meshing/faces/face_geometry.hpp"
#include "meshing/surface/face_edges.hpp"

namespace millfoam::meshing {

/// A point that lies on an edge without being an end of it.
struct TJunction {
  int point = 0;         ///< index of the point
  std::size_t edge = 0;  ///< index of the edge
};

/// Points of faces that are nearer to an edge, between its ends, than 1e-6 of its length.
std::vector<TJunction> find_t_junctions(const Points& points, const surface::EdgeTable& edges);

}  // namespace millfoam::meshing
