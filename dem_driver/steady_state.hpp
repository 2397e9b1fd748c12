// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

namespace millfoam::dem_driver {

/// The mean of the end of a series.
struct SteadyMean {
  std::size_t begin = 0;      ///< index of the first value that counts, as a whole or in part
  double mean = 0;            ///< of the values
  double standard_error = 0;  ///< of the mean, from batch means about their line
  double drift = 0;           ///< mean of the second half minus that of the first half
};

/// With fewer turns the error of a mean over whole turns is not known.
inline constexpr double fewest_turns = 4;

/// The mean of equally spaced values, each of which is a mean since the one before.
/// @param values  of the series
/// @param begin  index of the first value; at least one value must follow
/// @param turn  of the mill, in values; it need not be a whole number. The mean is that of as many whole
/// turns before the series' end as fit, up to the largest multiple of a batch, and so are the halves. A batch
/// is a turn, of twenty or more turns as many as make ten or more batches. With 0, or if fewer than
/// `fewest_turns` fit, all values count, in ten batches; of fewer than ten values the error is NaN
SteadyMean mean_since(const std::vector<double>& values, std::size_t begin, double turn);

/// Whether and from where on a series of equally spaced values is steady.
struct Steadiness {
  bool steady = false;    ///< whether the values after the transient are
  std::size_t begin = 0;  ///< index of the first value that counts, after the transient
  double mean = 0;        ///< of the values from there on
  /// Of that mean, from batch means about their line; NaN where it is not known, of too few values
  double standard_error = std::numeric_limits<double>::quiet_NaN();
  double drift = 0;  ///< mean of the second half of these values minus that of the first half
};

/// Share of the series' scale (mean or range after the cut, whichever is larger) that its drift may be where
/// its noise is less.
inline constexpr double allowed_drift = 0.02;
/// With fewer values nothing is steady.
inline constexpr std::size_t fewest_values = 40;

/// Cuts off the transient so that the marginal standard error of the rest is least (K. P. White, Simulation
/// 69 (1997) 323), looking at the first half only, and calls the rest steady when the cut is before the half
/// and its drift is within three of its own standard errors or `allowed_drift`.
/// @param values  of the series
/// @param turn  as of mean_since
Steadiness judge_steadiness(const std::vector<double>& values, double turn = 0);

}  // namespace millfoam::dem_driver
