// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/sharing/box_sharing.hpp"

namespace millfoam::averaging {

BoxSharing::BoxSharing(const BoxGrid& grid, int template_points)
    : grid_(grid),
      axes_{CellAxis::of(grid, 0), CellAxis::of(grid, 1), CellAxis::of(grid, 2)},
      volumes_(std::make_shared<const std::vector<double>>(grid.size(), grid.voxel_volume())),
      superquadrics_(template_points) {}

void BoxSharing::share(const Particle& particle, const Superquadric& shape, std::vector<Share>& shares) {
  const auto locate = [this](const Vector3& point) -> std::optional<std::size_t> {
    const std::optional<VoxelIndex> voxel = grid_.locate(point);
    if (!voxel) return std::nullopt;
    return grid_.offset(*voxel);
  };
  superquadrics_.share(particle, shape, locate, shares);
}

}  // namespace millfoam::averaging
