// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/walls/surface.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <utility>

#include "averaging/walls/point_merger.hpp"
#include "averaging/walls/stl_file.hpp"

namespace millfoam::averaging {

namespace {

using Eigen::Vector3d;

/// Points nearer than this part of the surface's size are one: six digits of a text, or a float.
constexpr double same_point = 1e-6;

/// Edges as pairs of points, the lower one first, and how many more triangles run along them upwards than
/// downwards. Of a closed surface that is 0 everywhere.
using Edges = std::map<std::pair<int, int>, int>;

Edges open_edges(const std::vector<std::array<int, 3>>& triangles) {
  Edges edges;
  for (const auto& triangle : triangles) {
    for (std::size_t c = 0; c < 3; ++c) {
      const int a = triangle[c], b = triangle[(c + 1) % 3];
      edges[std::minmax(a, b)] += a < b ? 1 : -1;
    }
  }
  for (auto edge = edges.begin(); edge != edges.end();) {
    edge = edge->second == 0 ? edges.erase(edge) : std::next(edge);
  }
  return edges;
}

const Vector3d& point_of(const Surface& surface, int point) {
  return surface.points[static_cast<std::size_t>(point)];
}

std::string in_words(const Vector3d& point) {
  std::ostringstream text;
  text << '(' << point.x() << ' ' << point.y() << ' ' << point.z() << ')';
  return text.str();
}

SurfaceError not_closed(const Surface& surface, const Edges& edges, const Edges::value_type& edge,
                        const std::string& files) {
  const bool turned = std::abs(edge.second) > 1;
  return SurfaceError(
      files + ": the walls are not a closed surface: at the edge from " +
      in_words(point_of(surface, edge.first.first)) + " to " +
      in_words(point_of(surface, edge.first.second)) +
      (turned ? " triangles do not agree on which side is outside" : " a triangle has no neighbour") + " (" +
      std::to_string(edges.size()) +
      " such edges); expected all parts of the wall, open at most at its ends along z");
}

/// Closes what is open at the lowest and the highest z: each open edge makes a triangle with a point of that
/// plane. Whatever the shape of the opening, the triangles' signed areas add up to it.
void close_ends(Surface& surface, double tolerance, const std::string& files) {
  const Edges edges = open_edges(surface.triangles);
  if (edges.empty()) return;
  const auto [lowest, highest] =
      std::minmax_element(surface.points.begin(), surface.points.end(),
                          [](const Vector3d& p, const Vector3d& q) { return p.z() < q.z(); });
  const std::array<double, 2> ends{lowest->z(), highest->z()};
  for (const auto& edge : edges) {
    const auto& [ends_of_edge, net] = edge;
    const Vector3d& a = point_of(surface, ends_of_edge.first);
    const Vector3d& b = point_of(surface, ends_of_edge.second);
    const auto is_at = [&](double z) {
      return std::abs(a.z() - z) <= tolerance && std::abs(b.z() - z) <= tolerance;
    };
    if (std::abs(net) > 1 || !(is_at(ends[0]) || is_at(ends[1])))
      throw not_closed(surface, edges, edge, files);
  }
  const auto first = static_cast<int>(surface.points.size());
  const Vector3d middle = [&] {
    Eigen::AlignedBox3d box;
    for (const Vector3d& point : surface.points) box.extend(point);
    return Vector3d(box.center());
  }();
  for (const double z : ends) surface.points.emplace_back(middle.x(), middle.y(), z);
  for (const auto& [edge, net] : edges) {
    const double z = point_of(surface, edge.first).z();
    const int centre = first + (std::abs(z - ends[0]) <= tolerance ? 0 : 1);
    const auto [from, to] = net > 0 ? std::pair(edge.second, edge.first) : edge;
    surface.triangles.push_back({from, to, centre});
  }
  surface.caps = edges.size();
}

void turn_outwards(Surface& surface) {
  if (enclosed_volume(surface) >= 0) return;
  for (auto& triangle : surface.triangles) std::swap(triangle[1], triangle[2]);
}

std::string listed(const std::vector<std::filesystem::path>& files) {
  std::string names;
  for (const auto& file : files) names += (names.empty() ? "" : ", ") + file.string();
  return names;
}

}  // namespace

Surface read_surface(const std::vector<std::filesystem::path>& files) {
  std::vector<StlTriangle> soup;
  for (const std::filesystem::path& file : files) {
    const std::vector<StlTriangle> part = read_stl(file);
    soup.insert(soup.end(), part.begin(), part.end());
  }
  Eigen::AlignedBox3d box;
  for (const StlTriangle& triangle : soup) {
    for (const Vector3d& corner : triangle) box.extend(corner);
  }
  if (box.isEmpty()) throw SurfaceError("no STL file is given, expected those of the mill's walls");
  const double tolerance = same_point * box.diagonal().norm();

  Surface surface;
  PointMerger merger(surface.points, tolerance);
  for (const StlTriangle& corners : soup) {
    const std::array<int, 3> t{merger.number_of(corners[0]), merger.number_of(corners[1]),
                               merger.number_of(corners[2])};
    // One that shrinks to a line takes nothing away.
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) surface.triangles.push_back(t);
  }
  close_ends(surface, tolerance, listed(files));
  turn_outwards(surface);
  return surface;
}

Surface boundary_surface(const MeshGeometry& mesh) {
  Surface surface;
  surface.points = mesh.points();
  for (const Facet& facet : mesh.facets()) {
    if (facet.neighbour >= 0) continue;
    const auto& c = facet.corners;
    surface.triangles.push_back({c[0], c[1], c[2]});
    if (facet.corner_count == 4) surface.triangles.push_back({c[0], c[2], c[3]});
  }
  return surface;
}

double enclosed_volume(const Surface& surface) {
  // About a point of the surface, so that one far from the origin loses no digits.
  const Vector3d origin = surface.points.empty() ? Vector3d::Zero().eval() : surface.points.front();
  double six_volumes = 0;
  for (const auto& [a, b, c] : surface.triangles) {
    six_volumes += (point_of(surface, a) - origin)
                       .cross(point_of(surface, b) - origin)
                       .dot(point_of(surface, c) - origin);
  }
  return six_volumes / 6;
}

}  // namespace millfoam::averaging
