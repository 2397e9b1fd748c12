// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <vector>

#include "meshing/mill/mill.hpp"
#include "meshing/walls/wall_surface.hpp"

namespace millfoam::meshing {

/// Writes `<folder>/<part>.stl` (ASCII) for each part that LIGGGHTS needs as a wall: those with triangles,
/// and the ends only where they are plain. A file of a part that is not a wall, left by an earlier mill, is
/// removed. Returns the files written.
std::vector<std::filesystem::path> write_walls(const WallSurface& surface, Ends ends,
                                               const std::filesystem::path& folder);

}  // namespace millfoam::meshing
