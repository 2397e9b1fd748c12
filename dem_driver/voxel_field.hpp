// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "averaging/files/slurry_reader.hpp"
#include "averaging/grids/box_grid.hpp"

namespace millfoam::dem_driver {

/// Three components along x, y, z.
using Vector = std::array<double, 3>;

/// A flow at a point, as a ball there feels it.
struct FeltFluid {
  bool known = false;    ///< false: there is no fluid around the point
  Vector pressure = {};  ///< -grad p, N/m^3
  Vector drag = {};      ///< drag_force of BallFields, N/m^3
  double exchange = 0;   ///< K, kg/(m^3 s)
  double solidity = 0;   ///< share of the balls
  double diameter = 0;   ///< Sauter mean, m

  /// Adds the values of another, times a weight; `known` stays.
  void add(double weight, const FeltFluid& other);
};

/// A flow on voxels. `at` is trilinear between the centres of those that have fluid, and periodic where the
/// grid is.
class VoxelField {
 public:
  /// No fluid anywhere.
  explicit VoxelField(const averaging::BoxGrid& grid);
  /// @param grid  of the voxels
  /// @param fields  on the grid
  VoxelField(const averaging::BoxGrid& grid, const averaging::BallFields& fields);

  /// The flow at a point (m, lab frame); not known where none of the eight voxels around it has fluid.
  FeltFluid at(const Vector& point) const;

  /// The flow over a ball: the mean over a cube of the ball's volume, of values that are constant in a voxel.
  /// Not known where no voxel that it meets has fluid.
  FeltFluid over(const Vector& centre, double diameter) const;

 private:
  class Mean;
  /// The voxels around a point along an axis; -1: beyond the box.
  struct Neighbours {
    std::array<int, 2> voxel;
    std::array<double, 2> weight;
  };

  Neighbours around(double coordinate, std::size_t axis) const;
  /// The voxel of this number along an axis, by the period where there is one; -1: beyond the box.
  int wrapped(double voxel, std::size_t axis) const;

  averaging::BoxGrid grid_;
  std::vector<FeltFluid> voxels_;
};

}  // namespace millfoam::dem_driver
