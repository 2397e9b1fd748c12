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
  superquadrics_.deposit_in(grid_, particle, shape, deposits);
}

}  // namespace millfoam::averaging
