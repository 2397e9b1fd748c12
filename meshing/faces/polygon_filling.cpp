// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/faces/polygon_filling.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <optional>

namespace millfoam::meshing {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Vertex = CGAL::Triangulation_vertex_base_with_info_2<int, Kernel>;
/// Whether a face lies inside the polygon; not known before the flood reaches it.
using Face = CGAL::Triangulation_face_base_with_info_2<std::optional<bool>, Kernel,
                                                       CGAL::Constrained_triangulation_face_base_2<Kernel>>;
using Storage = CGAL::Triangulation_data_structure_2<Vertex, Face>;
using Triangulation = CGAL::Constrained_Delaunay_triangulation_2<Kernel, Storage>;

/// Floods the triangulation from outside; crossing a side of the polygon changes from outside to inside and
/// back.
void mark_inside(Triangulation& triangulation) {
  std::vector<Triangulation::Face_handle> reached = {triangulation.infinite_face()};
  reached.front()->info() = false;
  while (!reached.empty()) {
    const auto face = reached.back();
    reached.pop_back();
    for (int i = 0; i < 3; ++i) {
      const auto next = face->neighbor(i);
      if (next->info()) continue;
      next->info() = *face->info() != triangulation.is_constrained({face, i});
      reached.push_back(next);
    }
  }
}

}  // namespace

std::vector<std::array<int, 3>> fill_polygon(const std::vector<Eigen::Vector2d>& points,
                                             const std::vector<std::array<int, 2>>& edges) {
  Triangulation triangulation;
  std::vector<Triangulation::Vertex_handle> vertices;
  for (const auto& point : points) {
    vertices.push_back(triangulation.insert({point.x(), point.y()}));
    vertices.back()->info() = static_cast<int>(vertices.size()) - 1;
  }
  for (const auto& [from, to] : edges) {
    triangulation.insert_constraint(vertices[static_cast<std::size_t>(from)],
                                    vertices[static_cast<std::size_t>(to)]);
  }
  mark_inside(triangulation);
  std::vector<std::array<int, 3>> triangles;
  for (const auto& face : triangulation.finite_face_handles()) {
    if (*face->info()) {
      triangles.push_back({face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
    }
  }
  return triangles;
}

}  // namespace millfoam::meshing
