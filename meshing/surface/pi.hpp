// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// Everything of millFoam; each room has its own namespace.
namespace millfoam {

/// The circle's circumference over its diameter.
inline constexpr double pi = 3.14159265358979323846;

}  // namespace millfoam
