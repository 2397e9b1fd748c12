// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/mesh/cell_containment.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "averaging/values/as_index.hpp"
#include "meshing/surface/pi.hpp"

namespace millfoam::averaging {

namespace {

using Eigen::Vector3d;

/// Twice the face's area as a vector along its mean normal, out of its owner.
Vector3d area_vector(const MeshGeometry& geometry, std::size_t face) {
  const MeshTopology& topology = geometry.topology();
  const int* corner = topology.face_points.data() + topology.face_begin[face];
  const int count = topology.face_begin[face + 1] - topology.face_begin[face];
  const Vector3d& base = geometry.points()[as_index(corner[0])];
  Vector3d sum = Vector3d::Zero();
  for (int i = 2; i < count; ++i) {
    sum += (geometry.points()[as_index(corner[i - 1])] - base)
               .cross(geometry.points()[as_index(corner[i])] - base);
  }
  return sum;
}

/// Signed solid angle of a triangle seen from the origin (Van Oosterom & Strackee 1983).
double solid_angle(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const double la = a.norm(), lb = b.norm(), lc = c.norm();
  return 2 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
}

}  // namespace

CellContainment::CellContainment(const MeshGeometry& geometry, std::vector<int> order)
    : order_(std::move(order)) {
  update(geometry);
}

CellContainment::CellContainment(const MeshGeometry& geometry) : order_(geometry.cells()) {
  std::iota(order_.begin(), order_.end(), 0);
  update(geometry);
}

void CellContainment::update(const MeshGeometry& geometry) {
  origin_ = geometry.box().center();
  const Vector3d reach = geometry.box().max().cwiseAbs().cwiseMax(geometry.box().min().cwiseAbs());
  // Rounding of the point, the normal and the sum, each 6e-8, bounded by 7 of them.
  slack_ = 5e-7 * geometry.box().diagonal().norm() / 2;
  flat_ = 1e-14 * reach.maxCoeff();
  slabs_.resize(geometry.topology().faces());
  for (std::size_t face = 0; face < slabs_.size(); ++face) measure_face(geometry, face);
  ranges_.resize(geometry.cells());
  star_.resize(geometry.cells());
  planes_.clear();
  for (const int cell : order_) {
    const auto begin = static_cast<int>(planes_.size());
    add_cell(geometry, cell);
    ranges_[as_index(cell)] = {begin, static_cast<int>(planes_.size())};
    star_[as_index(cell)] = is_star(geometry, cell) ? 1 : 0;
  }
}

void CellContainment::measure_face(const MeshGeometry& geometry, std::size_t face) {
  const MeshTopology& topology = geometry.topology();
  Slab& slab = slabs_[face];
  slab.normal = area_vector(geometry, face);
  const double length = slab.normal.norm();
  // A face without area has no normal, and no point is above it.
  if (length > 0) slab.normal /= length;
  slab.low = std::numeric_limits<double>::max();
  slab.high = std::numeric_limits<double>::lowest();
  for (int i = topology.face_begin[face]; i < topology.face_begin[face + 1]; ++i) {
    const double height =
        slab.normal.dot(geometry.points()[as_index(topology.face_points[as_index(i)])] - origin_);
    slab.low = std::min(slab.low, height);
    slab.high = std::max(slab.high, height);
  }
}

void CellContainment::add_cell(const MeshGeometry& geometry, int cell) {
  const MeshTopology& topology = geometry.topology();
  const auto [first, last] = geometry.faces_of(cell);
  Eigen::Index lane = 4;
  for (const int* face = first; face != last; ++face) {
    const Slab& slab = slabs_[as_index(*face)];
    const bool owned = topology.owner[as_index(*face)] == cell;
    const Vector3d normal = owned ? slab.normal : Vector3d(-slab.normal);
    double high = std::numeric_limits<double>::lowest();
    for (const int* other = first; other != last; ++other) {
      for (int i = topology.face_begin[as_index(*other)]; i < topology.face_begin[as_index(*other) + 1];
           ++i) {
        high = std::max(high, normal.dot(geometry.points()[as_index(topology.face_points[as_index(i)])]));
      }
    }
    if (lane == 4) {
      planes_.emplace_back();
      lane = 0;
    }
    Planes& planes = planes_.back();
    planes.nx[lane] = static_cast<float>(normal.x());
    planes.ny[lane] = static_cast<float>(normal.y());
    planes.nz[lane] = static_cast<float>(normal.z());
    planes.low[lane] = static_cast<float>((owned ? slab.low : -slab.high) - slack_);
    planes.high[lane] = static_cast<float>(high - normal.dot(origin_) + slack_);
    if (normal.isZero()) planes.low[lane] = planes.high[lane] = std::numeric_limits<float>::max();
    ++lane;
  }
}

bool CellContainment::is_star(const MeshGeometry& geometry, int cell) const {
  const Vector3d& centre = geometry.centres()[as_index(cell)];
  const double margin = 1e-6 * std::cbrt(geometry.volumes()[as_index(cell)]);
  const auto [begin, end] = geometry.facets_of(cell);
  return std::all_of(begin, end, [&](int f) {
    const Facet& facet = geometry.facets()[as_index(f)];
    const double height = facet.offset - facet.normal.dot(centre);
    return (facet.owner == cell ? height : -height) > margin;
  });
}

/// Of a cell that is star-shaped about its centroid; unclear where the point is about on a facet.
CellContainment::Answer CellContainment::test_star_shaped(const MeshGeometry& geometry, const Vector3d& point,
                                                          int cell) const {
  const LocalPoint place = local(point);
  const auto [begin, end] = geometry.faces_of(cell);
  for (const int* face = begin; face != end; ++face) {
    const auto number = static_cast<std::size_t>(face - begin);
    const Planes& planes = planes_[as_index(ranges_[as_index(cell)].begin) + number / 4];
    const auto lane = static_cast<Eigen::Index>(number % 4);
    const float height = planes.nx[lane] * place.x + planes.ny[lane] * place.y + planes.nz[lane] * place.z;
    if (height < planes.low[lane]) continue;
    const Answer answer = test_face(geometry, point, cell, *face);
    if (answer != Answer::inside) return answer;
  }
  return Answer::inside;
}

/// Inside also when the ray from the centroid through the point does not go through this face.
CellContainment::Answer CellContainment::test_face(const MeshGeometry& geometry, const Vector3d& point,
                                                   int cell, int face) const {
  const Vector3d& centre = geometry.centres()[as_index(cell)];
  const Vector3d ray = point - centre;
  for (int f = geometry.first_facet(as_index(face)); f < geometry.first_facet(as_index(face) + 1); ++f) {
    const Facet& facet = geometry.facets()[as_index(f)];
    const double sign = facet.owner == cell ? 1 : -1;
    bool is_met = true;
    for (int i = 0; is_met && i < facet.corner_count; ++i) {
      const Vector3d from = geometry.points()[as_index(facet.corners[as_index(i)])] - centre;
      const Vector3d to =
          geometry.points()[as_index(facet.corners[as_index((i + 1) % facet.corner_count)])] - centre;
      const double turn = sign * ray.dot(from.cross(to));
      // A ray through an edge may be said to meet both facets, never none.
      is_met = turn >= 0 || turn * turn <= 1e-24 * ray.squaredNorm() * from.squaredNorm() * to.squaredNorm();
    }
    if (!is_met) continue;
    const double above = sign * (facet.normal.dot(point) - facet.offset);
    if (std::abs(above) <= 1e3 * flat_) return Answer::unclear;
    if (above > 0) return Answer::outside;
  }
  return Answer::inside;
}

CellContainment::Answer CellContainment::test_box(int cell, const LocalPoint& middle,
                                                  const Eigen::Vector3f& half) const {
  Eigen::Array4f below = Eigen::Array4f::Constant(-1);
  for (int b = ranges_[as_index(cell)].begin; b < ranges_[as_index(cell)].end; ++b) {
    const Planes& planes = planes_[as_index(b)];
    const Eigen::Array4f height = planes.nx * middle.x + planes.ny * middle.y + planes.nz * middle.z;
    const Eigen::Array4f reach =
        planes.nx.abs() * half.x() + planes.ny.abs() * half.y() + planes.nz.abs() * half.z();
    if ((height - reach - planes.high).maxCoeff() > 0) return Answer::outside;
    below = below.max(height + reach - planes.low);
  }
  return below.maxCoeff() < 0 ? Answer::inside : Answer::unclear;
}

double CellContainment::winding(const MeshGeometry& geometry, const Vector3d& point, int cell) const {
  double sum = 0;
  const auto [begin, end] = geometry.facets_of(cell);
  for (const int* f = begin; f != end; ++f) {
    const Facet& facet = geometry.facets()[as_index(*f)];
    const Vector3d a = geometry.points()[as_index(facet.corners[0])] - point;
    // A facet that the point lies on is seen under no angle: both cells get what is left of the sphere.
    if (std::abs(facet.normal.dot(a)) <= flat_) continue;
    double angle = 0;
    for (int i = 2; i < facet.corner_count; ++i) {
      angle += solid_angle(a, geometry.points()[as_index(facet.corners[as_index(i - 1)])] - point,
                           geometry.points()[as_index(facet.corners[as_index(i)])] - point);
    }
    sum += facet.owner == cell ? angle : -angle;
  }
  return sum / (4 * pi);
}

int CellContainment::first_holding(const MeshGeometry& geometry, const Vector3d& point,
                                   const std::vector<int>& cells) const {
  constexpr double seen_from_outside = 1e-6;
  for (const int cell : cells) {
    const Answer answer =
        star_[as_index(cell)] != 0 ? test_star_shaped(geometry, point, cell) : Answer::unclear;
    if (answer == Answer::inside) return cell;
    if (answer == Answer::unclear && winding(geometry, point, cell) > seen_from_outside) return cell;
  }
  return -1;
}

}  // namespace millfoam::averaging
