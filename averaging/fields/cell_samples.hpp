// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <vector>

#include "averaging/grids/box_grid.hpp"
#include "averaging/mesh/mesh_geometry.hpp"

namespace millfoam::averaging {

/// Points at which the cells of a flow's mesh take fields from the voxels of a box in the lab frame, at any
/// angle of the mesh about z. A cell that is no larger than a voxel has one point, its centroid. A larger one
/// has those of CellPoints, so many that no voxel in it is passed over.
class CellSamples {
 public:
  /// Throws std::invalid_argument for a cell that is longer than 25 voxels.
  /// @param mesh  at any time; nothing of it is kept
  /// @param grid  of the lab frame
  CellSamples(const MeshGeometry& mesh, const BoxGrid& grid);

  std::size_t size() const { return points_.size(); }  ///< number of points

  /// Calls take(point, share) with each point of a cell, in m, and the share of the cell's volume that it
  /// stands for.
  /// @param cell   its number
  /// @param place  carries the mesh into the lab frame
  /// @param take   called with (Vector3, double)
  template <typename Take>
  void for_points(std::size_t cell, const Eigen::Isometry3d& place, const Take& take) const {
    for (std::size_t n = begin_[cell]; n < begin_[cell + 1]; ++n) {
      const Eigen::Vector3d at = place * points_[n];
      take(Vector3{at[0], at[1], at[2]}, shares_[n]);
    }
  }

 private:
  std::vector<std::size_t> begin_;       ///< [cells + 1] where a cell's points begin
  std::vector<Eigen::Vector3d> points_;  ///< of the mesh as it was given
  std::vector<double> shares_;
};

}  // namespace millfoam::averaging
