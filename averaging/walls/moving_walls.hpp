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

/// The walls of a mill that moves, as they cut the voxels of a grid of the lab frame.
class MovingWalls {
 public:
  /// @param grid        of the lab frame, whose voxels are cut
  /// @param walls       the mill's surface at the DEM time `walls_time`
  /// @param motion      of the walls; null when they are at rest
  /// @param walls_time  s
  ///
  /// Throws SurfaceError when the walls enclose no part of the grid.
  MovingWalls(const std::variant<BoxGrid, CylinderGrid>& grid, const Surface& walls,
              std::shared_ptr<const Motion> motion, double walls_time);

  /// [voxels] volume inside the mill at a DEM time, s, in m^3. Throws as `Motion::place`.
  std::vector<double> inside_volumes(double time) const;

 private:
  std::variant<BoxGrid, CylinderGrid> grid_;
  Surface walls_;
  std::shared_ptr<const Motion> motion_;
  double walls_time_;
  std::vector<double> at_rest_;  ///< [voxels] volume inside, m^3; empty when the walls move
};

}  // namespace millfoam::averaging
