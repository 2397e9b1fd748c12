// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <iosfwd>

#include "dem_driver/wall_cells.hpp"

namespace millfoam::dem_driver {

/// Writes the means of the wall cells as a file of ParaView (.vtp, text), in the frame of the wall files,
/// which turns with the mill. FORMATS.md lists its fields.
/// @param out  the file
/// @param cells  of the walls
/// @param sums  over the steps
/// @param begin, end  the sums are over the steps after `begin` up to `end`
/// @param timestep  s
void write_wall_forces(std::ostream& out, const WallCells& cells, const WallSums& sums, long begin, long end,
                       double timestep);

}  // namespace millfoam::dem_driver
