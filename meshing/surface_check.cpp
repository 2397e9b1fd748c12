// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/surface_check.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <stdexcept>

namespace millfoam::meshing {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

}  // namespace

SurfaceCheck check_surface(const WallSurface& surface) {
  std::vector<Kernel::Point_3> points;
  for (const Eigen::Vector3d& p : surface.points) points.emplace_back(p.x(), p.y(), p.z());
  std::vector<std::vector<std::size_t>> triangles;
  for (const WallPart& part : surface.parts) {
    for (const auto& triangle : part.triangles) triangles.emplace_back(triangle.begin(), triangle.end());
  }
  SurfaceCheck check;
  if (!pmp::is_polygon_soup_a_polygon_mesh(triangles)) return check;
  Mesh mesh;
  pmp::polygon_soup_to_polygon_mesh(points, triangles, mesh);
  check.closed = CGAL::is_closed(mesh);
  check.self_intersecting = pmp::does_self_intersect(mesh);
  if (!check.closed) return check;
  check.volume = pmp::volume(mesh);
  check.outward =
      !check.self_intersecting && pmp::does_bound_a_volume(mesh) && pmp::is_outward_oriented(mesh);
  return check;
}

double require_watertight(const WallSurface& surface) {
  const SurfaceCheck check = check_surface(surface);
  if (!check.closed) throw std::runtime_error("the walls are not watertight: their triangles do not close");
  if (check.self_intersecting)
    throw std::runtime_error("the walls are not watertight: some of their triangles cross");
  if (!check.outward) throw std::runtime_error("the walls' normals do not point out of the mill");
  return check.volume;
}

}  // namespace millfoam::meshing
