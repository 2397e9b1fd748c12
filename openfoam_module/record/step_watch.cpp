// SPDX-License-Identifier: GPL-3.0-or-later
#include "openfoam_module/record/step_watch.hpp"

namespace millfoam::record {

StepLength StepWatch::add(double delta_t) {
  const double usual = median();
  if (!(delta_t > 1e-6 * usual)) return StepLength::diverged;
  const bool was_short = is_short_;
  is_short_ = delta_t < usual / 20;

  // Through the other half, so that each half keeps its order; the longer one has the middle of an odd number
  if (shorter_.size() < longer_.size()) {
    longer_.push(delta_t);
    shorter_.push(longer_.top());
    longer_.pop();
  } else {
    shorter_.push(delta_t);
    longer_.push(shorter_.top());
    shorter_.pop();
  }
  if (!is_short_) return StepLength::usual;
  return was_short ? StepLength::stays_short : StepLength::begins_short;
}

double StepWatch::median() const {
  return longer_.empty() ? 0 : longer_.top();
}

}  // namespace millfoam::record
