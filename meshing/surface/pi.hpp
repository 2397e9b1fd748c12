// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace millfoam::meshing {

inline constexpr double pi = 3.14159265358979323846;

}  // namespace millfoam::meshing
