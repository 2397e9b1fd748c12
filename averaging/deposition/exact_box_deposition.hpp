// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "averaging/deposition/box_deposition.hpp"
#include "averaging/overlap/sphere_box.hpp"

namespace millfoam::averaging {

/// Deposits in each voxel of a box the exact volume of a sphere in it (`SphereBoxes`): a sphere's deposits
/// add up to its volume within a few roundings, and a voxel that it does not meet gets none.
class ExactBoxDeposition : public BoxDeposition {
 public:
  /// @param grid             where balls are deposited; it is copied
  /// @param template_points  points along a diameter for superquadrics, which are sampled
  explicit ExactBoxDeposition(const BoxGrid& grid, int template_points = 12)
      : BoxDeposition(grid, template_points) {}

  std::unique_ptr<Deposition> clone() const override { return std::make_unique<ExactBoxDeposition>(*this); }

  /// Throws as `GridAxis::cut`.
  using BoxDeposition::deposit;
  void deposit(const Particle& sphere, std::vector<Deposit>& deposits) override;

 private:
  SphereBoxes boxes_;
  std::array<std::vector<double>, 3> planes_;  ///< between the voxels met, relative to the centre
  std::array<std::vector<int>, 3> voxels_;     ///< voxels met along each axis
};

}  // namespace millfoam::averaging
