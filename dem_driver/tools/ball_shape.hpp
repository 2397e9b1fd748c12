// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <liggghts/atom.h>

#include <array>
#include <cmath>
#include <map>

#include "meshing/mill/superquadric.hpp"
#include "meshing/surface/pi.hpp"

namespace millfoam::dem_driver {

/// Radius of the sphere that has the volume of a ball of LIGGGHTS, m. LIGGGHTS' own radius of a superquadric
/// is that of the sphere around it. The volume is by mass and density, which ghosts have too.
/// @param number  of the ball on this rank, which may be a ghost
inline double ball_radius(const LAMMPS_NS::Atom& atom, int number) {
  if (!atom.superquadric_flag) return atom.radius[number];
  return std::cbrt(0.75 / pi * atom.rmass[number] / atom.density[number]);
}

/// Sphericities of the shapes of LIGGGHTS' balls, each computed once.
class Sphericities {
 public:
  /// Of a ball of this rank; 1 for spheres.
  double of(const LAMMPS_NS::Atom& atom, int number) {
    if (!atom.superquadric_flag) return 1;
    const double *axes = atom.shape[number], blockiness = atom.blockiness[number][0];
    const meshing::Superquadric body{{axes[0], axes[1], axes[2]}, blockiness};
    const auto [known, is_new] = known_.try_emplace({axes[0], axes[1], axes[2], blockiness}, 0);
    if (is_new) known->second = meshing::sphericity(body);
    return known->second;
  }

 private:
  std::map<std::array<double, 4>, double> known_;  ///< by half axes and blockiness
};

}  // namespace millfoam::dem_driver
