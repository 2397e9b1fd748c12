// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <variant>
#include <vector>

#include "averaging/grids/box_grid.hpp"
#include "averaging/grids/cylinder_grid.hpp"
#include "averaging/mesh/motion.hpp"
#include "averaging/walls/surface.hpp"

namespace millfoam::averaging {

/// The room inside the mill in the voxels of a grid of the lab frame, while the walls move.
class VoxelRoom {
 public:
  /// @param walls  the mill's surface at the DEM time `walls_time`, s
  /// @param motion  of the walls; null when they are at rest
  VoxelRoom(const std::variant<BoxGrid, CylinderGrid>& grid, const Surface& walls,
            std::shared_ptr<const Motion> motion, double walls_time);

  /// [voxels] volume inside the mill at a DEM time, s, in m^3.
  std::vector<double> volumes(double time) const;

 private:
  std::variant<BoxGrid, CylinderGrid> grid_;
  Surface walls_;
  std::shared_ptr<const Motion> motion_;
  double walls_time_;
  std::vector<double> at_rest_;  ///< empty when the walls move
};

}  // namespace millfoam::averaging
