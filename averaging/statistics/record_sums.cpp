// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/statistics/record_sums.hpp"

#include <cassert>
#include <cmath>

#include "averaging/overlap/superquadric.hpp"
#include "meshing/surface/pi.hpp"

namespace millfoam::averaging {

namespace {

/// Adds the deposits of one particle of velocity v and returns their volume, m^3.
double add_deposits(const Vector3& v, double diameter, double particle_volume,
                    const std::vector<Deposit>& deposits, RecordSums& sums) {
  const double speed2 = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
  double deposited = 0;
  for (const Deposit& deposit : deposits) {
    double* const cell = &sums.values[deposit.cell * RecordSums::columns];
    cell[RecordSums::volume] += deposit.volume;
    for (std::size_t a = 0; a < 3; ++a) cell[RecordSums::momentum + a] += deposit.volume * v[a];
    cell[RecordSums::volume_over_diameter] += deposit.volume / diameter;
    cell[RecordSums::volume_times_diameter] += deposit.volume * diameter;
    cell[RecordSums::volume_times_speed2] += deposit.volume * speed2;
    cell[RecordSums::balls] += deposit.volume / particle_volume;
    deposited += deposit.volume;
  }
  return deposited;
}

}  // namespace

void sum_record(Deposition& deposition, const ParticleRecord& record, double time, RecordSums& sums) {
  assert(record.shapes.empty() || record.shapes.size() == record.particles.size());
  deposition.begin_record(time);
  sums.cell_volumes = deposition.volumes();
  sums.values.assign(sums.cell_volumes.size() * RecordSums::columns, 0.0);
  sums.ledger = {};
  std::vector<Deposit> deposits;
  for (std::size_t p = 0; p < record.particles.size(); ++p) {
    const Particle& particle = record.particles[p];
    double diameter = 2 * particle.radius;
    double particle_volume = pi / 6 * diameter * diameter * diameter;
    if (record.shapes.empty()) {
      deposition.deposit(particle, deposits);
    } else {
      particle_volume = superquadric_volume(record.shapes[p]);
      diameter = volume_equivalent_diameter(record.shapes[p]);
      deposition.deposit(particle, record.shapes[p], deposits);
    }
    const double deposited =
        add_deposits(deposition.field_velocity(particle), diameter, particle_volume, deposits, sums);
    sums.ledger.volume_in += particle_volume;
    sums.ledger.deposited += deposited;
    // A ball wholly inside is deposited to rounding, which is not a loss.
    const double left = particle_volume - deposited;
    if (left > 1e-14 * particle_volume) sums.ledger.outside += left;
  }
}

}  // namespace millfoam::averaging
