// SPDX-License-Identifier: GPL-3.0-or-later
#include "openfoam_module/drag/pore_viscosity.hpp"

#include <cassert>

namespace millfoam::drag {

double pore_shear_rate(double phi, double slip, double diameter) {
  return 12 * phi * slip / ((1 - phi) * diameter);
}

double pore_viscosity(const BinghamSlurry& slurry, double shear_rate, double cap) {
  assert(cap >= slurry.plastic_viscosity);
  // Compared as stresses: the rate may be 0, and OpenFOAM stops on a division by it.
  const double capped_stress = (cap - slurry.plastic_viscosity) * shear_rate;
  if (slurry.yield_stress >= capped_stress) return slurry.yield_stress > 0 ? cap : slurry.plastic_viscosity;
  return slurry.plastic_viscosity + slurry.yield_stress / shear_rate;
}

}  // namespace millfoam::drag
