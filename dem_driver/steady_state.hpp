// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

namespace millfoam::dem_driver {

/// Whether and from where on a series of equally spaced values is steady.
struct Steadiness {
  bool steady = false;        ///< whether the values after the transient are
  std::size_t begin = 0;      ///< index of the first value after the transient
  double mean = 0;            ///< of the values from there on
  double standard_error = 0;  ///< of that mean, from ten batch means about their line
  double drift = 0;           ///< mean of the second half of these values minus that of the first half
};

/// Share of the series' scale (mean or range after the cut, whichever is larger) that its drift may be where
/// its noise is less.
inline constexpr double allowed_drift = 0.02;
/// With fewer values nothing is steady.
inline constexpr std::size_t fewest_values = 40;

/// Cuts off the transient so that the marginal standard error of the rest is least (K. P. White, Simulation
/// 69 (1997) 323), looking at the first half only, and calls the rest steady when the cut is before the half
/// and its drift is within three of its own standard errors or `allowed_drift`.
Steadiness judge_steadiness(const std::vector<double>& values);

}  // namespace millfoam::dem_driver
