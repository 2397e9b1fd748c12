// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "meshing/polygons/polygon_set.hpp"

namespace millfoam::meshing {

/// Adds the triangles of an STL file to a set, as a group of the given name, with three points of their own
/// each, coordinates times `scale`. A file is binary when its length is that of a binary file with its number
/// of triangles, even if it begins with `solid`; otherwise it is text. The normals of the file are not read:
/// the order of the corners counts. Throws PolygonError with the line (text) or the triangle of what cannot
/// be read.
void read_stl(const std::filesystem::path& file, const std::string& group, double scale, PolygonSet& set);

}  // namespace millfoam::meshing
