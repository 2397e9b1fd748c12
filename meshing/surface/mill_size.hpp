// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace millfoam::surface {

/// Walls that are longer are given in another unit, m.
inline constexpr double largest_mill = 20;

}  // namespace millfoam::surface
