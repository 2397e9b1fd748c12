// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "meshing/mill/mill.hpp"

namespace millfoam::meshing {

/// Smallest circle that the O-grid holds, in units of the distance from the axis to the lifters' tops. A
/// smaller inlet is made of whole quadrilaterals of the core.
inline constexpr double smallest_circle = 0.25;

/// Relative difference of radii below which two circles become one, the smaller: an area inside is then at
/// most 1 % wrong, and cells between the two would be needles.
inline constexpr double same_circle = 0.005;

/// Radii of inlet, grates and discharge opening, ascending, m: circles that sides of quadrilaterals follow.
/// An inlet smaller than the smallest circle has none. A periodic slice has those of the whole mill.
std::vector<double> opening_circles(const Geometry& geometry);

/// Requested area of the inlet, m^2; 0 without one.
double asked_inlet_area(const Geometry& geometry);

/// Requested area of all grates, holes and bars together, m^2; 0 without grates.
double asked_grate_area(const Geometry& geometry);

}  // namespace millfoam::meshing
