// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <liggghts/atom.h>

#include <cmath>

#include "meshing/surface/pi.hpp"

namespace millfoam::dem_driver {

/// Radius of the sphere that has the volume of a ball of LIGGGHTS, m. LIGGGHTS' own radius of a superquadric
/// is that of the sphere around it. The volume is by mass and density, which ghosts have too.
/// @param number  of the ball on this rank, which may be a ghost
inline double ball_radius(const LAMMPS_NS::Atom& atom, int number) {
  if (!atom.superquadric_flag) return atom.radius[number];
  return std::cbrt(0.75 / pi * atom.rmass[number] / atom.density[number]);
}

}  // namespace millfoam::dem_driver
