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

/// What became of the solids in cells that cannot hold any.
struct HandedOver {
  double moved = 0;  ///< volume that neighbours took in, m^3
  double lost = 0;   ///< volume too far from any cell with room, m^3; it is in no cell any more
};

/// Empties cells that lie within walls into the nearest cells with room, in proportion to their room, with
/// all that travels with it. Balls reach into a wall by a small overlap: what lies more than three faces from
/// any room is no such thing, and is given back as lost.
/// @param values  as of `move_excess`
/// @param room    [cells] volume inside the mill, m^3; 0 of the cells to be emptied
HandedOver empty_walls(std::vector<double>& values, std::size_t columns, const std::vector<double>& room,
                       const std::vector<std::array<int, 2>>& neighbours);

}  // namespace millfoam::averaging
