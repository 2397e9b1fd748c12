// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <stdexcept>
#include <vector>

/// Surfaces of triangles, as STL files hold them, used by the rooms meshing and averaging.
namespace millfoam::surface {

/// A surface that cannot be used; the message names the file or the place, and what was expected.
struct SurfaceError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// One triangle of an STL file.
struct StlTriangle {
  std::array<Eigen::Vector3d, 3> corners;  ///< in the file's unit, anticlockwise seen from outside
  int line = 0;                            ///< where its facet begins, from 1; 0 in a binary file
};

/// Reads an STL file: text, with any number of solids and keywords in any case, or binary. A file is binary
/// when its length is that of a binary file with its number of triangles, even if it begins with `solid`, or
/// when its header holds a zero. The normals of the file are not read: the order of the corners counts.
/// Throws SurfaceError with the line (text) or the triangle, for a file that cannot be read, is cut, is no
/// STL, holds a coordinate that is not finite, or no triangle.
std::vector<StlTriangle> read_stl(const std::filesystem::path& file);

}  // namespace millfoam::surface
