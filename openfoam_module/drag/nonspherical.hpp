// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// @file
/// Drag of a bed of balls that are not spheres. It needs their shape, so it is not one of the table's laws.

#include <vector>

#include "openfoam_module/drag/drag_laws.hpp"

namespace millfoam::drag {

/// Both ratios have the cross-section or surface of the sphere of equal volume above the line; 1 for a
/// sphere.
struct Shape {
  double sphericity;            ///< surface of the sphere over the ball's surface, in (0, 1]
  double crosswise_sphericity;  ///< cross-section of the sphere over the ball's area projected along the flow
};

/// Balls of one shape in a bed.
struct ShapeShare {
  double share;  ///< of the volume of all balls
  Shape shape;   ///< of these balls
};

/// F(phi, Re) as in drag_laws.hpp with the diameter of the sphere of equal volume in F and Re: the single
/// ball's drag coefficient of Hölzer & Sommerfeld 2008, Powder Technol. 184:361, times Di Felice's function
/// of the voidage. Stokes drag for a lone slow sphere; for
/// spheres it lies up to 23 % below Di Felice's law (at Re 55), who takes Dallavalle's single sphere.
double hoelzer_sommerfeld(double phi, double re, const Shape& shape);

/// Drag on a ball of one shape over the mean drag on the balls of a bed, all of one volume and at one Re, by
/// the law above: the function of the voidage is the same for all.
/// @param re  Reynolds number as in drag_laws.hpp
/// @param shape  of the ball
/// @param bed  shapes of the bed's balls with their shares, which add up to 1; not empty
double drag_over_mean(double re, const Shape& shape, const std::vector<ShapeShare>& bed);

/// The law `HoelzerSommerfeld` by name and range, which is Di Felice's. Its function is that of spheres: of
/// other balls use the coefficient below.
const Law& hoelzer_sommerfeld_law();

/// Exchange coefficient beta (kg/(m^3 s)) by this law of a bed of solidity phi at a slip (m/s), of balls
/// with this `shape` in a `fluid`. `diameter` is that of the sphere of equal volume, m.
double exchange_coefficient(const Shape& shape, double phi, double slip, double diameter, const Fluid& fluid);

}  // namespace millfoam::drag
