// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace millfoam::meshing {

/// A laboratory mill with two levels of pins at right angles (mill A of Ssebunnya, PhD thesis, University
/// of Cape Town, 2024).
inline const std::string stirred_mill = R"(title: stirred
machine: stirred
geometry:
  diameter: 0.155
  height: 0.315
  impeller:
    shaft: {diameter: 0.025, end: 0.020}
    pins:
      - {height: 0.0304, length: 0.141, thickness: 0.015}
      - {height: 0.0700, length: 0.141, thickness: 0.015, angle: 90}
speed: {angular_velocity: 31.416}
charge: {level: 0.0775, share: 0.5, diameter: 0.005}
materials:
  ball: {density: 2700, youngs_modulus: 1.0e9, poisson_ratio: 0.3}
  wall: {density: 7850, youngs_modulus: 1.0e9, poisson_ratio: 0.3}
  ball_ball: {restitution: 0.6, friction: 0.4, rolling_friction: 0}
  ball_wall: {restitution: 0.5, friction: 0.3, rolling_friction: 0}
dem: {youngs_modulus: 1.0e7, settle_time: 0.3, duration: 1.2}
)";

/// A change of that mill: two discs below the upper pins instead of the lower ones, the lowest at the shaft's
/// end.
inline const std::string disc_impeller =
    "geometry.impeller={shaft: {diameter: 0.025, end: 0.020}, "
    "pins: [{height: 0.0700, length: 0.141, thickness: 0.015}], "
    "discs: [{height: 0.045, diameter: 0.120, thickness: 0.008}, "
    "{height: 0.023, diameter: 0.142, thickness: 0.006}]}";

}  // namespace millfoam::meshing
