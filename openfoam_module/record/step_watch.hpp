// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <queue>
#include <vector>

namespace millfoam::record {

/// What a time-step is next to the median of those before it.
enum class StepLength {
  usual,
  begins_short,  ///< below a twentieth of the median, unlike the step before it
  stays_short,   ///< below a twentieth, like the step before it
  diverged       ///< not above a millionth, or not a number
};

/// Watches the time-steps of a flow: steps that are far below the median show where a flow diverges.
class StepWatch {
 public:
  /// Judges a step, then counts it for the median. The first step is usual if it is above 0.
  /// A step that is `diverged` is not counted.
  /// @param delta_t  s
  StepLength add(double delta_t);

  /// Median of the steps that count, s: of an even number the larger one of the two in the middle; 0 before
  /// the first.
  double median() const;

 private:
  // The shorter half of the steps, the longest on top; and the longer half, the shortest on top
  std::priority_queue<double> shorter_;
  std::priority_queue<double, std::vector<double>, std::greater<>> longer_;
  bool is_short_ = false;  ///< the last step
};

}  // namespace millfoam::record
