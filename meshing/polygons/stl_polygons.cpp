// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/polygons/stl_polygons.hpp"

#include "meshing/surface/stl_file.hpp"

namespace millfoam::meshing {
namespace {

std::vector<surface::StlTriangle> read_triangles(const std::filesystem::path& file) {
  try {
    return surface::read_stl(file);
  } catch (const surface::SurfaceError& error) {
    throw PolygonError(error.what());
  }
}

}  // namespace

void add_stl(const std::filesystem::path& file, const std::string& group, double scale, PolygonSet& set) {
  const int index = group_index(set, group);
  int number = 0;
  for (const surface::StlTriangle& triangle : read_triangles(file)) {
    const auto first = static_cast<int>(set.points.size());
    for (const Eigen::Vector3d& corner : triangle.corners) set.points.push_back(scale * corner);
    set.polygons.push_back({{first, first + 1, first + 2}, index, triangle.line, ++number});
  }
}

}  // namespace millfoam::meshing
