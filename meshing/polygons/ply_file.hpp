// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "meshing/polygons/polygon_set.hpp"

namespace millfoam::meshing {

/// Reads the polygons of a PLY file, ASCII or binary of either byte order: element `vertex` with x, y, z and
/// element `face` with the list `vertex_indices` (or `vertex_index`). An integer property `patch` of the
/// faces groups them as `patch0`, `patch1`, …; without it all are of the group `walls`. Other elements and
/// properties are passed over. Throws PolygonError with the line (ASCII) or the face of what cannot be read.
PolygonSet read_ply(const std::filesystem::path& file);

}  // namespace millfoam::meshing
