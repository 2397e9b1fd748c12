// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "meshing/polygons/polygon_set.hpp"

namespace millfoam::dem_driver {

/// The triangles of an STL file of a wall, text or binary. Throws std::runtime_error for one that cannot be
/// read, is cut short, has no triangle or a coordinate that is not finite, or that LIGGGHTS would read
/// otherwise than it is meant: LIGGGHTS crashes on such files, or leaves triangles out, without a word. The
/// message names the file (with the line of a text), what was found and what was expected.
meshing::PolygonSet read_wall(const std::filesystem::path& file);

}  // namespace millfoam::dem_driver
