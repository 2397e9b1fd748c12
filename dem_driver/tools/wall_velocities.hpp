// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace LAMMPS_NS {  // NOLINT: the library's name
class LAMMPS;
}

namespace millfoam::dem_driver {

/// Gives the walls of a run that resumes the velocity with which they turn. A restart file has their position
/// only, and LIGGGHTS computes the velocity at the begin of each step. But it computes forces once before the
/// first step: there the walls would be at rest, and the balls that touch them would feel other dampers than
/// in the run that wrote the file. To be called after the deck's fixes `move/mesh`, before its `run`.
void set_wall_velocities(LAMMPS_NS::LAMMPS& liggghts);

}  // namespace millfoam::dem_driver
