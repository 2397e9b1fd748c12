// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace millfoam::averaging {

/// Moves what exceeds the cells' capacities to their neighbours, with all that travels with it.
/// @param values      [cells][columns] extensive quantities; column 0 is the volume of solids, m^3
/// @param capacities  [cells] largest volume of solids that may stay, m^3
/// @param neighbours  pairs of cells that share a face
/// It goes to the nearest cells with room, ring by ring of faces, within a ring in proportion to the free
/// room.
/// @return the volume moved, m^3
/// Throws std::runtime_error when there is not enough room.
double move_excess(std::vector<double>& values, std::size_t columns, const std::vector<double>& capacities,
                   const std::vector<std::array<int, 2>>& neighbours);

}  // namespace millfoam::averaging
