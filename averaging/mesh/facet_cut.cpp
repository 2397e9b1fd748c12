// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/mesh/facet_cut.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "meshing/surface/pi.hpp"

namespace millfoam::averaging {

namespace {

using Eigen::Vector3d;

constexpr double near_plane = 1e-6;
constexpr double near_edge = 1e-3;
constexpr double near_corner = 1e-9;

/// K of the header for h and p that are not negative, without the factor 1/3.
double cut_off(double radius, double h, double p, double from, double to) {
  const double d2 = h * h + p * p;
  const double w_from = std::sqrt(d2 + from * from), w_to = std::sqrt(d2 + to * to);
  const double angle = std::atan2(p * (to - from), p * p + from * to);
  const double bent =
      std::atan2(p * h * (to * w_from - from * w_to), p * p * w_from * w_to + h * h * from * to);
  const double r2 = radius * radius;
  return r2 * radius * bent - h * (3 * r2 - h * h) / 2 * angle + h * p * (to - from) / 2;
}

/// The facet's corners from the foot of the perpendicular from the centre, the first one again at the end.
/// They are put into one plane through the foot, so that neighbouring edges see one corner.
std::array<Vector3d, 5> corners_from(const Vector3d& foot, const Facet& facet, const MeshPoints& points) {
  const auto count = static_cast<std::size_t>(facet.corner_count);
  std::array<Vector3d, 5> corners;
  for (std::size_t i = 0; i < count; ++i) {
    corners[i] = points[static_cast<std::size_t>(facet.corners[i])] - foot;
    corners[i] -= facet.normal.dot(corners[i]) * facet.normal;
  }
  corners[count] = corners[0];
  return corners;
}

}  // namespace

FacetCut cut_facet(const Facet& facet, const MeshPoints& points, const Vector3d& centre, double radius) {
  const double height = facet.offset - facet.normal.dot(centre), h = std::abs(height);
  if (h >= radius) return {};
  const double reach2 = (radius - h) * (radius + h);
  const auto count = static_cast<std::size_t>(facet.corner_count);
  const std::array<Vector3d, 5> corners = corners_from(centre + height * facet.normal, facet, points);

  std::array<double, 4> area{}, length2{};
  bool foot_inside = true;
  for (std::size_t i = 0; i < count; ++i) {
    area[i] = facet.normal.dot(corners[i].cross(corners[i + 1]));
    length2[i] = (corners[i + 1] - corners[i]).squaredNorm();
    if (area[i] >= 0) continue;
    foot_inside = false;
    if (area[i] * area[i] >= reach2 * length2[i]) return {};
  }
  bool touched = foot_inside, delicate = h < near_plane * radius;
  double edges = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double chord2 = reach2 - area[i] * area[i] / length2[i];
    if (!(chord2 > 0)) continue;
    const double length = std::sqrt(length2[i]), q = std::sqrt(chord2), p = std::abs(area[i]) / length;
    const Vector3d along = (corners[i + 1] - corners[i]) / length;
    const double begin = along.dot(corners[i]), end = along.dot(corners[i + 1]);
    if (begin >= q || end <= -q) continue;
    touched = true;
    const double nearest = std::min(begin * begin, end * end) + p * p;
    delicate = delicate || h * h + p * p < near_edge * near_edge * radius * radius ||
               nearest < near_corner * near_corner * radius * radius;
    edges += std::copysign(cut_off(radius, h, p, std::max(begin, -q), std::min(end, q)), area[i]);
  }
  if (!touched) return {};
  if (delicate) return {FacetCut::Kind::delicate, 0};
  const double cap = foot_inside ? pi * (radius - h) * (radius - h) * (2 * radius + h) : 0;
  return {FacetCut::Kind::clear, std::copysign((cap - edges) / 3, height)};
}

}  // namespace millfoam::averaging
