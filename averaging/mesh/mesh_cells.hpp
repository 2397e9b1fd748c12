// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "averaging/grids/grid.hpp"
#include "averaging/mesh/mesh_geometry.hpp"

namespace millfoam::averaging {

/// What a file of fields needs of a mesh: volumes and, for pictures, points and polyhedra. The names of the
/// mesh's file and motion are the caller's.
MeshCells mesh_cells(const MeshGeometry& mesh);

}  // namespace millfoam::averaging
