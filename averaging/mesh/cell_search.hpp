// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <vector>

namespace millfoam::averaging {

/// Finds cells of a mesh. Points of neighbouring cells' common faces, edges and corners belong to the one of
/// these cells with the lowest number; the boundary belongs to the mesh. Both hold within
/// rounding: 1e-14 of the mesh's coordinates.
class CellSearch {
 public:
  virtual ~CellSearch() = default;

  /// The cell that holds a point, m, or -1 outside the mesh.
  /// @param point  in the frame in which the mesh is kept
  /// @param hint  a cell near to which it may be, or -1; it saves time and does not change the answer
  virtual int locate(const Eigen::Vector3d& point, int hint = -1) const = 0;

  /// Overwrites `cells` with numbers of cells, among them all that meet a box. A cell may appear twice.
  virtual void candidates(const Eigen::AlignedBox3d& box, std::vector<int>& cells) const = 0;

 protected:
  CellSearch() = default;
  CellSearch(const CellSearch&) = default;
  CellSearch& operator=(const CellSearch&) = default;
};

}  // namespace millfoam::averaging
