// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/walls/surface.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "meshing/files/text_numbers.hpp"
#include "meshing/surface/face_edges.hpp"
#include "meshing/surface/stl_file.hpp"
#include "meshing/surface/welding.hpp"

namespace millfoam::averaging {

namespace {

using Eigen::Vector3d;

/// Points nearer than this part of the surface's size are one: six digits of a text, or a float.
constexpr double same_point = 1e-6;

/// An edge at which the triangles of a closed surface would not cancel.
struct OpenEdge {
  int low = 0;
  int high = 0;
  int net = 0;  ///< how many more triangles run along it from low to high than back
};

std::vector<OpenEdge> open_edges(const std::vector<std::array<int, 3>>& triangles) {
  const surface::EdgeTable table = surface::find_edges(triangles);
  std::vector<OpenEdge> open;
  for (std::size_t e = 0; e < table.size(); ++e) {
    OpenEdge edge{table.first(e).low, table.first(e).high, 0};
    for (std::size_t s = table.begin[e]; s < table.begin[e + 1]; ++s)
      edge.net += table.sides[s].forward ? 1 : -1;
    if (edge.net != 0) open.push_back(edge);
  }
  return open;
}

const Vector3d& point_of(const Surface& surface, int point) {
  return surface.points[static_cast<std::size_t>(point)];
}

SurfaceError not_closed(const Surface& walls, const std::vector<OpenEdge>& edges, const OpenEdge& edge,
                        const std::string& files) {
  const bool turned = std::abs(edge.net) > 1;
  return SurfaceError(
      files + ": the walls are not a closed surface: at the edge from " +
      described(point_of(walls, edge.low)) + " to " + described(point_of(walls, edge.high)) +
      (turned ? " triangles do not agree on which side is outside" : " a triangle has no neighbour") + " (" +
      std::to_string(edges.size()) +
      " such edges); expected all parts of the wall, open at most at its ends along z");
}

/// Closes what is open at the lowest and the highest z: each open edge makes a triangle with a point of that
/// plane. For any shape of the opening, the triangles' signed areas add up to it.
void close_ends(Surface& surface, double tolerance, const std::string& files) {
  const std::vector<OpenEdge> edges = open_edges(surface.triangles);
  if (edges.empty()) return;
  const auto [lowest, highest] =
      std::minmax_element(surface.points.begin(), surface.points.end(),
                          [](const Vector3d& p, const Vector3d& q) { return p.z() < q.z(); });
  const std::array<double, 2> ends{lowest->z(), highest->z()};
  for (const OpenEdge& edge : edges) {
    const Vector3d& a = point_of(surface, edge.low);
    const Vector3d& b = point_of(surface, edge.high);
    const auto is_at = [&](double z) {
      return std::abs(a.z() - z) <= tolerance && std::abs(b.z() - z) <= tolerance;
    };
    if (std::abs(edge.net) > 1 || !(is_at(ends[0]) || is_at(ends[1])))
      throw not_closed(surface, edges, edge, files);
  }
  const auto first = static_cast<int>(surface.points.size());
  const Vector3d middle = [&] {
    Eigen::AlignedBox3d box;
    for (const Vector3d& point : surface.points) box.extend(point);
    return Vector3d(box.center());
  }();
  for (const double z : ends) surface.points.emplace_back(middle.x(), middle.y(), z);
  for (const auto& [low, high, net] : edges) {
    const double z = point_of(surface, low).z();
    const int centre = first + (std::abs(z - ends[0]) <= tolerance ? 0 : 1);
    const auto [from, to] = net > 0 ? std::pair(high, low) : std::pair(low, high);
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
  std::vector<Vector3d> corners;  // [triangles][3]
  for (const std::filesystem::path& file : files) {
    for (const surface::StlTriangle& triangle : surface::read_stl(file))
      corners.insert(corners.end(), triangle.corners.begin(), triangle.corners.end());
  }
  if (corners.empty()) throw SurfaceError("no STL file is given, expected those of the mill's walls");
  const double tolerance = same_point * surface::extent(corners);

  const surface::Welding welding = surface::weld(corners, tolerance);
  Surface surface;
  surface.points = welding.points;
  for (std::size_t c = 0; c < corners.size(); c += 3) {
    const std::array<int, 3> t{welding.kept[c], welding.kept[c + 1], welding.kept[c + 2]};
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
