// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "dem_driver/contact.hpp"
#include "meshing/mill/mill.hpp"

namespace millfoam::dem_driver {

/// Two size classes, or one and the wall.
struct NamedPair {
  std::string name;             ///< for example "2 mm on 8 mm"
  ContactPair pair;             ///< the moduli are softened as in the simulation
  ContactPair blunt;            ///< the same where superquadrics touch with their flat sides; else `pair`
  double smaller_diameter = 0;  ///< m
  double restitution = 0;       ///< coefficient of restitution, in (0, 1]
};

/// A length in words, for example "2 mm".
std::string millimetres(double length);

/// The size classes that are simulated: those not left out as fines. Throws meshing::KeyError when there is
/// none.
std::vector<meshing::SizeClass> simulated_classes(const meshing::Mill& mill);

/// Smallest diameter of them, m.
double smallest_simulated(const meshing::Mill& mill);

/// A ball's least radius of curvature, m; half the diameter of a sphere.
double least_radius(const meshing::SizeClass& size);

/// A class in words, for example "2 mm" or "2 mm of blockiness 4".
std::string in_words(const meshing::SizeClass& size);

/// Every pair of simulated classes, and every class with the wall. Superquadrics touch with their least
/// radius of curvature in `pair`, and in `blunt` with that of flat sides, dem.curvature_limit times that of
/// spheres.
std::vector<NamedPair> all_pairs(const meshing::Mill& mill, const Stiffness& stiffness);

}  // namespace millfoam::dem_driver
