// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "averaging/run/average_request.hpp"
#include "averaging/values/solids_window.hpp"

namespace millfoam::averaging {

/// The windows [start + wT, start + (w+1)T) of a DEM run whose end is not known yet, by whole time-steps as
/// `plan_windows` cuts them.
class EndlessWindows {
 public:
  /// @param request  of the averages: their start and end
  /// @param windows  of the request: the series' length
  /// @param timestep  of the DEM run, s
  /// @param begin  time-step of the run's first record
  /// Throws WindowError.
  EndlessWindows(const AverageRequest& request, const WindowsRequest& windows, double timestep,
                 long long begin);

  /// Whether the record of a time-step is in a window.
  bool hold(long long step) const { return step >= start_ && (!end_ || step < *end_); }
  /// The number of its window, from 0; the only one over the whole run.
  std::size_t window_of(long long step) const;
  /// When a window begins and ends, s.
  TimeWindow time_of(std::size_t window) const;

 private:
  double timestep_;
  long long start_;
  std::optional<long long> length_;  ///< nothing: one window over the whole run
  std::optional<long long> end_;     ///< from which on the request leaves records out
};

}  // namespace millfoam::averaging
