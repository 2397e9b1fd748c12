// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace millfoam::surface {

/// One face's side: the edge between the points `low` < `high`.
struct FaceSide {
  int low = 0;           ///< index of a point
  int high = 0;          ///< index of the other point
  int face = 0;          ///< index of the face
  bool forward = false;  ///< whether the face goes round from low to high
};

/// All edges of a set of faces, each with the faces that meet at it.
struct EdgeTable {
  std::vector<FaceSide> sides;     ///< those of the same edge one after the other
  std::vector<std::size_t> begin;  ///< of each edge in `sides`; one more entry than edges

  /// Number of edges.
  std::size_t size() const { return begin.size() - 1; }
  /// Number of faces at an edge.
  std::size_t faces(std::size_t edge) const { return begin[edge + 1] - begin[edge]; }
  /// The side of the first face at an edge.
  const FaceSide& first(std::size_t edge) const { return sides[begin[edge]]; }
};

/// The edges of sides in any order. Takes the time of sorting them.
EdgeTable table_of(std::vector<FaceSide> sides);

/// The edges of faces, lists of point indices around each.
template <typename Face>
EdgeTable find_edges(const std::vector<Face>& faces) {
  std::vector<FaceSide> sides;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    for (std::size_t i = 0; i < faces[f].size(); ++i) {
      const int a = faces[f][i], b = faces[f][(i + 1) % faces[f].size()];
      sides.push_back({std::min(a, b), std::max(a, b), static_cast<int>(f), a < b});
    }
  }
  return table_of(std::move(sides));
}

}  // namespace millfoam::surface
