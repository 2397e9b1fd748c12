// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <iosfwd>
#include <optional>
#include <vector>

#include "meshing/mill/mill.hpp"

namespace millfoam::dem_driver {

/// The number of balls with the mass of one size class.
struct ClassCount {
  double diameter = 0;       ///< m
  double mass_asked = 0;     ///< kg
  double mass_realised = 0;  ///< kg, of `count` whole balls
  long count = 0;            ///< whole balls
  /// Their shape; spheres have none.
  std::optional<meshing::Superquadric> shape = std::nullopt;
  double surface() const;  ///< m^2, of all its balls
};

/// Balls of one size and shape that are put in at one moment.
struct Insertion {
  double diameter = 0;  ///< m
  long count = 0;       ///< balls put in by this insertion
  /// Their shape; spheres have none.
  std::optional<meshing::Superquadric> shape = std::nullopt;
  double reach() const;  ///< m, from a ball's centre to its farthest point
};

/// Insertions, one after the other, before the balls fall.
using Round = std::vector<Insertion>;

/// The charge as whole balls, and the order in which they enter the mill.
struct ChargePlan {
  std::vector<ClassCount> classes;  ///< that are simulated, largest first
  std::vector<ClassCount> fines;    ///< left out of the simulation (charge.fines_below), largest first
  std::vector<Round> rounds;        ///< largest first; every ball of `classes` is in exactly one insertion
  double round_settle_time = 0;     ///< s, that the balls of a round fall before the next round comes
  long balls() const;               ///< number of balls that are simulated
  double mass() const;              ///< kg realised
  double fines_mass() const;        ///< kg, requested, of the classes that are left out
  double asked_mass() const;        ///< kg, requested, of all classes, fines too
  bool has_shapes() const;          ///< whether not all balls that are simulated are spheres
};

/// Random insertion without overlap jams near a solidity of 0.38; a round fills the free part of the start
/// cylinder to this much.
inline constexpr double round_solidity = 0.2;
/// Solidity of a heap at rest, low on purpose: what lies in the start cylinder from earlier rounds is not
/// free.
inline constexpr double heap_solidity = 0.6;

/// Counts the balls of each class by mass, n = round(mass/ball_mass), and cuts them into rounds. The mill has
/// a class to simulate (simulated_classes). Throws meshing::KeyError when a simulated class results in no
/// ball, when a ball is larger than the start cylinder, or when the charge does not fit into the start
/// cylinder.
ChargePlan plan_charge(const meshing::Mill& mill);

/// Prints the requested and realised mass per class, and the fines that are left out.
void print_charge(std::ostream& out, const ChargePlan& plan);

/// Writes the books of the charge as CSV: diameter_m, balls, mass_kg, surface_m2 and simulated (1 or 0) of
/// every class, fines last.
void write_charge_books(std::ostream& out, const ChargePlan& plan);

}  // namespace millfoam::dem_driver
