// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "dem_driver/contact_statistics.hpp"
#include "dem_driver/dem_plan.hpp"
#include "dem_driver/wall_cells.hpp"
#include "meshing/mill/mill.hpp"

namespace millfoam::dem_driver {

/// What millLiggghts needs besides the deck to follow the contacts of a run.
struct ContactOrder {
  std::vector<double> diameters;           ///< of the classes of balls, m, each once
  std::vector<std::string> parts;          ///< of the walls
  std::vector<std::string> turning_parts;  ///< those of them that turn; the others are at rest
  double timestep = 0;                     ///< s
  double angular_velocity = 0;             ///< of `turning_parts` about +z, rad/s; their angle is 0 at step 0
  double cell_edge = 0;                    ///< longest edge of a wall cell, m
  long end_step = 0;                       ///< the run's last step
  long block_steps = 0;  ///< between two blocks of the sums, which are those between restart files
  long wall_steps = 0;   ///< at least, between two records of the wall cells
  std::filesystem::path walls = {};  ///< folder of the wall files
  /// All kinds of contacts.
  ContactKinds kinds() const;
  /// Whether a part, numbered as in `parts`, turns.
  bool turns(std::size_t part) const;
  /// The cells of all parts. Throws as WallCells.
  WallCells cells() const;
};

/// The order of a run. Cells have edges of at most a sixtieth of the mill's diameter, of a
/// stirred mill a fifteenth.
ContactOrder contact_order_of(const meshing::Mill& mill, const DemPlan& plan,
                              const std::vector<std::string>& parts, const std::filesystem::path& walls);

/// Writes `dem/contacts.json` (FORMATS.md), which appears whole or not at all; the path of the walls in it is
/// relative to its folder. Throws std::runtime_error naming the file.
void write_contact_order(const std::filesystem::path& file, const meshing::Mill& mill,
                         const ContactOrder& order);

/// Reads it back. Throws std::runtime_error naming the file, and the key that is missing or wrong.
ContactOrder read_contact_order(const std::filesystem::path& file);

}  // namespace millfoam::dem_driver
