// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/grids/field_sampling.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "averaging/grids/cylindrical.hpp"

namespace millfoam::averaging {

namespace {

/// Equal steps along one coordinate of a grid.
struct Axis {
  double lower;
  double spacing;
  int shape;
  bool periodic;
};

std::array<Axis, 3> axes(const BoxGrid& grid) {
  const auto axis = [&](std::size_t a) {
    return Axis{grid.lower()[a], grid.spacing()[a], grid.shape()[a], grid.periodic()[a]};
  };
  return {axis(0), axis(1), axis(2)};
}

std::array<Axis, 3> axes(const CylinderGrid& grid) {
  const auto [dr, dtheta, dz] = grid.spacing();
  const auto [nr, ntheta, nz] = grid.shape();
  return {Axis{grid.radii()[0], dr, nr, false}, Axis{0, dtheta, ntheta, true},
          Axis{grid.ends()[0], dz, nz, grid.periodic_z()}};
}

/// A point in the grid's own coordinates.
Vector3 coordinates(const BoxGrid&, const Vector3& point) {
  return point;
}

Vector3 coordinates(const CylinderGrid&, const Vector3& point) {
  return {std::hypot(point[0], point[1]), std::atan2(point[1], point[0]), point[2]};
}

/// The two voxels along one axis whose centres a point lies between, and the share of the upper one.
struct Neighbours {
  std::array<int, 2> voxel;
  std::array<double, 2> weight;
};

Neighbours neighbours(const Axis& axis, double coordinate) {
  const double place = (coordinate - axis.lower) / axis.spacing - 0.5;
  const double floor = std::floor(place);
  const int lower = static_cast<int>(floor);
  const auto valid = [&](int voxel) {
    return axis.periodic ? (voxel + axis.shape) % axis.shape : std::clamp(voxel, 0, axis.shape - 1);
  };
  return {{valid(lower), valid(lower + 1)}, {1 - (place - floor), place - floor}};
}

/// Sums of phi, phi*u, phi/d32 and phi*d43 with weights.
struct Blend {
  double weights = 0;
  double solidity = 0;
  Vector3 flux{};
  double solidity_over_diameter = 0;
  double solidity_times_diameter = 0;

  void add(const SolidsWindow& window, std::size_t n, double weight) {
    if (!window.inside_fraction.empty()) weight *= window.inside_fraction[n];
    weights += weight;
    const double share = weight * window.solidity[n];
    if (share == 0) return;
    solidity += share;
    for (std::size_t a = 0; a < 3; ++a) flux[a] += share * window.velocity[3 * n + a];
    solidity_over_diameter += share / window.diameter[n];
    solidity_times_diameter += share * window.diameter43[n];
  }

  LocalSolids divided() const {
    LocalSolids local;
    local.inside = true;
    if (solidity == 0) return local;
    local.solidity = solidity / weights;
    for (std::size_t a = 0; a < 3; ++a) local.velocity[a] = flux[a] / solidity;
    local.diameter = solidity / solidity_over_diameter;
    local.diameter43 = solidity_times_diameter / solidity;
    return local;
  }
};

/// Calls `take` with the offsets of the eight voxels around a point, and their trilinear weights.
template <typename Voxels, typename Take>
void for_voxels_around(const Voxels& grid, const Vector3& point, const Take& take) {
  const Vector3 at = coordinates(grid, grid.wrapped(point));
  const std::array<Axis, 3> axis = axes(grid);
  const std::array<Neighbours, 3> along{neighbours(axis[0], at[0]), neighbours(axis[1], at[1]),
                                        neighbours(axis[2], at[2])};
  for (std::size_t k = 0; k < 2; ++k)
    for (std::size_t j = 0; j < 2; ++j)
      for (std::size_t i = 0; i < 2; ++i)
        take(grid.offset({along[0].voxel[i], along[1].voxel[j], along[2].voxel[k]}),
             along[0].weight[i] * along[1].weight[j] * along[2].weight[k]);
}

template <typename Voxels>
LocalSolids sample_linear(const Voxels& grid, const SolidsWindow& window, const Vector3& point) {
  Blend blend;
  for_voxels_around(grid, point, [&](std::size_t n, double weight) { blend.add(window, n, weight); });
  return blend.divided();
}

LocalSolids sample_cell(const SolidsWindow& window, std::size_t n) {
  return {window.solidity[n],
          {window.velocity[3 * n], window.velocity[3 * n + 1], window.velocity[3 * n + 2]},
          window.diameter[n],
          window.diameter43[n],
          true};
}

template <typename Voxels>
LocalSolids sample_voxels(const Voxels& grid, const SolidsWindow& window, const Vector3& point,
                          Interpolation interpolation) {
  assert(window.solidity.size() == grid.size() && window.velocity.size() == 3 * grid.size());
  const std::optional<VoxelIndex> voxel = grid.locate(point);
  if (!voxel) return {};
  return interpolation == Interpolation::cell ? sample_cell(window, grid.offset(*voxel))
                                              : sample_linear(grid, window, point);
}

}  // namespace

LocalSolids sample(const BoxGrid& grid, const SolidsWindow& window, const Vector3& point,
                   Interpolation interpolation) {
  return sample_voxels(grid, window, point, interpolation);
}

std::array<SolidsShare, 8> solids_shares(const BoxGrid& grid, const SolidsWindow& window,
                                         const Vector3& point) {
  std::array<SolidsShare, 8> shares{};
  if (!grid.locate(point)) return shares;
  std::size_t next = 0;
  double weights = 0;
  for_voxels_around(grid, point, [&](std::size_t n, double weight) {
    if (!window.inside_fraction.empty()) weight *= window.inside_fraction[n];
    shares[next++] = {n, weight * window.solidity[n]};
    weights += weight;
  });
  for (SolidsShare& one : shares) one.solidity = weights > 0 ? one.solidity / weights : 0;
  return shares;
}

LocalSolids sample(const CylinderGrid& grid, const SolidsWindow& window, const Vector3& point,
                   Interpolation interpolation, double time) {
  LocalSolids local = sample_voxels(grid, window, grid.in_own_frame(point, time), interpolation);
  if (grid.frame().cylindrical) local.velocity = to_cartesian(local.velocity, point);
  return local;
}

}  // namespace millfoam::averaging
