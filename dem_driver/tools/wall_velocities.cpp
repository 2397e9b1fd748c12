// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/tools/wall_velocities.hpp"

#include <liggghts/fix.h>
#include <liggghts/lammps.h>
#include <liggghts/modify.h>
#include <liggghts/update.h>

#include <string_view>

namespace millfoam::dem_driver {

void set_wall_velocities(LAMMPS_NS::LAMMPS& liggghts) {
  const double timestep = liggghts.update->dt;
  // The begin of a step that takes no time sets the velocities and moves nothing
  liggghts.update->dt = 0;
  for (int i = 0; i < liggghts.modify->nfix; ++i) {
    LAMMPS_NS::Fix& fix = *liggghts.modify->fix[i];
    if (std::string_view(fix.style) != "move/mesh") continue;
    fix.setup(0);
    fix.initial_integrate(0);
  }
  liggghts.update->dt = timestep;
}

}  // namespace millfoam::dem_driver
