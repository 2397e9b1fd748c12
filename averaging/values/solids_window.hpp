// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "averaging/values/ledger.hpp"

namespace millfoam::averaging {

/// A span of DEM time [begin, end), s, and the number of records (dumps) averaged in it.
struct TimeWindow {
  double begin = 0;          ///< s
  double end = 0;            ///< s, not included
  long long records = 0;     ///< averaged in it
  bool starts_late = false;  ///< records are missing at its beginning
  bool ends_short = false;   ///< or at the requested end
  long long expected = 0;    ///< records that would fill it; 0: not known
};

/// A cell of less solidity is not occupied: the tails of smoothing reach cells far from any ball.
inline constexpr double least_solidity = 1e-6;

/// What a flow needs of one window: fields over a grid of n cells, in the grid's C order. Empty cells hold 0.
struct SolidsWindow {
  std::vector<double>
      solidity;  ///< [n] particle volume over cell volume; above 1 only in cells smaller than balls
  std::vector<double> velocity;    ///< [n][3] volume-weighted velocity of the particles in the lab frame, m/s
  std::vector<double> diameter;    ///< [n] Sauter mean d32 = sum V / sum(V/d), m
  std::vector<double> diameter43;  ///< [n] d43 = sum(V d) / sum V, m
  /// [n] share of the cell inside the mill, mean over the window; empty unless walls cut the cells.
  /// `solidity` is by the volume inside.
  std::vector<double> inside_fraction;
};

/// Everything that is stored about one window.
struct WindowAverage {
  TimeWindow time;                           ///< what the window covers
  Ledger ledger;                             ///< means over the window's records
  SolidsWindow mean;                         ///< what a flow needs
  std::vector<double> number;                ///< [n] of balls, parts counting as parts, mean over the records
  std::vector<double> solidity_deviation;    ///< [n] standard deviation over the window's records
  std::vector<double> velocity_deviation;    ///< [n][3] the same, weighted by each record's solidity, m/s
  std::vector<double> granular_temperature;  ///< [n] third of the mean square velocity fluctuation, m^2/s^2
  /// Balls deposited / cells of `least_solidity` or more, both summed over the records.
  double balls_per_cell = 0;
};

}  // namespace millfoam::averaging
