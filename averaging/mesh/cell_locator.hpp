// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "averaging/mesh/cell_containment.hpp"
#include "averaging/mesh/cell_search.hpp"
#include "averaging/mesh/mesh_geometry.hpp"

namespace millfoam::averaging {

/// Finds cells of a mesh whose points do not move, in a time that hardly depends on their number.
///
/// A coarse grid of about as many voxels as there are cells is laid over the mesh; each lists the cells that
/// meet it. A voxel that is not wholly in one cell or outside is cut into 2^3, or where cells crowd up to
/// 16^3, fine voxels, which know the cell that they lie in wholly, or that they are outside, or the few cells
/// that meet them. Most points are answered by the fine voxel, or by one test of the cell that held the last
/// one
/// (`hint`).
class CellLocator : public CellSearch {
 public:
  /// Prepares the search, in a time that grows as the number of cells.
  explicit CellLocator(std::shared_ptr<const MeshGeometry> geometry);

  const MeshGeometry& geometry() const { return *geometry_; }  ///< of the mesh that is searched

  int locate(const Eigen::Vector3d& point, int hint = -1) const final {
    const Eigen::Array3d place = (point - lower_).array() * per_metre_.array();
    // Written so that what is not a number is outside.
    if (!((place >= 0).all() && (place < limit_).all())) return outside;
    const int code = code_at(place.cast<int>());
    return code >= outside ? code : choose(point, hint, -(code + 2));
  }

  void candidates(const Eigen::AlignedBox3d& box, std::vector<int>& cells) const final;

 private:
  static constexpr int outside = -1;
  static constexpr int deepest = 4;  ///< a coarse voxel has at most 2^deepest fine ones along an edge

  /// Of a coarse voxel: `first` is its code when `depth` is 0, else where the codes of its fine voxels begin.
  struct Voxel {
    int first = outside;
    int depth = 0;
  };

  /// What a voxel or fine voxel is filled from.
  struct Filling;

  int code_at(const Eigen::Array3i& place) const {
    const Voxel& voxel = voxels_[index(place / (1 << deepest))];
    if (voxel.depth == 0) return voxel.first;
    const Eigen::Array3i fine =
        (place - place / (1 << deepest) * (1 << deepest)) / (1 << (deepest - voxel.depth));
    const int code = voxel.first + (((fine[2] << voxel.depth) + fine[1]) << voxel.depth) + fine[0];
    return codes_[static_cast<std::size_t>(code)];
  }

  std::size_t index(const Eigen::Array3i& voxel) const {
    const int number = (voxel[2] * shape_[1] + voxel[1]) * shape_[0] + voxel[0];
    return static_cast<std::size_t>(number);
  }

  int choose(const Eigen::Vector3d& point, int hint, int list) const;
  void lay_grid();
  void list_cells();
  void fill_voxel(const Eigen::Array3i& voxel);
  void fill(Filling& filling, const Eigen::Array3i& corner, int level, const std::vector<int>& cells);
  int list_code(Filling& filling, const std::vector<int>& cells);

  std::shared_ptr<const MeshGeometry> geometry_;
  CellContainment containment_;
  Eigen::Vector3d lower_;
  Eigen::Vector3d per_metre_;  ///< smallest fine voxels per m
  Eigen::Array3d limit_;       ///< the grid's extent in smallest fine voxels
  Eigen::Array3i shape_;
  std::vector<Voxel> voxels_;
  std::vector<int> voxel_begin_;  ///< where a coarse voxel's cells begin in voxel_cells_
  std::vector<int> voxel_cells_;
  std::vector<int> codes_;  ///< of fine voxels: a cell, `outside`, or -2 less the place of a list
  std::vector<int> lists_;  ///< each a number of cells and the cells, rising
};

}  // namespace millfoam::averaging
