// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

namespace millfoam::averaging {

/// Three components along x, y, z: a position in m or a velocity in m/s.
using Vector3 = std::array<double, 3>;

}  // namespace millfoam::averaging
