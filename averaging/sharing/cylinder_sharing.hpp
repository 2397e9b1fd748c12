// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "averaging/grids/cylinder_grid.hpp"
#include "averaging/sharing/cell_axis.hpp"
#include "averaging/sharing/cell_sharing.hpp"
#include "averaging/sharing/superquadric_points.hpp"

namespace millfoam::averaging {

/// What sharing balls between the voxels of a cylinder has in common, however spheres are shared. Where the
/// cylinder is periodic along z, what leaves one end comes in at the other.
class CylinderSharing : public CellSharing {
 public:
  const std::vector<double>& volumes() const override { return *volumes_; }

  /// By sampling; points outside the grid are dropped.
  using CellSharing::share;
  void share(const Particle& particle, const Superquadric& shape, std::vector<Share>& shares) override;

 protected:
  CylinderSharing(const CylinderGrid& grid, int template_points);
  CylinderSharing(const CylinderSharing&) = default;
  CylinderSharing& operator=(const CylinderSharing&) = default;

  const CylinderGrid& grid() const { return grid_; }
  const CellAxis& z_axis() const { return z_axis_; }

 private:
  CylinderGrid grid_;
  CellAxis z_axis_;
  std::shared_ptr<const std::vector<double>> volumes_;
  SuperquadricPoints superquadrics_;
};

}  // namespace millfoam::averaging
