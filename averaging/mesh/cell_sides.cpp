// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/mesh/cell_sides.hpp"

#include <algorithm>
#include <cmath>

namespace millfoam::averaging {

namespace {

using Eigen::Vector3d;

constexpr double pi = 3.14159265358979323846;

std::size_t at(int number) {
  return static_cast<std::size_t>(number);
}

/// Twice the face's area as a vector along its mean normal, out of its owner.
Vector3d area_vector(const MeshGeometry& geometry, std::size_t face) {
  const MeshTopology& topology = geometry.topology();
  const int* corner = topology.face_points.data() + topology.face_begin[face];
  const int count = topology.face_begin[face + 1] - topology.face_begin[face];
  const Vector3d& base = geometry.points()[at(corner[0])];
  Vector3d sum = Vector3d::Zero();
  for (int i = 2; i < count; ++i) {
    sum += (geometry.points()[at(corner[i - 1])] - base).cross(geometry.points()[at(corner[i])] - base);
  }
  return sum;
}

/// Signed solid angle of a triangle seen from the origin (Van Oosterom & Strackee 1983).
double solid_angle(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const double la = a.norm(), lb = b.norm(), lc = c.norm();
  return 2 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
}

}  // namespace

void CellSides::update(const MeshGeometry& geometry) {
  origin_ = geometry.box().center();
  const Vector3d reach = geometry.box().max().cwiseAbs().cwiseMax(geometry.box().min().cwiseAbs());
  // Rounding of the point, the normal and the sum, each 6e-8, bounded by 7 of them.
  slack_ = 5e-7 * geometry.box().diagonal().norm() / 2;
  flat_ = 1e-14 * reach.maxCoeff();
  begin_.assign(1, 0);
  planes_.clear();
  std::vector<Vector3d> corners;
  for (int cell = 0; at(cell) < geometry.cells(); ++cell) {
    add_cell(geometry, cell, corners);
    begin_.push_back(static_cast<int>(planes_.size()));
  }
}

void CellSides::add_cell(const MeshGeometry& geometry, int cell, std::vector<Vector3d>& corners) {
  const MeshTopology& topology = geometry.topology();
  corners.clear();
  const auto [first_facet, last_facet] = geometry.facets_of(cell);
  for (const int* f = first_facet; f != last_facet; ++f) {
    const Facet& facet = geometry.facets()[at(*f)];
    for (int i = 0; i < facet.corner_count; ++i) {
      corners.push_back(geometry.points()[at(facet.corners[at(i)])] - origin_);
    }
  }
  const auto [first_face, last_face] = geometry.faces_of(cell);
  Eigen::Index lane = 4;
  for (const int* face = first_face; face != last_face; ++face) {
    const double sign = topology.owner[at(*face)] == cell ? 1 : -1;
    const Vector3d area = sign * area_vector(geometry, at(*face));
    const double length = area.norm();
    if (!(length > 0)) continue;
    const Vector3d normal = area / length;
    double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
    for (int f = geometry.first_facet(at(*face)); f < geometry.first_facet(at(*face) + 1); ++f) {
      const Facet& facet = geometry.facets()[at(f)];
      for (int i = 0; i < facet.corner_count; ++i) {
        low = std::min(low, normal.dot(geometry.points()[at(facet.corners[at(i)])] - origin_));
      }
    }
    for (const Vector3d& corner : corners) high = std::max(high, normal.dot(corner));
    if (lane == 4) {
      planes_.emplace_back();
      lane = 0;
    }
    Planes& planes = planes_.back();
    planes.nx[lane] = static_cast<float>(normal.x());
    planes.ny[lane] = static_cast<float>(normal.y());
    planes.nz[lane] = static_cast<float>(normal.z());
    planes.low[lane] = static_cast<float>(low - slack_);
    planes.high[lane] = static_cast<float>(high + slack_);
    ++lane;
  }
}

CellSides::Side CellSides::side_of_box(int cell, const Local& middle, const Eigen::Vector3f& half) const {
  Eigen::Array4f below = Eigen::Array4f::Constant(-1);
  for (int b = begin_[at(cell)]; b < begin_[at(cell) + 1]; ++b) {
    const Planes& planes = planes_[at(b)];
    const Eigen::Array4f height = planes.nx * middle.x + planes.ny * middle.y + planes.nz * middle.z;
    const Eigen::Array4f reach =
        planes.nx.abs() * half.x() + planes.ny.abs() * half.y() + planes.nz.abs() * half.z();
    if ((height - reach - planes.high).maxCoeff() > 0) return Side::outside;
    below = below.max(height + reach - planes.low);
  }
  return below.maxCoeff() < 0 ? Side::inside : Side::unclear;
}

double CellSides::winding(const MeshGeometry& geometry, const Vector3d& point, int cell) const {
  double sum = 0;
  const auto [begin, end] = geometry.facets_of(cell);
  for (const int* f = begin; f != end; ++f) {
    const Facet& facet = geometry.facets()[at(*f)];
    const Vector3d a = geometry.points()[at(facet.corners[0])] - point;
    // A facet that the point lies on is seen under no angle: both cells get what is left of the sphere.
    if (std::abs(facet.normal.dot(a)) <= flat_) continue;
    double angle = 0;
    for (int i = 2; i < facet.corner_count; ++i) {
      angle += solid_angle(a, geometry.points()[at(facet.corners[at(i - 1)])] - point,
                           geometry.points()[at(facet.corners[at(i)])] - point);
    }
    sum += facet.owner == cell ? angle : -angle;
  }
  return sum / (4 * pi);
}

int CellSides::settle(const MeshGeometry& geometry, const Vector3d& point, const std::vector<int>& cells) const {
  constexpr double seen_from_outside = 1e-6;
  for (const int cell : cells) {
    if (winding(geometry, point, cell) > seen_from_outside) return cell;
  }
  return -1;
}

}  // namespace millfoam::averaging
