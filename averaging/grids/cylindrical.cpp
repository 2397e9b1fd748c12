// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/grids/cylindrical.hpp"

#include <cmath>

namespace millfoam::averaging {

namespace {

Vector3 turned(const Vector3& vector, double cosine, double sine) {
  return {vector[0] * cosine - vector[1] * sine, vector[0] * sine + vector[1] * cosine, vector[2]};
}

/// Cosine and sine of a point's azimuth.
struct Azimuth {
  double cosine = 1;
  double sine = 0;
  explicit Azimuth(const Vector3& point) {
    const double radius = std::hypot(point[0], point[1]);
    if (radius == 0) return;
    cosine = point[0] / radius;
    sine = point[1] / radius;
  }
};

}  // namespace

Vector3 turned(const Vector3& vector, double angle) {
  return turned(vector, std::cos(angle), std::sin(angle));
}

Vector3 to_cylindrical(const Vector3& vector, const Vector3& point) {
  const Azimuth at(point);
  return turned(vector, at.cosine, -at.sine);
}

Vector3 to_cartesian(const Vector3& components, const Vector3& point) {
  const Azimuth at(point);
  return turned(components, at.cosine, at.sine);
}

}  // namespace millfoam::averaging
