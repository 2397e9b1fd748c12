// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "meshing/mill.hpp"

namespace millfoam::meshing {

/// Measures of the mill's interior in closed form. A lifter's section is bounded by two parallel sides
/// `width` apart, a flat top at `radius - height` from the axis, and the shell's arc under it.

/// Area of one lifter's section, m^2: ∫ (√(R²−y²) − (R−h)) dy over |y| < w/2.
double lifter_section(const Geometry& geometry);

/// Area of the interior's cross-section, lifters taken out, m^2.
double analytic_section(const Geometry& geometry);

/// Volume of the interior, lifters taken out, m^3.
double analytic_volume(const Geometry& geometry);

/// Distance from the axis to the corners of the lifters' tops, m; the radius for a smooth drum.
double lifter_corner_radius(const Geometry& geometry);

/// Half the angle under which a lifter's foot on the shell is seen from the axis, rad; 0 for a smooth drum.
double lifter_foot_half_angle(const Geometry& geometry);

/// Half the angle under which a lifter's top is seen from the axis, rad; 0 for a smooth drum.
double lifter_top_half_angle(const Geometry& geometry);

}  // namespace millfoam::meshing
