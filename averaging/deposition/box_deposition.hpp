// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "averaging/deposition/deposition.hpp"
#include "averaging/deposition/superquadric_sampling.hpp"
#include "averaging/grids/box_grid.hpp"
#include "averaging/grids/grid_axis.hpp"

namespace millfoam::averaging {

/// The common part of all ways to deposit balls in the voxels of a box. Along periodic axes, parts beyond one
/// side of the box enter on the other side.
class BoxDeposition : public Deposition {
 public:
  const std::vector<double>& volumes() const override { return *volumes_; }

  /// By sampling; points outside the grid are dropped.
  using Deposition::deposit;
  void deposit(const Particle& particle, const Superquadric& shape, std::vector<Deposit>& deposits) override;

 protected:
  /// @param grid             where balls are deposited; it is copied
  /// @param template_points  points along a diameter for what is sampled
  BoxDeposition(const BoxGrid& grid, int template_points);
  BoxDeposition(const BoxDeposition&) = default;
  BoxDeposition& operator=(const BoxDeposition&) = default;

  const BoxGrid& grid() const { return grid_; }                  ///< where balls are deposited
  const std::array<GridAxis, 3>& axes() const { return axes_; }  ///< of the grid: x, y, z

 private:
  BoxGrid grid_;
  std::array<GridAxis, 3> axes_;
  std::shared_ptr<const std::vector<double>> volumes_;
  SuperquadricSampling superquadrics_;
};

}  // namespace millfoam::averaging
