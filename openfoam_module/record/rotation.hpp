// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace millfoam::record {

/// The sense of a rotation about z in words: "clockwise" or "anticlockwise", as seen with x to the right and
/// y up, or "none".
/// @param angular_velocity  about z, right-handed, rad/s
std::string sense_of_rotation(double angular_velocity);

/// The same as a part of a sentence, with how it is looked at: "clockwise, seen with x to the right and y
/// up", or "does not turn".
std::string described_rotation(double angular_velocity);

}  // namespace millfoam::record
