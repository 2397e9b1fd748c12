// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "averaging/statistics/record_sums.hpp"

namespace millfoam::averaging {

/// Sums and spreads over records, per cell: what the averages of a window are made of. Moments of
/// neighbouring runs of records can be made apart, by threads or ranks, and merged: the result depends on
/// where the runs are cut, not on who made them.
///
/// Means and sums of squared differences from them are kept as Welford 1962 (Technometrics 4:419), West 1979
/// (Comm ACM 22:532) and, merged, Chan, Golub & LeVeque 1983 (Am Stat 37:242).
class WindowMoments {
 public:
  /// Of no records yet.
  explicit WindowMoments(std::size_t cells);

  /// Adds the next record.
  void add(const RecordSums& record);

  /// Adds records that come after these.
  void merge(const WindowMoments& later);

  /// Back to no records; keeps the storage.
  void clear();

  std::size_t cells() const { return cells_; }                                   ///< their number
  long long records() const { return static_cast<long long>(totals_.records); }  ///< number of records added
  Ledger ledger() const { return totals_.ledger; }                               ///< sum over the records
  /// Number of cells of `least_solidity` or more, summed over the records.
  double occupied() const { return totals_.occupied; }
  /// Number of balls deposited, summed over the records.
  double balls() const { return totals_.balls; }

  /// Sum over the records of RecordSums' column.
  double sum(std::size_t cell, std::size_t column) const {
    return sums_[cell * RecordSums::columns + column];
  }
  /// Sum over the records of the cell's volume, m^3.
  double cell_volume(std::size_t cell) const { return spread(cell)[inside_volume]; }
  /// Mean square deviation of the records' solidities from their mean.
  double solidity_variance(std::size_t cell) const;
  /// The same of the records' mean velocities, weighted by the balls' volume; component 0 to 2, m^2/s^2.
  double velocity_variance(std::size_t cell, std::size_t component) const;

  /// Everything as plain numbers, to be sent or stored; `packed_size` of them.
  std::vector<double> packed() const;

  /// How many numbers the moments of so many cells are.
  static std::size_t packed_size(std::size_t cells);

  /// Takes over what `packed` gave for as many cells.
  void unpack(const std::vector<double>& numbers);

 private:
  /// Columns of the spreads.
  enum Spread : std::size_t {
    inside_volume,                         ///< sum of cell volumes
    solidity_mean,                         ///< of the records' solidities
    solidity_squares,                      ///< sum of squared differences from it
    velocity_mean,                         ///< of the records' velocities, weighted by volume; three columns
    velocity_squares = velocity_mean + 3,  ///< volume-weighted sum of squared differences; three columns
    spreads = velocity_squares + 3
  };
  struct Totals {
    double records = 0;
    double occupied = 0;
    double balls = 0;
    Ledger ledger;
  };
  static constexpr std::size_t totals_count = sizeof(Totals) / sizeof(double);

  const double* spread(std::size_t cell) const { return &spreads_[cell * spreads]; }
  void add_to_spread(const RecordSums& record, std::size_t cell);

  std::size_t cells_;
  Totals totals_;
  std::vector<double> sums_;     ///< [cells][RecordSums::columns]
  std::vector<double> spreads_;  ///< [cells][spreads]
};

}  // namespace millfoam::averaging
