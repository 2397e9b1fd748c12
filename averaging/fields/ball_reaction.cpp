// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/fields/ball_reaction.hpp"

#include <cassert>

namespace millfoam::averaging {

void BallReaction::add(const std::array<SolidsShare, 8>& shares, double volume, const Vector3& force,
                       double coefficient, const Vector3& velocity) {
  for (const SolidsShare& one : shares) {
    if (!(one.solidity > 0)) continue;
    const double part = one.solidity * volume;
    double* const sums = &sums_[one.voxel * columns];
    sums[solids] += part;
    sums[exchange] += part * coefficient;
    for (std::size_t k = 0; k < 3; ++k) {
      sums[pressure + k] += part * force[k];
      sums[driven + k] += part * coefficient * velocity[k];
    }
  }
}

BallFields BallReaction::fields(const BoxGrid& grid, const SolidsWindow& window) const {
  assert(sums_.size() == grid.size() * columns);
  const std::size_t voxels = grid.size();
  BallFields fields;
  fields.inside.resize(voxels);
  fields.pressure_force.resize(3 * voxels);
  fields.exchange.resize(voxels);
  fields.drag_force.resize(3 * voxels);
  fields.solidity = window.solidity;
  fields.diameter = window.diameter;
  for (std::size_t n = 0; n < voxels; ++n) {
    const double* const sums = &sums_[n * columns];
    const double share = window.inside_fraction.empty() ? 1 : window.inside_fraction[n];
    // By the balls' own volume, so that what they take is what the cells gave
    const double volume = window.solidity[n] * share * grid.voxel_volume();
    if (!(sums[solids] > 0 && volume > 0)) continue;
    fields.inside[n] = share;
    fields.exchange[n] = sums[exchange] / volume;
    for (std::size_t k = 0; k < 3; ++k) {
      fields.pressure_force[3 * n + k] = sums[pressure + k] / volume;
      fields.drag_force[3 * n + k] = sums[driven + k] / volume;
    }
  }
  return fields;
}

}  // namespace millfoam::averaging
