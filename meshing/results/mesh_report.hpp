// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "meshing/mill/mill_reader.hpp"
#include "meshing/mill_mesh/openings.hpp"
#include "meshing/volume/mesh_quality.hpp"
#include "meshing/volume/volume_mesh.hpp"
#include "meshing/walls/surface_check.hpp"
#include "meshing/walls/wall_surface.hpp"

namespace millfoam::meshing {

/// What a tool prints of the mill first: its title, size, sense of rotation, charge and fingerprint.
std::string mill_lines(const MillDescription& description);

/// The same of a stirred mill.
std::string stirred_lines(const MillDescription& description);

/// What millMesh prints of a mill's mesh: numbers of cells, the quality against its limits, the areas of the
/// openings compared with those of mill.yaml, and advice on averaging where cells are smaller than the
/// largest ball. Lines end with '\n'.
std::string mesh_report(const Mill& mill, const VolumeMesh& mesh, const MeshQuality& quality,
                        const Openings& openings, const QualityLimits& limits = QualityLimits());

/// The line on the walls: their triangles, the flattest one's height over its longest side, and the relative
/// difference between the volume that they enclose and the expected one, m^3, with its limit.
std::string wall_report(const WallSurface& walls, double volume, double expected,
                        double limit = allowed_volume_difference);

}  // namespace millfoam::meshing
