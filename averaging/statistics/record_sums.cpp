// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/statistics/record_sums.hpp"

#include <cassert>
#include <cmath>

#include "averaging/overlap/superquadric.hpp"
#include "averaging/values/pi.hpp"

namespace millfoam::averaging {

namespace {

/// Adds the shares of one particle and returns their volume.
double add_shares(const Particle& particle, double diameter, double particle_volume,
                  const std::vector<Share>& shares, RecordSums& sums) {
  const Vector3& v = particle.velocity;
  const double speed2 = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
  double deposited = 0;
  for (const Share& share : shares) {
    double* const cell = &sums.values[share.cell * RecordSums::columns];
    cell[RecordSums::volume] += share.volume;
    for (std::size_t a = 0; a < 3; ++a) cell[RecordSums::momentum + a] += share.volume * v[a];
    cell[RecordSums::volume_over_diameter] += share.volume / diameter;
    cell[RecordSums::volume_times_diameter] += share.volume * diameter;
    cell[RecordSums::volume_times_speed2] += share.volume * speed2;
    cell[RecordSums::balls] += share.volume / particle_volume;
    deposited += share.volume;
  }
  return deposited;
}

}  // namespace

void sum_record(CellSharing& sharing, const ParticleRecord& record, double time, RecordSums& sums) {
  assert(record.shapes.empty() || record.shapes.size() == record.particles.size());
  sharing.begin_record(time);
  sums.cell_volumes = sharing.volumes();
  sums.values.assign(sums.cell_volumes.size() * RecordSums::columns, 0.0);
  sums.ledger = {};
  std::vector<Share> shares;
  for (std::size_t p = 0; p < record.particles.size(); ++p) {
    const Particle& particle = record.particles[p];
    double diameter = 2 * particle.radius;
    double particle_volume = pi / 6 * diameter * diameter * diameter;
    if (record.shapes.empty()) {
      sharing.share(particle, shares);
    } else {
      particle_volume = superquadric_volume(record.shapes[p]);
      diameter = volume_equivalent_diameter(record.shapes[p]);
      sharing.share(particle, record.shapes[p], shares);
    }
    const double deposited = add_shares(particle, diameter, particle_volume, shares, sums);
    sums.ledger.volume_in += particle_volume;
    sums.ledger.deposited += deposited;
    // A ball wholly inside is deposited to rounding, which is no loss.
    const double left = particle_volume - deposited;
    if (left > 1e-14 * particle_volume) sums.ledger.outside += left;
  }
}

}  // namespace millfoam::averaging
