// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "meshing/volume/volume_mesh.hpp"

namespace millfoam::meshing {

/// A cell by its points, indices: four below, anticlockwise seen from above, and the four above them; and
/// what each of its faces is part of if no other cell has it: below, above, and those over the four sides of
/// the lower face, from the first on.
struct Hexahedron {
  std::array<int, 8> points = {};  ///< indices
  std::array<int, 6> parts = {};   ///< numbers of patches
};

/// The mesh of these cells, in their order; faces with the same points join two of them. Points that no cell
/// has are left out. The patches have these names, in this order.
VolumeMesh mesh_of_hexahedra(const std::vector<Eigen::Vector3d>& points, std::vector<Hexahedron> cells,
                             const std::vector<std::string>& patches);

}  // namespace millfoam::meshing
