// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "meshing/polygons/polygon_set.hpp"

namespace millfoam::meshing {

/// Adds the triangles of an STL file (surface::read_stl) to a set, as a group of the given name, with three
/// points of their own each, coordinates times `scale`. Throws PolygonError where that reader refuses.
void add_stl(const std::filesystem::path& file, const std::string& group, double scale, PolygonSet& set);

}  // namespace millfoam::meshing
