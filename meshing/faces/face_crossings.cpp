// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/faces/face_crossings.hpp"

#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/intersections.h>

#include <algorithm>
#include <optional>

#include "meshing/faces/cgal_mesh.hpp"

namespace millfoam::meshing {
namespace {

using Eigen::Vector3d;
using Triangle = CgalKernel::Triangle_3;
using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, int>;

bool share_a_point(const Face& a, const Face& b) {
  return std::find_first_of(a.begin(), a.end(), b.begin(), b.end()) != a.end();
}

std::vector<Triangle> filled(const Points& points, const Face& face) {
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
    const auto where = meeting(filled(points, one), filled(points, other));
    if (where) crossings.push_back({{first, second}, *where});
  });
  sort_by_faces(crossings);
  return crossings;
}

std::vector<Crossing> crossing_triangles(const Points& points, const std::vector<Face>& triangles) {
  namespace pmp = CGAL::Polygon_mesh_processing;
  const bool some_flat = std::any_of(triangles.begin(), triangles.end(),
                                     [&](const Face& face) { return filled(points, face).empty(); });
  const auto mesh = some_flat ? std::nullopt : to_cgal(points, triangles);
  if (!mesh) return find_crossings(points, triangles);
  std::vector<std::pair<CgalMesh::Face_index, CgalMesh::Face_index>> pairs;
  pmp::self_intersections(*mesh, std::back_inserter(pairs));
  std::vector<Crossing> crossings;
  for (const auto& [one, other] : pairs) {
    const auto [first, second] =
        std::minmax({static_cast<std::size_t>(one), static_cast<std::size_t>(other)});
    const Vector3d where = between(filled(points, triangles[first]).front().bbox(),
                                   filled(points, triangles[second]).front().bbox());
    crossings.push_back({{static_cast<int>(first), static_cast<int>(second)}, where});
  }
  sort_by_faces(crossings);
  return crossings;
}

}  // namespace millfoam::meshing
