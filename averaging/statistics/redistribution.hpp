// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

namespace millfoam::averaging {

/// Solids above a cap for which no cell has room.
class NoRoomError : public std::runtime_error {
 public:
  /// @param message  in words
  /// @param where  number of the cell
  /// @param over  volume of its solids over its capacity
  NoRoomError(const std::string& message, std::size_t where, double over)
      : std::runtime_error(message), cell(where), excess(over) {}

  std::size_t cell;  ///< its number
  double excess;     ///< volume of its solids over its capacity
};

/// Moves what exceeds the cells' capacities to their neighbours, with all that travels with it: to the
/// nearest cells with free volume, ring by ring of faces, within a ring in proportion to the free volume.
/// @param values      [cells][columns] extensive quantities; column 0 is the volume of solids, m^3
/// @param columns     quantities of a cell
/// @param capacities  [cells] largest volume of solids that may stay, m^3
/// @param neighbours  pairs of cells that share a face
/// @return the volume moved, m^3
///
/// Throws NoRoomError, naming the cell, when there is not enough free volume.
double redistribute_excess(std::vector<double>& values, std::size_t columns,
                           const std::vector<double>& capacities,
                           const std::vector<std::array<int, 2>>& neighbours);

/// What became of the solids in cells that cannot hold any.
struct Redistributed {
  double moved = 0;  ///< volume that neighbours took in, m^3
  double lost = 0;   ///< volume too far from any cell inside the mill, m^3; it is in no cell any more
};

/// Empties cells within walls into the nearest cells inside the mill, in proportion to their volume
/// inside, with all that travels with it. Balls reach into a wall by a small overlap: what lies more than
/// three faces from any cell inside is not such an overlap. It is returned as lost.
/// @param values          as of `redistribute_excess`
/// @param columns         quantities of a cell
/// @param inside_volumes  [cells] volume inside the mill, m^3; 0 for cells that are emptied
/// @param neighbours      pairs of cells that share a face
Redistributed redistribute_from_walls(std::vector<double>& values, std::size_t columns,
                                      const std::vector<double>& inside_volumes,
                                      const std::vector<std::array<int, 2>>& neighbours);

}  // namespace millfoam::averaging
