// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

namespace millfoam::dem_driver {

/// Throws std::runtime_error for an STL file of a wall, text or binary, that cannot be read, is cut short,
/// has no triangle or a coordinate that is not finite, or that LIGGGHTS would read otherwise than it is
/// meant: LIGGGHTS crashes on such files, or leaves triangles out, without a word. The message names the file
/// (with the line of a text), what was found and what was expected.
void check_wall(const std::filesystem::path& file);

}  // namespace millfoam::dem_driver
