// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/mill/mill.hpp"

#include <algorithm>
#include <cmath>

#include "meshing/surface/pi.hpp"

namespace millfoam::meshing {

double critical_speed(const Geometry& geometry) {
  return std::sqrt(gravity / geometry.radius());
}

double Mill::turn() const {
  return 2 * pi / std::abs(angular_velocity);
}

const char* Mill::sense() const {
  return angular_velocity < 0 ? "clockwise" : "anticlockwise";
}

double longest_way(const SizeClass& size) {
  return size.shape ? 2 * bounding_radius(*size.shape) : size.diameter;
}

double Charge::longest_way() const {
  double way = 0;
  for (const SizeClass& size : classes) way = std::max(way, meshing::longest_way(size));
  return way;
}

bool Charge::has_shapes() const {
  return std::any_of(classes.begin(), classes.end(),
                     [](const SizeClass& size) { return size.shape.has_value(); });
}

}  // namespace millfoam::meshing
