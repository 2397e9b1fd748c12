// SPDX-License-Identifier: GPL-3.0-or-later
#include "openfoam_module/record/stage_clock.hpp"

#include <algorithm>

namespace millfoam::record {

void StageClock::begin(const std::string& stage) {
  times_ = times();
  since_ = Clock::now();
  const auto found =
      std::find_if(times_.begin(), times_.end(), [&](const auto& time) { return time.first == stage; });
  running_ = static_cast<std::size_t>(found - times_.begin());
  if (found == times_.end()) times_.emplace_back(stage, 0.0);
}

StageClock::Times StageClock::times() const {
  Times result = times_;
  if (!result.empty()) {
    result[running_].second += std::chrono::duration<double>(Clock::now() - since_).count();
  }
  return result;
}

}  // namespace millfoam::record
