// SPDX-License-Identifier: GPL-3.0-or-later
#include "openfoam_module/record/rotation.hpp"

#include "averaging/values/sense_of_rotation.hpp"

namespace millfoam::record {

std::string described_rotation(double angular_velocity) {
  if (angular_velocity == 0) return "does not turn";
  return std::string(averaging::sense_of_rotation(angular_velocity)) + ", seen with x to the right and y up";
}

}  // namespace millfoam::record
