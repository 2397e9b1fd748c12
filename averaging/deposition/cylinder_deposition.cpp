// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/deposition/cylinder_deposition.hpp"

namespace millfoam::averaging {

namespace {

std::vector<double> volumes_of(const CylinderGrid& grid) {
  std::vector<double> volumes(grid.size());
  const auto rings = static_cast<std::size_t>(grid.shape()[0]);
  for (std::size_t n = 0; n < volumes.size(); ++n) {
    volumes[n] = grid.voxel_volume({static_cast<int>(n % rings), 0, 0});
  }
  return volumes;
}

}  // namespace

CylinderDeposition::CylinderDeposition(const CylinderGrid& grid, int template_points)
    : grid_(grid),
      z_axis_(GridAxis::along_z(grid)),
      volumes_(std::make_shared<const std::vector<double>>(volumes_of(grid))),
      superquadrics_(template_points) {}

void CylinderDeposition::deposit(const Particle& particle, const Superquadric& shape,
                                 std::vector<Deposit>& deposits) {
  superquadrics_.deposit_in(grid_, particle, shape, deposits);
}

}  // namespace millfoam::averaging
