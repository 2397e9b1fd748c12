// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <vector>

#include "averaging/grids/box_grid.hpp"
#include "averaging/mesh/mesh_geometry.hpp"
#include "averaging/values/voxel_sums.hpp"

namespace millfoam::averaging {

/// The cells of a flow's mesh as points that carry volume. They transfer its fields to a box grid of the lab
/// frame, at any angle of the mesh.
///
/// Each cell is cut into the tetrahedra over its centroid and the triangles of its faces. One with all
/// corners in a voxel belongs there. Any other is cut into m^3 of equal volume, and each of those belongs to
/// the voxel that holds its centroid. The volumes add up to the cell's, so that what is in the cells is in
/// the voxels or outside; a voxel's face is met to the size of a small tetrahedron. A tetrahedron that lies
/// outside its cell, because a face is seen from the centroid from behind, counts negative.
class CellPoints {
 public:
  /// @param mesh       at any time; it is copied
  /// @param divisions  m of an edge of a tetrahedron. Throws std::invalid_argument unless it is 1 to 10.
  explicit CellPoints(const MeshGeometry& mesh, int divisions = 2);

  std::size_t cells() const { return begin_.size() - 1; }                  ///< number of cells of the mesh
  std::size_t size() const { return tetrahedra_.size() * parts_.size(); }  ///< number of points, at most

  /// Adds a field to the sums over voxels; where the grid is periodic its images are one.
  /// @param grid    of the lab frame
  /// @param place   carries the mesh into the lab frame
  /// @param values  [cells][sums.components]
  /// @param sums    added to: [voxels of the grid]
  void deposit(const BoxGrid& grid, const Eigen::Isometry3d& place, const std::vector<double>& values,
               VoxelSums& sums) const;

  /// Calls take(point, volume) with each point of a cell, in m and m^3, where the mesh was given.
  template <typename Take>
  void for_points(std::size_t cell, const Take& take) const {
    const Eigen::Vector3d& centroid = centroids_[cell];
    for (std::size_t t = begin_[cell]; t < begin_[cell + 1]; ++t) {
      const auto side = [&](std::size_t c) -> Eigen::Vector3d {
        return points_[static_cast<std::size_t>(tetrahedra_[t].corners[c])] - centroid;
      };
      const Eigen::Vector3d a = side(0), b = side(1), c = side(2);
      const double volume = tetrahedra_[t].volume / static_cast<double>(parts_.size());
      for (const auto& [u, v, w] : parts_) take(Eigen::Vector3d(centroid + u * a + v * b + w * c), volume);
    }
  }

 private:
  struct Tetrahedron {
    std::array<int, 3> corners;  ///< in points_; the fourth is the cell's centroid
    double volume;               ///< m^3
  };
  class Voxels;

  void deposit_cell(std::size_t cell, const std::vector<Eigen::Vector3d>& points,
                    const Eigen::Vector3d& centroid, Voxels& voxels) const;

  std::vector<Eigen::Vector3d> points_;     ///< of the mesh and in its faces
  std::vector<Eigen::Vector3d> centroids_;  ///< [cells]
  std::vector<std::size_t> begin_;          ///< [cells + 1] where a cell's tetrahedra begin
  std::vector<Tetrahedron> tetrahedra_;
  std::vector<std::array<double, 3>> parts_;  ///< [m^3] centroids, as weights of a tetrahedron's corners
};

}  // namespace millfoam::averaging
