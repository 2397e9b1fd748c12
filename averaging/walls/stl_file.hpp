// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <vector>

namespace millfoam::averaging {

/// Corners of a triangle, m, anticlockwise seen from the side that its normal points to.
using StlTriangle = std::array<Eigen::Vector3d, 3>;

/// Reads an STL file, ASCII (any number of solids) or binary. The normals that it gives are passed over: the
/// order of the corners counts. Throws SurfaceError, naming file and line or byte, for a file that cannot be
/// read, is cut, is no STL, holds a coordinate that is not finite, or no triangle.
std::vector<StlTriangle> read_stl(const std::filesystem::path& file);

}  // namespace millfoam::averaging
