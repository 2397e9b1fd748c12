// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "meshing/faces/face_geometry.hpp"

namespace millfoam::meshing {

/// One face's side: the edge between the points `low` < `high`.
struct FaceSide {
  int low = 0;
  int high = 0;
  int face = 0;
  bool forward = false;  ///< whether the face goes round from low to high
};

/// All edges of a set of faces, each with the faces that meet at it.
struct EdgeTable {
  std::vector<FaceSide> sides;     ///< those of the same edge one after the other
  std::vector<std::size_t> begin;  ///< of each edge in `sides`; one more entry than edges

  std::size_t size() const { return begin.size() - 1; }
  /// Number of faces at an edge.
  std::size_t faces(std::size_t edge) const { return begin[edge + 1] - begin[edge]; }
  const FaceSide& first(std::size_t edge) const { return sides[begin[edge]]; }
};

/// Takes the time of sorting the faces' sides.
EdgeTable find_edges(const std::vector<Face>& faces);

/// A point that lies on an edge without being an end of it.
struct TJunction {
  int point = 0;
  std::size_t edge = 0;
};

/// Points of faces that are nearer to an edge, between its ends, than 1e-6 of its length.
std::vector<TJunction> find_t_junctions(const Points& points, const EdgeTable& edges);

}  // namespace millfoam::meshing
