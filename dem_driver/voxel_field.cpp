// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/voxel_field.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "meshing/surface/pi.hpp"

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

int VoxelField::wrapped(double voxel, std::size_t axis) const {
  const int count = grid_.shape()[axis];
  if (grid_.periodic()[axis]) return static_cast<int>(voxel - count * std::floor(voxel / count));
  return voxel >= 0 && voxel < count ? static_cast<int>(voxel) : -1;
}

VoxelField::Neighbours VoxelField::around(double coordinate, std::size_t axis) const {
  const double place = (coordinate - grid_.lower()[axis]) / grid_.spacing()[axis] - 0.5;
  const double below = std::floor(place);
  return {{wrapped(below, axis), wrapped(below + 1, axis)}, {1 - (place - below), place - below}};
}

/// A mean over voxels that have fluid.
class VoxelField::Mean {
 public:
  explicit Mean(const VoxelField& field) : field_(field) {}

  /// Adds a voxel; an index below 0 is beyond the grid.
  void add(double weight, const averaging::VoxelIndex& index) {
    if (index[0] < 0 || index[1] < 0 || index[2] < 0) return;
    const FeltFluid& voxel = field_.voxels_[field_.grid_.offset(index)];
    if (!voxel.known) return;
    sum_.add(weight, voxel);
    weights_ += weight;
  }

  /// Not known where no voxel has fluid.
  FeltFluid result() const {
    if (!(weights_ > 0)) return {};
    FeltFluid mean;
    mean.add(1 / weights_, sum_);
    mean.known = true;
    return mean;
  }

 private:
  const VoxelField& field_;
  FeltFluid sum_;
  double weights_ = 0;
};

FeltFluid VoxelField::at(const Vector& point) const {
  const std::array<Neighbours, 3> places{around(point[0], 0), around(point[1], 1), around(point[2], 2)};
  Mean mean(*this);
  for (std::size_t k = 0; k < 2; ++k)
    for (std::size_t j = 0; j < 2; ++j)
      for (std::size_t i = 0; i < 2; ++i) {
        const double weight = places[0].weight[i] * places[1].weight[j] * places[2].weight[k];
        mean.add(weight, {places[0].voxel[i], places[1].voxel[j], places[2].voxel[k]});
      }
  return mean.result();
}

FeltFluid VoxelField::over(const Vector& centre, double diameter) const {
  const double edge = std::cbrt(pi / 6) * diameter;
  Vector first{}, last{};  // ends of the cube, in voxels
  for (std::size_t axis = 0; axis < 3; ++axis) {
    first[axis] = (centre[axis] - edge / 2 - grid_.lower()[axis]) / grid_.spacing()[axis];
    last[axis] = first[axis] + edge / grid_.spacing()[axis];
  }
  const auto share = [&](int voxel, std::size_t axis) {
    const double lower = voxel;
    return (std::min(last[axis], lower + 1) - std::max(first[axis], lower)) / (last[axis] - first[axis]);
  };
  const auto from = [&](std::size_t axis) { return static_cast<int>(std::floor(first[axis])); };
  const auto to = [&](std::size_t axis) { return static_cast<int>(std::ceil(last[axis])); };
  Mean mean(*this);
  for (int z = from(2); z < to(2); ++z)
    for (int y = from(1); y < to(1); ++y)
      for (int x = from(0); x < to(0); ++x) {
        const double weight = share(x, 0) * share(y, 1) * share(z, 2);
        mean.add(weight, {wrapped(x, 0), wrapped(y, 1), wrapped(z, 2)});
      }
  return mean.result();
}

}  // namespace millfoam::dem_driver
