// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <iosfwd>
#include <string>

namespace millfoam::dem_driver {

/// A progress bar with the remaining time, by the rate since the first step shown (what a resumed run had
/// done before took no time of this one): one line that is written over on a terminal, else a line every 10
/// %.
class Progress {
 public:
  /// `total` is the number of steps of the whole job; `terminal` says whether `out` is one.
  Progress(std::ostream& out, bool terminal, long total);

  /// Shows that `done` steps are done; `what` names the present part of the job.
  void show(long done, const std::string& what);

  /// Ends the line on a terminal.
  void end();

 private:
  std::ostream& out_;
  bool terminal_;
  long total_;
  int shown_ = -1;
  long first_ = 0;  ///< of the steps shown, the first above 0; `start_` is its time
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace millfoam::dem_driver
