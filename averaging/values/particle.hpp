// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "averaging/values/vector3.hpp"

namespace millfoam::averaging {

/// A ball.
struct Particle {
  long long id = 0;    ///< the same in all records of a run
  Vector3 position{};  ///< of its centre, m
  Vector3 velocity{};  ///< m/s
  double radius = 0;   ///< m, positive; of a superquadric: of the sphere around it
};

/// The shape of a ball that is not a sphere, as LIGGGHTS' superquadrics: in the body's frame the points with
///
///     (|x/a|^n2 + |y/b|^n2)^(n1/n2) + |z/c|^n1 <= 1
///
/// Source: Podlozhnyuk, Pirker & Kloss 2017, Comp Part Mech 4:101.
struct Superquadric {
  Vector3 half_axes{};                           ///< a, b, c, m
  std::array<double, 2> blockiness{2, 2};        ///< n1, n2; 2 and 2 is an ellipsoid
  std::array<double, 4> quaternion{1, 0, 0, 0};  ///< turns the body's frame into the lab's; scalar part first
};

/// All balls at one time.
struct ParticleRecord {
  long long step = 0;                ///< DEM time-step
  std::vector<Particle> particles;   ///< in the order of the dump
  std::vector<Superquadric> shapes;  ///< [particles], or empty when all are spheres
};

}  // namespace millfoam::averaging
