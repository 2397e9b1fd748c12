// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "averaging/grids/box_grid.hpp"
#include "averaging/sharing/cell_axis.hpp"
#include "averaging/sharing/cell_sharing.hpp"
#include "averaging/sharing/superquadric_points.hpp"

namespace millfoam::averaging {

/// What sharing balls between the voxels of a box has in common, however spheres are shared. Along periodic
/// axes what leaves the box comes in on the other side.
class BoxSharing : public CellSharing {
 public:
  const std::vector<double>& volumes() const override { return *volumes_; }

  /// By sampling; points outside the grid are dropped.
  using CellSharing::share;
  void share(const Particle& particle, const Superquadric& shape, std::vector<Share>& shares) override;

 protected:
  BoxSharing(const BoxGrid& grid, int template_points);
  BoxSharing(const BoxSharing&) = default;
  BoxSharing& operator=(const BoxSharing&) = default;

  const BoxGrid& grid() const { return grid_; }
  const std::array<CellAxis, 3>& axes() const { return axes_; }

 private:
  BoxGrid grid_;
  std::array<CellAxis, 3> axes_;
  std::shared_ptr<const std::vector<double>> volumes_;
  SuperquadricPoints superquadrics_;
};

}  // namespace millfoam::averaging
