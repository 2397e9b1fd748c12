// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <vector>

#include "averaging/mesh/mesh_geometry.hpp"
#include "meshing/surface/stl_file.hpp"

namespace millfoam::averaging {

/// Walls that cannot be used; the message names the file or the place, and what was expected.
using surface::SurfaceError;

/// The inside of a mill, by the closed surface around it.
struct Surface {
  std::vector<Eigen::Vector3d> points;        ///< m
  std::vector<std::array<int, 3>> triangles;  ///< corners in `points`, anticlockwise seen from outside

  /// Triangles at the end of `triangles` that were added to close open ends.
  std::size_t caps = 0;
};

/// Reads STL files, ASCII or binary, that together make one closed surface: shell, lifters and ends in files
/// of their own.
///
/// Points nearer to each other than 1e-6 of the surface's size are one. Where the surface is open at its
/// lowest or highest z, as that of a slice of a long mill, it is closed by a flat end. Its triangles must
/// agree on which side is outside, and are all turned when that is the side inside; a body within the mill
/// must then be turned inside out against the wall around it. Throws SurfaceError for files that
/// `surface::read_stl` refuses, and for a surface that is not closed, naming the first open edge.
Surface read_surface(const std::vector<std::filesystem::path>& files);

/// The boundary of a mesh, all patches together. Faces are cut into triangles as for the cells' volumes, so
/// that the surface holds exactly the sum of them.
Surface boundary_surface(const MeshGeometry& mesh);

/// The volume that a surface encloses, m^3.
double enclosed_volume(const Surface& surface);

}  // namespace millfoam::averaging
