// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "averaging/deposition/deposition.hpp"
#include "averaging/deposition/superquadric_sampling.hpp"
#include "averaging/grids/cylinder_grid.hpp"
#include "averaging/grids/grid_axis.hpp"

namespace millfoam::averaging {

/// The common part of all ways to deposit balls in the voxels of a cylinder. Where the cylinder is periodic
/// along z, parts beyond one end enter at the other.
class CylinderDeposition : public Deposition {
 public:
  const std::vector<double>& volumes() const override { return *volumes_; }

  /// By sampling; points outside the grid are dropped.
  using Deposition::deposit;
  void deposit(const Particle& particle, const Superquadric& shape, std::vector<Deposit>& deposits) override;

 protected:
  /// @param grid             where balls are deposited; it is copied
  /// @param template_points  points along a diameter for what is sampled
  CylinderDeposition(const CylinderGrid& grid, int template_points);
  CylinderDeposition(const CylinderDeposition&) = default;
  CylinderDeposition& operator=(const CylinderDeposition&) = default;

  const CylinderGrid& grid() const { return grid_; }  ///< where balls are deposited
  const GridAxis& z_axis() const { return z_axis_; }  ///< of the grid

 private:
  CylinderGrid grid_;
  GridAxis z_axis_;
  std::shared_ptr<const std::vector<double>> volumes_;
  SuperquadricSampling superquadrics_;
};

}  // namespace millfoam::averaging
