// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace millfoam::record {

/// The sense of a rotation as a part of a sentence, with how it is looked at: "clockwise, seen with x to the
/// right and y up", or "does not turn".
/// @param angular_velocity  about z, right-handed, rad/s
std::string described_rotation(double angular_velocity);

}  // namespace millfoam::record
