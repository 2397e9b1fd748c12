// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "meshing/cross_section.hpp"
#include "meshing/mill.hpp"

namespace millfoam::meshing {

/// The triangles of one part of the mill's wall; point indices, normals pointing out of the mill's interior.
struct WallPart {
  std::string name;
  std::vector<std::array<int, 3>> triangles;
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

/// What CGAL finds of all parts together.
struct SurfaceCheck {
  bool closed = false;             ///< a manifold without boundary
  bool outward = false;            ///< bounds a volume, with normals pointing out of it
  bool self_intersecting = false;  ///< some triangles cross
  double volume = 0;               ///< enclosed, m^3; 0 when not closed
};
SurfaceCheck check_surface(const WallSurface& surface);

/// Checks that the parts together are closed, outward oriented and without self-intersection; throws
/// std::runtime_error saying which is not so. Returns the enclosed volume, m^3.
double require_watertight(const WallSurface& surface);

/// Writes `<folder>/<part>.stl` (ASCII) for each part that LIGGGHTS needs as a wall: those with triangles,
/// and the ends only where they are plain. A file of a part that is no wall, left by an earlier mill, is
/// removed. Returns the files written.
std::vector<std::filesystem::path> write_walls(const WallSurface& surface, Ends ends,
                                               const std::filesystem::path& folder);

}  // namespace millfoam::meshing
