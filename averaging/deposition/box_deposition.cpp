// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/deposition/box_deposition.hpp"

namespace millfoam::averaging {

BoxDeposition::BoxDeposition(const BoxGrid& grid, int template_points)
    : grid_(grid),
      axes_{GridAxis::of(grid, 0), GridAxis::of(grid, 1), GridAxis::of(grid, 2)},
      volumes_(std::make_shared<const std::vector<double>>(grid.size(), grid.voxel_volume())),
      superquadrics_(template_points) {}

void BoxDeposition::deposit(const Particle& particle, const Superquadric& shape,
                            std::vector<Deposit>& deposits) {
  const auto locate = [this](const Vector3& point) -> std::optional<std::size_t> {
    const std::optional<VoxelIndex> voxel = grid_.locate(point);
    if (!voxel) return std::nullopt;
    return grid_.offset(*voxel);
  };
  superquadrics_.deposit(particle, shape, locate, deposits);
}

}  // namespace millfoam::averaging
