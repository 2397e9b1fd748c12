// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "meshing/faces/face_geometry.hpp"
#include "meshing/surface/face_edges.hpp"

namespace millfoam::meshing {

/// The side of a face that its normal points into, and the one behind it. Side s of face f has the number
/// 2 f + s.
enum FaceSideNumber { in_front = 0, behind = 1 };

/// Two faces that leave an edge in the same direction.
struct Overlap {
  std::array<int, 2> faces{};  ///< indices of the two
  std::size_t edge = 0;        ///< index of the edge
};

/// The faces' sides joined to closed shells.
///
/// Around an edge the faces are sorted by angle; the side of one that looks towards the next is joined with
/// the side of that one that looks back, for both bound the same space. A face's direction from the edge is
/// that of its area vector turned about the edge by a right angle: it points into the face, also where that
/// is not flat or not convex, as long as its warp is smaller than its angle to the next face.
struct Shells {
  std::vector<int> of_side;    ///< for each side of each face its shell
  std::vector<double> volume;  ///< m^3, of what the shell bounds: positive around a cell, negative where the
                               ///< shell is a body seen from outside, near 0 for a sheet seen from both sides
  std::vector<double> area;    ///< m^2
  std::vector<Overlap> overlaps;  ///< where there is no order about an edge: nearer than 1e-6 rad

  /// Number of shells.
  int count() const { return static_cast<int>(volume.size()); }
};

/// Joins the sides of faces to shells.
Shells find_shells(const Points& points, const std::vector<Face>& faces, const surface::EdgeTable& edges);

/// Numbers of the sides about an edge in pairs that bound the same space, in the order of rotation.
std::vector<std::array<std::size_t, 2>> spaces_about(const Points& points, const std::vector<Face>& faces,
                                                     const surface::EdgeTable& edges, std::size_t edge,
                                                     std::vector<Overlap>* overlaps = nullptr);

/// The cells that shells bound.
///
/// A shell of positive volume is a cell. One of negative volume belongs to the cell that contains it (by the
/// solid angle that the cell's shell is seen under: the smallest of those that do), or to the outside.
struct ShellCells {
  std::vector<int> of_shell;   ///< cell, or `outside`
  std::vector<double> volume;  ///< m^3 of each cell
  std::vector<int> flat;       ///< shells that enclose nothing
};

/// The number of the space outside all cells.
inline constexpr int outside = -1;

/// Finds the cells that shells bound.
ShellCells find_cells(const Points& points, const std::vector<Face>& faces, const Shells& shells);

}  // namespace millfoam::meshing
