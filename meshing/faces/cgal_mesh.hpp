// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Surface_mesh.h>

#include <optional>
#include <vector>

#include "meshing/faces/face_geometry.hpp"

namespace millfoam::meshing {

/// Exact comparisons of coordinates in double precision.
using CgalKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
/// CGAL's mesh of triangles.
using CgalMesh = CGAL::Surface_mesh<CgalKernel::Point_3>;

/// A point, m, as CGAL's.
inline CgalKernel::Point_3 to_cgal(const Eigen::Vector3d& point) {
  return {point.x(), point.y(), point.z()};
}

/// CGAL's mesh of triangles, whose faces have the triangles' numbers; nothing where they are not oriented
/// manifold, closed or not. For sources only: CGAL's headers take long to compile.
inline std::optional<CgalMesh> to_cgal(const Points& points, const std::vector<Face>& triangles) {
  namespace pmp = CGAL::Polygon_mesh_processing;
  std::vector<std::vector<std::size_t>> corners;
  corners.reserve(triangles.size());
  for (const Face& face : triangles) corners.emplace_back(face.begin(), face.end());
  if (!pmp::is_polygon_soup_a_polygon_mesh(corners)) return std::nullopt;
  std::vector<CgalKernel::Point_3> cgal_points;
  cgal_points.reserve(points.size());
  for (const Eigen::Vector3d& point : points) cgal_points.push_back(to_cgal(point));
  CgalMesh mesh;
  pmp::polygon_soup_to_polygon_mesh(cgal_points, corners, mesh);
  return mesh;
}

}  // namespace millfoam::meshing
