// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "averaging/mesh/mesh_geometry.hpp"

namespace millfoam::averaging {

/// Throws std::invalid_argument when a mesh's length along z is not the period to 1e-6 of this length.
/// @param mesh    at any time
/// @param period  m
void require_period(const MeshGeometry& mesh, double period);

/// The pairs of boundary faces that are one face of a mesh that repeats along z, each as {at the lower end,
/// at the upper end}.
/// @param mesh    at any time
/// @param period  length of the mesh along z, m
///
/// Throws std::invalid_argument as `require_period`, or naming a face at one end that has no
/// partner at the other.
std::vector<std::array<int, 2>> periodic_faces(const MeshGeometry& mesh, double period);

}  // namespace millfoam::averaging
