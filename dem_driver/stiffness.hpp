// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "dem_driver/contact.hpp"
#include "meshing/mill/mill.hpp"

namespace millfoam::dem_driver {

/// Softest modulus that LIGGGHTS accepts in SI units, Pa.
inline constexpr double smallest_modulus = 5e6;

/// Hardest modulus that LIGGGHTS accepts in SI units without the command `hard_particles yes`, Pa.
inline constexpr double largest_soft_modulus = 1e9;

/// The pair of bodies that is pressed the furthest together.
struct ExpectedOverlap {
  std::string pair;  ///< for example "2 mm on 8 mm"
  double ratio = 0;  ///< overlap over the smaller diameter
};

/// Hardest impact to expect: a free fall through the mill's diameter plus the shell's speed, m/s.
double expected_impact_speed(const meshing::Mill& mill);

/// The largest overlap over the smaller diameter of all pairs at the expected impact speed.
ExpectedOverlap expected_overlap(const meshing::Mill& mill, const Stiffness& stiffness);

/// The stiffness of a `mill.yaml`: its dem.youngs_modulus, or the softest with which the
/// largest expected overlap stays within dem.largest_overlap, never stiffer than the real ball. Throws
/// meshing::KeyError when a modulus is softer than LIGGGHTS accepts.
Stiffness choose_stiffness(const meshing::Mill& mill);

}  // namespace millfoam::dem_driver
