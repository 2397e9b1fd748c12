// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "meshing/mill/mill.hpp"

namespace millfoam::meshing {

class Section;

/// Length of a periodic mill over the longest way through its largest ball, at least: in a shorter one a ball
/// could touch the same ball on both sides.
inline constexpr double fewest_diameters_of_period = 2;

/// The charge of the section `charge`, by classes or by fill.
/// @param in  that section
/// @param geometry  of the mill that the balls must fit into
/// @param density  of the balls, kg/m^3
/// Throws MillError for an impossible value, for both ways, and for balls that do not fit.
Charge read_charge(Section in, const Geometry& geometry, double density);

/// The same of a stirred mill: by classes, or by the share of the space up to a level that the balls take.
/// They are released around the shaft, between pins or discs and the lid.
/// @param in  the section `charge`
/// @param geometry  of the mill
/// @param density  of the balls, kg/m^3
/// Throws MillError as read_charge, for balls larger than the gap between the impeller and the
/// shell or the base (unless the section's `larger_than_gap` is true), and where there is no room above pins
/// and discs.
Charge read_stirred_charge(Section in, const Geometry& geometry, double density);

/// The number of whole balls with the mass of a size class.
struct BallCount {
  double diameter = 0;    ///< m
  double mass_asked = 0;  ///< kg
  double mass = 0;        ///< kg, of `count` balls
  long count = 0;         ///< the nearest whole number; may be 0
  bool simulated = true;  ///< false for fines (charge.fines_below)
  /// Spheres have none.
  std::optional<Superquadric> shape = std::nullopt;
};

/// The charge in numbers; lengths in m, masses in kg, volumes in m^3. They are of the simulated balls, unless
/// fines are named.
struct ChargeNumbers {
  std::vector<BallCount> classes;  ///< in the order of mill.yaml
  long balls = 0;                  ///< number of all
  double mass = 0;                 ///< of all balls
  double volume = 0;               ///< of the balls alone
  double fines_mass = 0;           ///< requested and left out
  double sauter_diameter = 0;      ///< Σm/Σ(m/d)
  double sphericity = 1;           ///< mean by mass
  double smallest_diameter = 0;    ///< of a ball
  double largest_diameter = 0;     ///< of a ball
  double load = 0;                 ///< bulk volume at rest over the mill's
  double load_asked = 0;           ///< the same with the fines
  double pore_volume = 0;          ///< of the resting charge
};

/// Counts the balls of a mill.
ChargeNumbers count_charge(const Mill& mill);

/// The key of a class, counted from 0. A charge of one class may be given without a list of classes.
std::string key_of_class(const Mill& mill, std::size_t number);

/// Throws KeyError for a class that is simulated and has no ball: it would still set the time-step and the
/// softness of the balls that there are, and the sizes of voxels.
void require_balls(const Mill& mill);

/// Balls of one class, as their drag needs them.
struct ClassShape {
  double share = 0;       ///< of the volume of all balls
  double sphericity = 1;  ///< also crosswise, as orientations are random
};

/// The classes that are simulated and have balls; empty without balls.
std::vector<ClassShape> class_shapes(const ChargeNumbers& charge);

/// Mass of one ball, density π/6 d³, kg.
double ball_mass(const Mill& mill, double diameter);

}  // namespace millfoam::meshing
