// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/voxel_field.hpp"

#include <cmath>
#include <cstddef>

namespace millfoam::dem_driver {

namespace {

Vector voxel_vector(const std::vector<double>& values, std::size_t voxel) {
  return {values[3 * voxel], values[3 * voxel + 1], values[3 * voxel + 2]};
}

}  // namespace

void FeltFluid::add(double weight, const FeltFluid& other) {
  for (std::size_t k = 0; k < 3; ++k) {
    pressure[k] += weight * other.pressure[k];
    drag[k] += weight * other.drag[k];
  }
  exchange += weight * other.exchange;
  solidity += weight * other.solidity;
  diameter += weight * other.diameter;
}

VoxelField::VoxelField(const averaging::BoxGrid& grid) : grid_(grid), voxels_(grid.size()) {}

VoxelField::VoxelField(const averaging::BoxGrid& grid, const averaging::BallFields& fields)
    : VoxelField(grid) {
  for (std::size_t i = 0; i < voxels_.size(); ++i) {
    if (!(fields.inside[i] > 0)) continue;
    voxels_[i] = {true,
                  voxel_vector(fields.pressure_force, i),
                  voxel_vector(fields.drag_force, i),
                  fields.exchange[i],
                  fields.solidity[i],
                  fields.diameter[i]};
  }
}

VoxelField::Neighbours VoxelField::around(double coordinate, std::size_t axis) const {
  const double place = (coordinate - grid_.lower()[axis]) / grid_.spacing()[axis] - 0.5;
  const double below = std::floor(place);
  const int count = grid_.shape()[axis];
  Neighbours result{{-1, -1}, {1 - (place - below), place - below}};
  for (std::size_t side = 0; side < 2; ++side) {
    const double voxel = below + static_cast<double>(side);
    if (grid_.periodic()[axis])
      result.voxel[side] = static_cast<int>(voxel - count * std::floor(voxel / count));
    else if (voxel >= 0 && voxel < count)
      result.voxel[side] = static_cast<int>(voxel);
  }
  return result;
}

FeltFluid VoxelField::at(const Vector& point) const {
  const std::array<Neighbours, 3> places{around(point[0], 0), around(point[1], 1), around(point[2], 2)};
  FeltFluid sum;
  double weights = 0;
  for (std::size_t k = 0; k < 2; ++k)
    for (std::size_t j = 0; j < 2; ++j)
      for (std::size_t i = 0; i < 2; ++i) {
        const averaging::VoxelIndex index{places[0].voxel[i], places[1].voxel[j], places[2].voxel[k]};
        if (index[0] < 0 || index[1] < 0 || index[2] < 0) continue;
        const FeltFluid& voxel = voxels_[grid_.offset(index)];
        if (!voxel.known) continue;
        const double weight = places[0].weight[i] * places[1].weight[j] * places[2].weight[k];
        sum.add(weight, voxel);
        weights += weight;
      }
  if (!(weights > 0)) return {};
  FeltFluid mean;
  mean.add(1 / weights, sum);
  mean.known = true;
  return mean;
}

}  // namespace millfoam::dem_driver
