// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/walls/moving_walls.hpp"

#include <algorithm>
#include <utility>

#include "averaging/walls/inside_volumes.hpp"

namespace millfoam::averaging {

namespace {

std::vector<double> volumes_inside(const std::variant<BoxGrid, CylinderGrid>& grid, const Surface& walls,
                                   const Eigen::Isometry3d& place) {
  return std::visit([&](const auto& voxels) { return inside_volumes(voxels, walls, place); }, grid);
}

}  // namespace

MovingWalls::MovingWalls(const std::variant<BoxGrid, CylinderGrid>& grid, const Surface& walls,
                         std::shared_ptr<const Motion> motion, double walls_time)
    : grid_(grid), walls_(walls), motion_(std::move(motion)), walls_time_(walls_time) {
  const std::vector<double> now = volumes_inside(grid_, walls_, Eigen::Isometry3d::Identity());
  if (std::all_of(now.begin(), now.end(), [](double volume) { return volume == 0; })) {
    throw SurfaceError(
        "the walls and the grid have no space in common; expected walls in m, in the lab's frame");
  }
  if (!motion_) at_rest_ = now;
}

std::vector<double> MovingWalls::inside_volumes(double time) const {
  if (!motion_) return at_rest_;
  return volumes_inside(grid_, walls_, motion_->place(time) * motion_->place(walls_time_).inverse());
}

}  // namespace millfoam::averaging
