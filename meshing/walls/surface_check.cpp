// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/walls/surface_check.hpp"

#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "meshing/faces/cgal_mesh.hpp"
#include "meshing/faces/face_geometry.hpp"
#include "meshing/files/text_numbers.hpp"

namespace millfoam::meshing {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;

}  // namespace

SurfaceCheck check_surface(const WallSurface& surface) {
  std::vector<Face> triangles;
  for (const WallPart& part : surface.parts) {
    for (const auto& triangle : part.triangles) triangles.emplace_back(triangle.begin(), triangle.end());
  }
  SurfaceCheck check;
  const auto mesh = to_cgal(surface.points, triangles);
  if (!mesh) return check;
  check.closed = CGAL::is_closed(*mesh);
  check.self_intersecting = pmp::does_self_intersect(*mesh);
  if (!check.closed) return check;
  check.volume = pmp::volume(*mesh);
  check.outward =
      !check.self_intersecting && pmp::does_bound_a_volume(*mesh) && pmp::is_outward_oriented(*mesh);
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

double flatness(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const double longest = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  return longest > 0 ? (b - a).cross(c - a).norm() / longest : 0;
}

Needles find_needles(const WallSurface& surface) {
  Needles needles;
  const auto at = [&](int p) -> const Eigen::Vector3d& {
    return surface.points[static_cast<std::size_t>(p)];
  };
  for (const WallPart& part : surface.parts) {
    for (const auto& [a, b, c] : part.triangles) {
      const double ratio = flatness(at(a), at(b), at(c));
      if (ratio < needle_ratio) ++needles.count;
      if (ratio >= needles.smallest_ratio) continue;
      needles.smallest_ratio = ratio;
      needles.where = (at(a) + at(b) + at(c)) / 3;
    }
  }
  return needles;
}

void require_no_needles(const WallSurface& surface) {
  const Needles needles = find_needles(surface);
  if (needles.count == 0) return;
  std::ostringstream text;
  text << "the walls have " << needles.count
       << (needles.count == 1 ? " needle triangle" : " needle triangles")
       << ", the worst, of height over longest side " << needles.smallest_ratio << ", at "
       << described(needles.where) << ": expected at least " << needle_ratio
       << "; choose another resolution.cell_size";
  throw std::runtime_error(text.str());
}

void require_same_volume(double of_walls, double of_mesh) {
  if (std::abs(of_walls / of_mesh - 1) <= allowed_volume_difference) return;
  std::ostringstream text;
  text.precision(9);
  text << "the walls enclose " << of_walls << " m^3, and the mesh fills " << of_mesh
       << " m^3: expected equal volumes to 1e-6";
  throw std::runtime_error(text.str());
}

}  // namespace millfoam::meshing
