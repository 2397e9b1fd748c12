// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
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

}  // namespace millfoam::meshing
