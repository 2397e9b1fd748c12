// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <liggghts/atom.h>

#include <cmath>

#include "meshing/surface/pi.hpp"

namespace millfoam::dem_driver {

/// Radius of the sphere that has the volume of a ball of LIGGGHTS, m. LIGGGHTS' own radius of a superquadric
/// is that of the sphere around it.
/// @param number  of the ball on this rank
inline double ball_radius(const LAMMPS_NS::Atom& atom, int number) {
#ifdef SUPERQUADRIC_ACTIVE_FLAG
  if (atom.superquadric_flag) return std::cbrt(0.75 / pi * atom.volume[number]);
#endif
  return atom.radius[number];
}

}  // namespace millfoam::dem_driver
