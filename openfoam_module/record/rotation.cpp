// SPDX-License-Identifier: GPL-3.0-or-later
#include "openfoam_module/record/rotation.hpp"

namespace millfoam::record {

std::string sense_of_rotation(double angular_velocity) {
  if (angular_velocity == 0) return "none";
  return angular_velocity > 0 ? "anticlockwise" : "clockwise";
}

std::string described_rotation(double angular_velocity) {
  const std::string sense = sense_of_rotation(angular_velocity);
  return angular_velocity == 0 ? "does not turn" : sense + ", seen with x to the right and y up";
}

}  // namespace millfoam::record
