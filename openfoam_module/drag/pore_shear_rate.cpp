// SPDX-License-Identifier: GPL-3.0-or-later
#include "openfoam_module/drag/pore_shear_rate.hpp"

#include <cmath>

namespace millfoam::drag {

double pore_shear_rate(double phi, double slip, double diameter) {
  return 12 * phi * slip / ((1 - phi) * diameter);
}

double tube_shear_rate(double darcy, double velocity) {
  return velocity * std::sqrt(2 * darcy);
}

}  // namespace millfoam::drag
