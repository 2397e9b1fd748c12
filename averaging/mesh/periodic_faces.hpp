// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "averaging/mesh/mesh_geometry.hpp"

namespace millfoam::averaging {

/// The pairs of boundary faces that are one face of a mesh that repeats along z, each as {at the lower end,
/// at the upper end}.
/// @param mesh    at any time
/// @param period  length of the mesh along z, m
///
/// Throws std::invalid_argument when the mesh has another length, or naming a face at one end that has no
/// partner at the other.
std::vector<std::array<int, 2>> periodic_faces(const MeshGeometry& mesh, double period);

}  // namespace millfoam::averaging
