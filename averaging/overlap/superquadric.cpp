// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/overlap/superquadric.hpp"

#include <cassert>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "meshing/surface/pi.hpp"

namespace millfoam::averaging {

namespace {

void check(const Superquadric& shape) {
  const auto refuse = [](const char* what, double value, const char* expected) {
    std::ostringstream message;
    message << "superquadric: " << what << " is " << value << "; expected " << expected;
    throw std::invalid_argument(message.str());
  };
  for (const double axis : shape.half_axes) {
    if (!(axis > 0) || !std::isfinite(axis)) refuse("a half axis", axis, "a positive length, m");
  }
  for (const double n : shape.blockiness) {
    if (!(n >= 1) || !std::isfinite(n)) refuse("a blockiness", n, "at least 1");
  }
}

/// The beta function.
double beta(double x, double y) {
  return std::tgamma(x) * std::tgamma(y) / std::tgamma(x + y);
}

}  // namespace

double superquadric_volume(const Superquadric& shape) {
  check(shape);
  const double e1 = 2 / shape.blockiness[0], e2 = 2 / shape.blockiness[1];
  const auto& [a, b, c] = shape.half_axes;
  return 2 * a * b * c * e1 * e2 * beta(e1 / 2 + 1, e1) * beta(e2 / 2, e2 / 2);
}

double volume_equivalent_diameter(const Superquadric& shape) {
  return std::cbrt(6 * superquadric_volume(shape) / pi);
}

SuperquadricTemplate::SuperquadricTemplate(const std::array<double, 2>& blockiness, int points_per_diameter) {
  assert(points_per_diameter > 0);
  const auto [n1, n2] = blockiness;
  const auto coordinate = [&](int i) { return (2.0 * i + 1) / points_per_diameter - 1; };
  for (int k = 0; k < points_per_diameter; ++k) {
    for (int j = 0; j < points_per_diameter; ++j) {
      for (int i = 0; i < points_per_diameter; ++i) {
        const Vector3 p{coordinate(i), coordinate(j), coordinate(k)};
        const double across = std::pow(std::abs(p[0]), n2) + std::pow(std::abs(p[1]), n2);
        if (std::pow(across, n1 / n2) + std::pow(std::abs(p[2]), n1) <= 1) points_.push_back(p);
      }
    }
  }
  if (points_.empty()) points_.push_back({});
}

}  // namespace millfoam::averaging
