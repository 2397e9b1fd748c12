// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/deposition/exact_box_deposition.hpp"

#include "meshing/surface/pi.hpp"

namespace millfoam::averaging {

void ExactBoxDeposition::deposit(const Particle& sphere, std::vector<Deposit>& deposits) {
  deposits.clear();
  const Vector3 centre = grid().wrapped(sphere.position);
  for (std::size_t a = 0; a < 3; ++a) {
    axes()[a].cut(centre[a], sphere.radius, sphere.id, voxels_[a], planes_[a]);
  }
  const auto& [vx, vy, vz] = voxels_;
  const auto add = [&](int x, int y, int z, double volume) {
    if (x == GridAxis::outside || y == GridAxis::outside || z == GridAxis::outside || volume == 0) return;
    deposits.push_back({grid().offset({x, y, z}), volume});
  };
  if (vx.size() * vy.size() * vz.size() == 1) {
    add(vx[0], vy[0], vz[0], 4.0 / 3.0 * pi * sphere.radius * sphere.radius * sphere.radius);
    return;
  }
  boxes_.cut(planes_, sphere.radius);
  const double* volume = boxes_.volumes().data();
  for (const int z : vz) {
    for (const int y : vy) {
      for (const int x : vx) add(x, y, z, *volume++);
    }
  }
}

}  // namespace millfoam::averaging
