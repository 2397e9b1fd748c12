// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/grids/box_field.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace millfoam::averaging {

namespace {

/// The two voxels along one axis whose centres a point lies between, and the share of the upper one.
struct Neighbours {
  std::array<int, 2> voxel;
  std::array<double, 2> weight;
};

Neighbours neighbours(const BoxGrid& grid, std::size_t axis, double coordinate) {
  const int shape = grid.shape()[axis];
  const double place = (coordinate - grid.lower()[axis]) / grid.spacing()[axis] - 0.5;
  const double floor = std::floor(place);
  const int lower = static_cast<int>(floor);
  const auto valid = [&](int voxel) {
    return grid.periodic()[axis] ? (voxel + shape) % shape : std::clamp(voxel, 0, shape - 1);
  };
  return {{valid(lower), valid(lower + 1)}, {1 - (place - floor), place - floor}};
}

/// Sums of phi, phi*u and phi/d with weights.
struct Blend {
  double solidity = 0;
  Vector3 flux{};
  double solidity_over_diameter = 0;

  void add(const SolidsWindow& window, std::size_t n, double weight) {
    const double share = weight * window.solidity[n];
    if (share == 0) return;
    solidity += share;
    for (std::size_t a = 0; a < 3; ++a) flux[a] += share * window.velocity[3 * n + a];
    solidity_over_diameter += share / window.diameter[n];
  }

  LocalSolids divided() const {
    LocalSolids local;
    local.inside = true;
    if (solidity == 0) return local;
    local.solidity = solidity;
    for (std::size_t a = 0; a < 3; ++a) local.velocity[a] = flux[a] / solidity;
    local.diameter = solidity / solidity_over_diameter;
    return local;
  }
};

LocalSolids sample_linear(const BoxGrid& grid, const SolidsWindow& window, const Vector3& point) {
  const Vector3 image = grid.wrapped(point);
  const std::array<Neighbours, 3> along{neighbours(grid, 0, image[0]), neighbours(grid, 1, image[1]),
                                        neighbours(grid, 2, image[2])};
  Blend blend;
  for (std::size_t k = 0; k < 2; ++k) {
    for (std::size_t j = 0; j < 2; ++j) {
      for (std::size_t i = 0; i < 2; ++i) {
        const std::size_t n = grid.offset({along[0].voxel[i], along[1].voxel[j], along[2].voxel[k]});
        blend.add(window, n, along[0].weight[i] * along[1].weight[j] * along[2].weight[k]);
      }
    }
  }
  return blend.divided();
}

LocalSolids sample_cell(const BoxGrid& grid, const SolidsWindow& window, const VoxelIndex& voxel) {
  const std::size_t n = grid.offset(voxel);
  return {window.solidity[n],
          {window.velocity[3 * n], window.velocity[3 * n + 1], window.velocity[3 * n + 2]},
          window.diameter[n],
          true};
}

}  // namespace

LocalSolids sample(const BoxGrid& grid, const SolidsWindow& window, const Vector3& point,
                   Interpolation interpolation) {
  assert(window.solidity.size() == grid.size() && window.velocity.size() == 3 * grid.size());
  const std::optional<VoxelIndex> voxel = grid.locate(point);
  if (!voxel) return {};
  return interpolation == Interpolation::cell ? sample_cell(grid, window, *voxel)
                                              : sample_linear(grid, window, point);
}

}  // namespace millfoam::averaging
