// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/mill/mill_shape.hpp"

#include <cmath>

#include "meshing/mill/stirred_geometry.hpp"
#include "meshing/surface/pi.hpp"

namespace millfoam::meshing {

double lifter_section(const Geometry& geometry) {
  if (geometry.lifters.count == 0) return 0;
  const double r = geometry.radius();
  const double half_width = geometry.lifters.width / 2;
  const double foot = lifter_foot_distance(geometry);
  const double trapezoid =
      (half_width + geometry.lifters.top_width / 2) * (foot - lifter_top_distance(geometry));
  return trapezoid + r * r * std::asin(half_width / r) - half_width * foot;
}

double analytic_section(const Geometry& geometry) {
  return pi * geometry.radius() * geometry.radius() - geometry.lifters.count * lifter_section(geometry);
}

double analytic_volume(const Geometry& geometry) {
  if (geometry.impeller)
    return analytic_section(geometry) * geometry.length - impeller_volume(geometry, geometry.length);
  return analytic_section(geometry) * geometry.length;
}

double flow_volume(const Geometry& geometry) {
  if (geometry.impeller) return analytic_volume(geometry);
  const double depth = geometry.pulp_lifters ? geometry.pulp_lifters->depth : 0;
  return analytic_section(geometry) * (geometry.length + depth);
}

double lifter_foot_distance(const Geometry& geometry) {
  if (geometry.lifters.count == 0) return geometry.radius();
  const double half_width = geometry.lifters.width / 2;
  return std::sqrt(geometry.radius() * geometry.radius() - half_width * half_width);
}

double lifter_top_distance(const Geometry& geometry) {
  return geometry.lifters.count == 0 ? geometry.radius() : geometry.radius() - geometry.lifters.height;
}

double lifter_corner_radius(const Geometry& geometry) {
  if (geometry.lifters.count == 0) return geometry.radius();
  return std::hypot(lifter_top_distance(geometry), geometry.lifters.top_width / 2);
}

double lifter_foot_half_angle(const Geometry& geometry) {
  if (geometry.lifters.count == 0) return 0;
  return std::asin(geometry.lifters.width / 2 / geometry.radius());
}

double lifter_top_half_angle(const Geometry& geometry) {
  if (geometry.lifters.count == 0) return 0;
  return std::atan2(geometry.lifters.top_width / 2, lifter_top_distance(geometry));
}

}  // namespace millfoam::meshing
