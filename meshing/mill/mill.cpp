// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/mill/mill.hpp"

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

}  // namespace millfoam::meshing
