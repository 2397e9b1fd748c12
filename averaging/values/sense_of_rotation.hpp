// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace millfoam::averaging {

/// The sense of a rotation about z in words: "clockwise" or "anticlockwise", as seen with x to the right and
/// y up, or "none".
/// @param angular_velocity  about z, right-handed, rad/s
inline const char* sense_of_rotation(double angular_velocity) {
  if (angular_velocity == 0) return "none";
  return angular_velocity > 0 ? "anticlockwise" : "clockwise";
}

}  // namespace millfoam::averaging
