// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/dumps/bounding_radius.hpp"

#include <algorithm>
#include <cmath>

namespace millfoam::averaging {

namespace {

/// The farthest point of (x/u)^n + (y/v)^n = 1 from the origin.
double farthest(double u, double v, double n) {
  const double longer = std::max(u, v), shorter = std::min(u, v);
  if (!(n > 2)) return longer;
  const double exponent = 2 * n / (n - 2);
  return longer * std::pow(1 + std::pow(shorter / longer, exponent), 1 / exponent);
}

}  // namespace

double bounding_radius(const Superquadric& shape) {
  const auto& [a, b, c] = shape.half_axes;
  const auto& [n1, n2] = shape.blockiness;
  return farthest(farthest(a, b, n2), c, n1);
}

}  // namespace millfoam::averaging
