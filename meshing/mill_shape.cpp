// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/mill_shape.hpp"

#include <cmath>

#include "meshing/pi.hpp"

namespace millfoam::meshing {

namespace {}

double lifter_section(const Geometry& geometry) {
  if (geometry.lifters.count == 0) return 0;
  const double r = geometry.radius();
  const double half_width = geometry.lifters.width / 2;
  return r * r * std::asin(half_width / r) + half_width * std::sqrt(r * r - half_width * half_width) -
         2 * half_width * (r - geometry.lifters.height);
}

double analytic_section(const Geometry& geometry) {
  return pi * geometry.radius() * geometry.radius() - geometry.lifters.count * lifter_section(geometry);
}

double analytic_volume(const Geometry& geometry) {
  return analytic_section(geometry) * geometry.length;
}

double lifter_corner_radius(const Geometry& geometry) {
  if (geometry.lifters.count == 0) return geometry.radius();
  return std::hypot(geometry.radius() - geometry.lifters.height, geometry.lifters.width / 2);
}

double lifter_foot_half_angle(const Geometry& geometry) {
  if (geometry.lifters.count == 0) return 0;
  return std::asin(geometry.lifters.width / 2 / geometry.radius());
}

double lifter_top_half_angle(const Geometry& geometry) {
  if (geometry.lifters.count == 0) return 0;
  return std::atan2(geometry.lifters.width / 2, geometry.radius() - geometry.lifters.height);
}

}  // namespace millfoam::meshing
