// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace millfoam {

/// The circle's circumference over its diameter.
inline constexpr double pi = 3.14159265358979323846;

}  // namespace millfoam
