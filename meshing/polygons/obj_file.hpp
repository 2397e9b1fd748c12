// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "meshing/polygons/polygon_set.hpp"
#include "meshing/volume/volume_mesh.hpp"

namespace millfoam::meshing {

/// Reads the polygons of a Wavefront OBJ file: `v`, `f` (`7`, `7/1`, `7//2`, `7/1/2`, or negative, counted
/// back from the last point) and `g`, whose first name is the group of the faces after it; the second word
/// `patch` makes it one of `PolygonSet::open`. What else OBJ
/// knows (normals, objects `o`, materials `usemtl`, lines …) is passed over. Throws PolygonError with the
/// line of what cannot be read.
PolygonSet read_obj(const std::filesystem::path& file);

/// Writes the faces of a mesh as OBJ, in groups named after their patches, those between two cells in the
/// group `internal`. Open patches get the second word `patch`; zones are left out. Throws std::runtime_error
/// when the file cannot be written.
void write_obj(const VolumeMesh& mesh, const std::filesystem::path& file);

}  // namespace millfoam::meshing
