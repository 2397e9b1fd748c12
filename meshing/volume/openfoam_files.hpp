// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "meshing/volume/volume_mesh.hpp"

namespace millfoam::meshing {

/// Writes `constant/polyMesh` of an OpenFOAM case (ASCII): points, faces, owner, neighbour, boundary,
/// and cellZones and faceZones where there are any. The files are made in `constant/polyMesh.partial`, which
/// then takes the place of an older polyMesh with all that is in it.
void write_poly_mesh(const VolumeMesh& mesh, const std::filesystem::path& case_folder);

/// The same for a mesh of polygons.
void write_poly_mesh(const PolyMesh& mesh, const std::filesystem::path& case_folder);

}  // namespace millfoam::meshing
