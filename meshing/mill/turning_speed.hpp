// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "meshing/mill/rules.hpp"

namespace millfoam::meshing {

/// How the speed of a kind of mill may be given: `angular_velocity` with its sign, or `sense` with `rpm` or
/// with one more key.
struct SpeedKeys {
  double slowest = 0;                      ///< rad/s, without sign
  double fastest = 0;                      ///< rad/s, without sign
  Rule angular_velocity;                   ///< for `angular_velocity`
  std::string other;                       ///< the kind's own key
  std::function<double()> read_other;      ///< the angular velocity that it gives, rad/s, without sign
  std::optional<std::string> usual_sense;  ///< unless given: the key `sense` is needed
};

/// Reads the section `speed`: the angular velocity, rad/s, negative for clockwise. Another speed that --set
/// gives turns the mill as the file's angular velocity does. Throws MillError.
double read_turning_speed(Section& in, const SpeedKeys& keys);

}  // namespace millfoam::meshing
