// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "meshing/mill/mill.hpp"

namespace millfoam::meshing {

// Measures of the mill's interior in closed form. A lifter's section is bounded by a flat top `top_width`
// wide at `radius - height` from the axis, two straight sides from the top's corners to the feet on the
// shell `width` apart, and the shell's arc between them.

/// Area of one lifter's section, m^2: the trapezoid (w + t)/2 · (√(R²−w²/4) − (R−h)) and the circular segment
/// R² asin(w/2R) − w/2 · √(R²−w²/4) under it.
double lifter_section(const Geometry& geometry);

/// Area of the interior's cross-section, lifters taken out, m^2; of a stirred mill that of the shell.
double analytic_section(const Geometry& geometry);

/// Volume of the interior, lifters or impeller taken out and without pulp lifters, m^3: where the balls are.
double analytic_volume(const Geometry& geometry);

/// The same with the pulp lifters' compartments, m^3: where the slurry is.
double flow_volume(const Geometry& geometry);

/// Distance from the axis to a lifter's foot along the lifter's centre line, √(R²−w²/4), m; the radius for a
/// smooth drum.
double lifter_foot_distance(const Geometry& geometry);

/// Distance from the axis to the middle of the lifters' tops, m; the radius for a smooth drum.
double lifter_top_distance(const Geometry& geometry);

/// Distance from the axis to the corners of the lifters' tops, m; the radius for a smooth drum.
double lifter_corner_radius(const Geometry& geometry);

/// Half the angle under which a lifter's foot on the shell is seen from the axis, rad; 0 for a smooth drum.
double lifter_foot_half_angle(const Geometry& geometry);

/// Half the angle under which a lifter's top is seen from the axis, rad; 0 for a smooth drum.
double lifter_top_half_angle(const Geometry& geometry);

}  // namespace millfoam::meshing
