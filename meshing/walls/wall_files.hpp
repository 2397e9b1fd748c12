// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "meshing/mill/mill.hpp"
#include "meshing/walls/wall_surface.hpp"

namespace millfoam::meshing {

/// What millMesh writes next to the walls.
inline constexpr const char* walls_results_name = "walls.json";

/// Writes `<folder>/<part>.stl` (ASCII) for each part that LIGGGHTS needs as a wall: those with triangles,
/// and the ends only where they are plain. A file of a part that is not a wall, left by an earlier mill, is
/// removed. Until write_wall_results, walls.json says that the walls are not complete. Returns the files
/// written.
std::vector<std::filesystem::path> write_walls(const WallSurface& surface, Ends ends,
                                               const std::filesystem::path& folder);

/// Throws std::runtime_error where walls.json of a folder says that its walls are of another mill, or not
/// complete. Walls from CAD, and walls without walls.json, belong to any mill.
void require_walls_of(const std::filesystem::path& folder, const Mill& mill);

/// Whether walls.json of a folder says that its walls are from CAD. Throws std::runtime_error where it cannot
/// be read.
bool has_cad_walls(const std::filesystem::path& folder);

/// Throws std::runtime_error where walls.json of a folder, whose walls are complete, names other files than
/// those next to it.
void require_written_walls(const std::filesystem::path& folder);

/// Throws std::runtime_error naming the first STL file of a folder that is not one of a dry run's walls, or
/// is missing.
/// @param folder  of the walls
/// @param used  fingerprint of the file of each wall of the run, by its name without `.stl`
/// @param source  of `used`, for the message
void require_walls_of_run(const std::filesystem::path& folder, const std::map<std::string, std::string>& used,
                          const std::string& source);

/// Throws std::runtime_error naming the first STL file that write_walls would replace by another surface, or
/// remove, in a folder without walls.json: millMesh has not written it.
void require_known_walls(const WallSurface& surface, Ends ends, const std::filesystem::path& folder);

}  // namespace millfoam::meshing
