// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

namespace millfoam::averaging {

/// Sums over the parts of a flow's cells in each voxel of a grid of n voxels. Those of several meshes (the
/// parts of a decomposed one) or times may be added up, entry by entry.
struct VoxelSums {
  std::size_t components = 1;  ///< of a value
  std::vector<double> volume;  ///< [n] of the cells' parts, m^3
  std::vector<double> values;  ///< [n][components] sum of volume times value
  double outside = 0;          ///< volume of the parts beyond the grid, m^3

  /// Empty ones.
  VoxelSums(std::size_t voxels, std::size_t components_per_cell)
      : components(components_per_cell), volume(voxels, 0.0), values(voxels * components_per_cell, 0.0) {}
};

}  // namespace millfoam::averaging
