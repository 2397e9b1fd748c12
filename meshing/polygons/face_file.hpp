// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "meshing/polygons/polygon_set.hpp"

namespace millfoam::meshing {

/// Reads polygons by the file's extension, `.obj` or `.ply`; see read_obj and read_ply. Throws PolygonError
/// for another extension and for what those throw.
PolygonSet read_faces(const std::filesystem::path& file);

/// Whether a file's name ends in `extension` (in small letters, with its dot), in small letters or capitals.
bool has_extension(const std::filesystem::path& file, const std::string& extension);

}  // namespace millfoam::meshing
