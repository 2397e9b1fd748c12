// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/fields/ball_means.hpp"

#include <cassert>

#include "averaging/files/slurry_file.hpp"

namespace millfoam::averaging {

namespace {

/// Places of the sums in `ball_components`.
constexpr std::size_t solidity = 1, pressure = 2, exchange = 5, drag = 6, velocity = 9, diameter = 13;

}  // namespace

BallFields ball_means(const BoxGrid& grid, const VoxelSums& sums) {
  assert(sums.components == ball_components && sums.volume.size() == grid.size());
  const std::size_t voxels = grid.size();
  BallFields fields;
  fields.inside = sums.volume;
  for (double& share : fields.inside) share /= grid.voxel_volume();
  fields.pressure_force.resize(3 * voxels);
  fields.exchange.resize(voxels);
  fields.drag_force.resize(3 * voxels);
  fields.solidity.resize(voxels);
  fields.diameter.resize(voxels);
  for (std::size_t voxel = 0; voxel < voxels; ++voxel) {
    const double* sum = &sums.values[voxel * ball_components];
    const double weight = sum[0];
    if (!(weight > 0)) continue;
    fields.solidity[voxel] = sum[solidity] / sums.volume[voxel];
    fields.exchange[voxel] = sum[exchange] / weight;
    fields.diameter[voxel] = sum[diameter] / weight;
    for (std::size_t k = 0; k < 3; ++k) {
      fields.pressure_force[3 * voxel + k] = sum[pressure + k] / weight;
      fields.drag_force[3 * voxel + k] =
          sum[drag + k] / weight + fields.exchange[voxel] * sum[velocity + k] / weight;
    }
  }
  return fields;
}

}  // namespace millfoam::averaging
