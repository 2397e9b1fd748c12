// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "averaging/values/particle.hpp"

namespace millfoam::averaging {

/// Volume of a superquadric, m^3:
///
///     V = 2 a b c e1 e2 B(e1/2 + 1, e1) B(e2/2, e2/2),   e1 = 2/n1, e2 = 2/n2
///
/// with B the beta function. Throws std::invalid_argument, naming what is wrong, unless the half axes are
/// positive and the blockiness at least 1 (below it the body is not convex); all finite.
/// Source: Jaklic, Leonardis & Solina 2000, Segmentation and Recovery of Superquadrics, eq. 2.60.
double superquadric_volume(const Superquadric& shape);

/// Diameter of the sphere of the same volume, m. Throws as `superquadric_volume`.
double volume_equivalent_diameter(const Superquadric& shape);

/// The points of a lattice over a superquadric's bounding box that lie in it, in its own frame and in units
/// of its half axes; each represents an equal part of its volume. They depend on the blockiness alone. There
/// is always one: when the lattice is too coarse for the shape, it is the centre.
class SuperquadricTemplate {
 public:
  /// @param blockiness           n1, n2
  /// @param points_per_diameter  of the lattice along each axis, at least 1
  SuperquadricTemplate(const std::array<double, 2>& blockiness, int points_per_diameter);

  const std::vector<Vector3>& points() const { return points_; }  ///< in units of the half axes

 private:
  std::vector<Vector3> points_;
};

}  // namespace millfoam::averaging
