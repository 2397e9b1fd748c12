// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/mill_mesh/cross_section.hpp"

#include "meshing/surface/pi.hpp"

namespace millfoam::meshing {

double CrossSection::first_line_angle() const {
  return -pi * divisions.lifter / around();
}

}  // namespace millfoam::meshing
