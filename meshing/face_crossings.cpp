// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/face_crossings.hpp"

#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/intersections.h>

#include <algorithm>
#include <optional>

namespace millfoam::meshing {
namespace {

using Eigen::Vector3d;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangle = Kernel::Triangle_3;
using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, int>;

bool share_a_point(const Face& a, const Face& b) {
  return std::find_first_of(a.begin(), a.end(), b.begin(), b.end()) != a.end();
}

Kernel::Point_3 to_cgal(const Vector3d& point) {
  return {point.x(), point.y(), point.z()};
}

std::vector<Triangle> to_cgal(const Points& points, const Face& face) {
  const auto at = [&](int p) { return to_cgal(points[static_cast<std::size_t>(p)]); };
  std::vector<Triangle> triangles;
  for (const auto& [a, b, c] : triangles_of(points, face)) {
    const Triangle triangle(at(a), at(b), at(c));
    if (!triangle.is_degenerate()) triangles.push_back(triangle);
  }
  return triangles;
}

/// The middle of what two triangles' boxes have in common.
Vector3d between(const CGAL::Bbox_3& a, const CGAL::Bbox_3& b) {
  Vector3d where;
  for (int i = 0; i < 3; ++i) where[i] = (std::max(a.min(i), b.min(i)) + std::min(a.max(i), b.max(i))) / 2;
  return where;
}

void sort_by_faces(std::vector<Crossing>& crossings) {
  std::sort(crossings.begin(), crossings.end(),
            [](const Crossing& a, const Crossing& b) { return a.faces < b.faces; });
}

std::optional<Vector3d> meeting(const std::vector<Triangle>& first, const std::vector<Triangle>& second) {
  for (const Triangle& a : first) {
    for (const Triangle& b : second) {
      if (CGAL::do_intersect(a, b)) return between(a.bbox(), b.bbox());
    }
  }
  return std::nullopt;
}

}  // namespace

std::vector<Crossing> find_crossings(const Points& points, const std::vector<Face>& faces) {
  std::vector<Box> boxes;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    Vector3d low = points[static_cast<std::size_t>(faces[f].front())], high = low;
    for (int p : faces[f]) {
      low = low.cwiseMin(points[static_cast<std::size_t>(p)]);
      high = high.cwiseMax(points[static_cast<std::size_t>(p)]);
    }
    boxes.emplace_back(CGAL::Bbox_3(low.x(), low.y(), low.z(), high.x(), high.y(), high.z()),
                       static_cast<int>(f));
  }
  std::vector<Crossing> crossings;
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& a, const Box& b) {
    const auto [first, second] = std::minmax({a.info(), b.info()});
    const Face& one = faces[static_cast<std::size_t>(first)];
    const Face& other = faces[static_cast<std::size_t>(second)];
    if (share_a_point(one, other)) return;
    const auto where = meeting(to_cgal(points, one), to_cgal(points, other));
    if (where) crossings.push_back({{first, second}, *where});
  });
  sort_by_faces(crossings);
  return crossings;
}

std::vector<Crossing> crossing_triangles(const Points& points, const std::vector<Face>& triangles) {
  namespace pmp = CGAL::Polygon_mesh_processing;
  std::vector<std::vector<std::size_t>> corners;
  for (const Face& face : triangles) {
    if (to_cgal(points, face).empty()) return find_crossings(points, triangles);
    corners.emplace_back(face.begin(), face.end());
  }
  if (!pmp::is_polygon_soup_a_polygon_mesh(corners)) return find_crossings(points, triangles);
  std::vector<Kernel::Point_3> cgal_points;
  for (const Vector3d& point : points) cgal_points.push_back(to_cgal(point));
  using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
  Mesh mesh;
  pmp::polygon_soup_to_polygon_mesh(cgal_points, corners, mesh);
  std::vector<std::pair<Mesh::Face_index, Mesh::Face_index>> pairs;
  pmp::self_intersections(mesh, std::back_inserter(pairs));
  std::vector<Crossing> crossings;
  for (const auto& [one, other] : pairs) {
    const auto [first, second] =
        std::minmax({static_cast<std::size_t>(one), static_cast<std::size_t>(other)});
    const Vector3d where = between(to_cgal(points, triangles[first]).front().bbox(),
                                   to_cgal(points, triangles[second]).front().bbox());
    crossings.push_back({{static_cast<int>(first), static_cast<int>(second)}, where});
  }
  sort_by_faces(crossings);
  return crossings;
}

}  // namespace millfoam::meshing
