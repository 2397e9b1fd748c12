// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "averaging/deposition/deposition.hpp"
#include "averaging/values/ledger.hpp"
#include "averaging/values/particle.hpp"

namespace millfoam::averaging {

/// Sums over the particles of one record, per cell of a grid of n cells. V is the part of a particle's volume
/// in the cell, d the diameter of the sphere of the particle's volume, v its velocity along the
/// directions of the deposition.
struct RecordSums {
  /// The extensive quantities of a cell, side by side so that they can be smoothed and moved together.
  enum Column : std::size_t {
    volume,                               ///< sum V, m^3
    momentum,                             ///< sum V v, three columns, m^4/s
    volume_over_diameter = momentum + 3,  ///< sum V/d, m^2
    volume_times_diameter,                ///< sum V d, m^4
    volume_times_speed2,                  ///< sum V |v|^2, m^5/s^2
    balls,                                ///< number of balls, a part of a ball counting as that part
    columns
  };

  std::vector<double> values;        ///< [n][columns]
  std::vector<double> cell_volumes;  ///< [n] inside the mill, for balls and fluid, at this time, m^3
  Ledger ledger;                     ///< of the record, m^3

  std::size_t cells() const { return cell_volumes.size(); }  ///< their number
  /// The entry of a cell and Column.
  double at(std::size_t cell, std::size_t column) const { return values[cell * columns + column]; }
  /// The same, for changes.
  double& at(std::size_t cell, std::size_t column) { return values[cell * columns + column]; }
};

/// Deposits all particles of a record in the cells at a DEM time, s. `sums` is overwritten; its storage is
/// used again. Throws as `Deposition`.
void sum_record(Deposition& deposition, const ParticleRecord& record, double time, RecordSums& sums);

}  // namespace millfoam::averaging
