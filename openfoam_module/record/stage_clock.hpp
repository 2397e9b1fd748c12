// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <string>
#include <utility>
#include <vector>

namespace millfoam::record {

/// Wall time of a program by the stages of its loop. One stage runs at a time.
class StageClock {
 public:
  /// Time of each stage, s, in the order in which the stages first ran.
  using Times = std::vector<std::pair<std::string, double>>;

  /// Ends the stage that runs, if any, and begins another one.
  /// @param stage  its name; time adds up over all its runs
  void begin(const std::string& stage);

  /// The times up to now, with that of the stage that runs.
  Times times() const;

 private:
  using Clock = std::chrono::steady_clock;
  Times times_;
  std::size_t running_ = 0;  ///< in times_
  Clock::time_point since_ = Clock::now();
};

}  // namespace millfoam::record
