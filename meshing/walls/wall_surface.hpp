// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "meshing/mill_mesh/cross_section.hpp"

namespace millfoam::meshing {

/// The triangles of one part of the mill's wall; point indices, normals pointing out of the mill's interior.
struct WallPart {
  std::string name;                           ///< shell, lifters, feedEnd or dischargeEnd
  std::vector<std::array<int, 3>> triangles;  ///< point indices
};

/// The boundary of the mill's interior in parts that share their points: together a closed surface.
struct WallSurface {
  std::vector<Eigen::Vector3d> points;  ///< m
  std::vector<WallPart> parts;          ///< shell, lifters, feedEnd, dischargeEnd
};

/// The walls over the outline of a cross-section from z = 0 to `length` (m). The outline is the flow mesh's,
/// so that both have the same volume; along the axis and inside the ends the triangles are larger than the
/// flow's cells, because the cost of a moving wall in LIGGGHTS grows with their number.
WallSurface make_wall_surface(const CrossSection& section, double length);

}  // namespace millfoam::meshing
