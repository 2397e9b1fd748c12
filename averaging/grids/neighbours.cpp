// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/grids/neighbours.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

namespace millfoam::averaging {

namespace {

/// Of a lattice whose first number runs fastest.
std::vector<std::array<int, 2>> lattice_neighbours(const VoxelIndex& shape,
                                                   const std::array<bool, 3>& periodic) {
  const long long cells = 1LL * shape[0] * shape[1] * shape[2];
  if (cells > std::numeric_limits<int>::max()) {
    throw std::invalid_argument("neighbours: the grid has " + std::to_string(cells) +
                                " cells; expected at most " +
                                std::to_string(std::numeric_limits<int>::max()));
  }
  const std::array<int, 3> strides{1, shape[0], shape[0] * shape[1]};
  std::vector<std::array<int, 2>> pairs;
  pairs.reserve(3 * static_cast<std::size_t>(cells));
  for (int cell = 0; cell < static_cast<int>(cells); ++cell) {
    for (std::size_t a = 0; a < 3; ++a) {
      const int place = cell / strides[a] % shape[a];
      if (place + 1 < shape[a]) pairs.push_back({cell, cell + strides[a]});
      // Two voxels along a periodic direction share both their faces, and are one pair.
      if (place == 0 && periodic[a] && shape[a] > 2) {
        pairs.push_back({cell, cell + (shape[a] - 1) * strides[a]});
      }
    }
  }
  return pairs;
}

}  // namespace

std::vector<std::array<int, 2>> neighbours(const BoxGrid& grid) {
  return lattice_neighbours(grid.shape(), grid.periodic());
}

std::vector<std::array<int, 2>> neighbours(const CylinderGrid& grid) {
  return lattice_neighbours(grid.shape(), {false, true, grid.periodic_z()});
}

}  // namespace millfoam::averaging
