// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <vector>

#include "meshing/mill/mill.hpp"
#include "meshing/polygons/polygon_set.hpp"

namespace millfoam::dem_driver {

/// The triangles of one part of the walls, which may come from CAD.
struct Wall {
  std::filesystem::path file;   ///< where they were read, for messages
  meshing::PolygonSet surface;  ///< m
};

/// Share of the mill's radius or length by which walls may be off.
inline constexpr double allowed_misfit = 0.02;

/// Throws std::runtime_error where the walls are not those of a mill of this geometry: the circle around all
/// of them seen along the axis must have its radius and lie on the axis x = y = 0, and they must reach from
/// z = 0 to its length, each to `allowed_misfit`. The message names the file that reaches too far or not far
/// enough, the box of all walls, and what was expected.
void require_fit(const std::vector<Wall>& walls, const meshing::Geometry& geometry);

/// Area of walls seen along the axis over that of the mill's section (a circle).
struct EndCover {
  double feed = 0;       ///< of the half with z below the middle
  double discharge = 0;  ///< of the other half
};

/// The cover of both ends by all walls together; a triangle belongs to the half in which its centroid lies.
/// Triangles that lie behind one another count each.
EndCover cover_of_ends(const std::vector<Wall>& walls, const meshing::Geometry& geometry);

/// An end without its own file is closed from here on: a shell with both ends covers about 1, one that
/// is open next to nothing.
inline constexpr double least_cover = 0.5;

}  // namespace millfoam::dem_driver
