// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/faces/t_junctions.hpp"

#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>

namespace millfoam::meshing {
namespace {

using Eigen::Vector3d;
using surface::EdgeTable;
using surface::FaceSide;
using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::size_t>;

/// Nearer than this, in lengths of the edge, a point counts as on it: far above rounding, far below what a
/// mesh means by a distance.
constexpr double on_edge = 1e-6;

Box box_of(const Vector3d& a, const Vector3d& b, double margin, std::size_t info) {
  const CGAL::Bbox_3 box(std::min(a.x(), b.x()) - margin, std::min(a.y(), b.y()) - margin,
                         std::min(a.z(), b.z()) - margin, std::max(a.x(), b.x()) + margin,
                         std::max(a.y(), b.y()) + margin, std::max(a.z(), b.z()) + margin);
  return {box, info};
}

/// The points that are an end of some edge.
std::vector<std::size_t> ends_of(const EdgeTable& edges, std::size_t points) {
  std::vector<bool> is_end(points, false);
  for (const FaceSide& side : edges.sides)
    is_end[static_cast<std::size_t>(side.low)] = is_end[static_cast<std::size_t>(side.high)] = true;
  std::vector<std::size_t> ends;
  for (std::size_t p = 0; p < points; ++p) {
    if (is_end[p]) ends.push_back(p);
  }
  return ends;
}

bool lies_on(const Vector3d& point, const Vector3d& a, const Vector3d& b) {
  const double along = (point - a).dot(b - a) / (b - a).squaredNorm();
  if (!(along > 0 && along < 1)) return false;
  return (a + along * (b - a) - point).norm() < on_edge * (b - a).norm();
}

}  // namespace

std::vector<TJunction> find_t_junctions(const Points& points, const EdgeTable& edges) {
  std::vector<Box> point_boxes, edge_boxes;
  for (std::size_t p : ends_of(edges, points.size()))
    point_boxes.push_back(box_of(points[p], points[p], 0, p));
  const auto end = [&](int p) -> const Vector3d& { return points[static_cast<std::size_t>(p)]; };
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const Vector3d& a = end(edges.first(e).low);
    const Vector3d& b = end(edges.first(e).high);
    edge_boxes.push_back(box_of(a, b, on_edge * (b - a).norm(), e));
  }
  std::vector<TJunction> junctions;
  const auto visit = [&](const Box& point_box, const Box& edge_box) {
    const int p = static_cast<int>(point_box.info());
    const FaceSide& edge = edges.first(edge_box.info());
    if (p == edge.low || p == edge.high) return;
    if (lies_on(end(p), end(edge.low), end(edge.high))) junctions.push_back({p, edge_box.info()});
  };
  CGAL::box_intersection_d(point_boxes.begin(), point_boxes.end(), edge_boxes.begin(), edge_boxes.end(),
                           visit);
  return junctions;
}

}  // namespace millfoam::meshing
