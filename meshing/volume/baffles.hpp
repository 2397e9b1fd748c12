// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "meshing/volume/volume_mesh.hpp"

namespace millfoam::meshing {

/// Gives the two sides of walls without thickness points of their own: the cells around a point that are not
/// joined through faces between two cells at it each get a copy, so that nothing is interpolated from one
/// side of a wall to the other. The first such group of cells keeps the point; copies are appended.
void separate_points_at_baffles(VolumeMesh& mesh);

/// The same for a mesh of polygons.
void separate_points_at_baffles(PolyMesh& mesh);

}  // namespace millfoam::meshing
