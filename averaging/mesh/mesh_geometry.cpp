// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/mesh/mesh_geometry.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "averaging/values/as_index.hpp"

namespace millfoam::averaging {

namespace {

using Eigen::Vector3d;

/// Of the mesh's extent: coordinates that come from files or out of a rotation are not exact.
constexpr double rounding = 1e-14;

/// Of a face's size: below it a fan's middle point has no advantage.
constexpr double nearly_flat = 1e-6;

/// Largest distance of a quadrangle's corners from the plane midway between its diagonals, m.
double warp(const std::array<Vector3d, 4>& p) {
  const Vector3d across = (p[2] - p[0]).cross(p[3] - p[1]);
  const double length = across.norm();
  return length > 0 ? std::abs(across.dot(p[1] - p[0])) / (2 * length) : 0;
}

bool is_convex(const std::array<Vector3d, 4>& p) {
  const Vector3d across = (p[2] - p[0]).cross(p[3] - p[1]);
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector3d turn = (p[(i + 1) % 4] - p[i]).cross(p[(i + 2) % 4] - p[(i + 1) % 4]);
    if (!(turn.dot(across) > 0)) return false;
  }
  return true;
}

}  // namespace

MeshGeometry::MeshGeometry(MeshTopology topology, const MeshPoints& points) : topology_(std::move(topology)) {
  cell_faces_ = list_by_cell(
      topology_.faces(), [this](std::size_t f) { return topology_.owner[f]; },
      [this](std::size_t f) { return f < topology_.internal_faces() ? topology_.neighbour[f] : -1; });
  move(points);
}

void MeshGeometry::move(const MeshPoints& points) {
  assert(points.size() == topology_.points);
  points_ = points;
  box_.setEmpty();
  for (const Vector3d& point : points_) box_.extend(point);
  cut_faces();
  cell_facets_ = list_by_cell(
      facets_.size(), [this](std::size_t f) { return facets_[f].owner; },
      [this](std::size_t f) { return facets_[f].neighbour; });
  measure_cells();
}

template <typename OwnerOf, typename OtherOf>
MeshGeometry::Lists MeshGeometry::list_by_cell(std::size_t count, OwnerOf&& owner_of,
                                               OtherOf&& other_of) const {
  Lists lists;
  lists.begin.assign(topology_.cells + 1, 0);
  for (std::size_t item = 0; item < count; ++item) {
    ++lists.begin[as_index(owner_of(item)) + 1];
    if (other_of(item) >= 0) ++lists.begin[as_index(other_of(item)) + 1];
  }
  for (std::size_t c = 0; c < topology_.cells; ++c) lists.begin[c + 1] += lists.begin[c];
  lists.items.resize(as_index(lists.begin.back()));
  std::vector<int> next(lists.begin.begin(), lists.begin.end() - 1);
  for (std::size_t item = 0; item < count; ++item) {
    lists.items[as_index(next[as_index(owner_of(item))]++)] = static_cast<int>(item);
    if (other_of(item) >= 0) lists.items[as_index(next[as_index(other_of(item))]++)] = static_cast<int>(item);
  }
  return lists;
}

void MeshGeometry::cut_faces() {
  facets_.clear();
  face_facets_.clear();
  const double flat = rounding * (box_.max().cwiseAbs().cwiseMax(box_.min().cwiseAbs())).maxCoeff();
  for (std::size_t face = 0; face < topology_.faces(); ++face) {
    face_facets_.push_back(static_cast<int>(facets_.size()));
    cut_face(face, flat);
  }
  face_facets_.push_back(static_cast<int>(facets_.size()));
}

void MeshGeometry::cut_face(std::size_t face, double flat) {
  const int* corner = topology_.face_points.data() + topology_.face_begin[face];
  const int count = topology_.face_begin[face + 1] - topology_.face_begin[face];
  if (count == 3) return add_facet(face, {corner[0], corner[1], corner[2], -1}, 3);
  if (count == 4) {
    const std::array<Vector3d, 4> p{points_[as_index(corner[0])], points_[as_index(corner[1])],
                                    points_[as_index(corner[2])], points_[as_index(corner[3])]};
    const double height = warp(p);
    if (height <= flat && is_convex(p)) {
      return add_facet(face, {corner[0], corner[1], corner[2], corner[3]}, 4);
    }
    if (height <= nearly_flat * (p[2] - p[0]).norm()) {
      const auto low = std::min_element(corner, corner + 4) - corner;
      add_facet(face, {corner[low], corner[(low + 1) % 4], corner[(low + 2) % 4], -1}, 3);
      return add_facet(face, {corner[low], corner[(low + 2) % 4], corner[(low + 3) % 4], -1}, 3);
    }
  }
  Vector3d middle = Vector3d::Zero();
  for (int i = 0; i < count; ++i) middle += points_[as_index(corner[i])];
  const int centre = static_cast<int>(points_.size());
  points_.emplace_back(middle / count);
  for (int i = 0; i < count; ++i) add_facet(face, {corner[i], corner[(i + 1) % count], centre, -1}, 3);
}

void MeshGeometry::add_facet(std::size_t face, const std::array<int, 4>& corners, int count) {
  const Vector3d &a = points_[as_index(corners[0])], &b = points_[as_index(corners[1])],
                 &c = points_[as_index(corners[2])];
  const Vector3d& last = count == 4 ? points_[as_index(corners[3])] : c;
  const Vector3d across = count == 4 ? (c - a).cross(last - b) : (b - a).cross(c - a);
  const double length = across.norm();
  // A facet without area bounds nothing.
  if (!(length > 1e-15 * (c - a).squaredNorm())) return;
  Facet facet;
  facet.corners = corners;
  facet.corner_count = count;
  facet.owner = topology_.owner[face];
  facet.neighbour = face < topology_.internal_faces() ? topology_.neighbour[face] : -1;
  facet.normal = across / length;
  facet.offset = facet.normal.dot(count == 4 ? Vector3d((a + b + c + last) / 4) : Vector3d((a + b + c) / 3));
  facets_.push_back(facet);
}

void MeshGeometry::measure_cells() {
  volumes_.resize(cells());
  centres_.resize(cells());
  boxes_.resize(cells());
  for (int cell = 0; as_index(cell) < cells(); ++cell) measure_cell(cell);
}

void MeshGeometry::measure_cell(int cell) {
  Eigen::AlignedBox3d box;
  Vector3d area = Vector3d::Zero(), moment = Vector3d::Zero();
  double volume = 0, area_sum = 0;
  const auto [begin, end] = facets_of(cell);
  const Vector3d base =
      begin == end ? Vector3d::Zero() : points_[as_index(facets_[as_index(*begin)].corners[0])];
  for (const int* f = begin; f != end; ++f) {
    const Facet& facet = facets_[as_index(*f)];
    const double sign = facet.owner == cell ? 1 : -1;
    const Vector3d a = points_[as_index(facet.corners[0])] - base;
    box.extend(points_[as_index(facet.corners[0])]).extend(points_[as_index(facet.corners[1])]);
    for (int i = 2; i < facet.corner_count; ++i) {
      const Vector3d b = points_[as_index(facet.corners[as_index(i - 1)])] - base;
      const Vector3d c = points_[as_index(facet.corners[as_index(i)])] - base;
      const Vector3d across = (b - a).cross(c - a);
      const double part = sign * a.dot(across);
      box.extend(points_[as_index(facet.corners[as_index(i)])]);
      area += sign * across;
      area_sum += across.norm();
      volume += part;
      moment += part * (a + b + c);
    }
  }
  const double size = begin == end ? 0 : box.diagonal().norm();
  if (!(area.norm() <= 1e-9 * area_sum)) {
    throw std::invalid_argument("mesh: cell " + std::to_string(cell) + " is not enclosed by its faces");
  }
  if (!(volume > 1e-15 * size * size * size)) {
    std::ostringstream message;
    message << "mesh: cell " << cell << " has the volume " << volume / 6 << " m3, expected a positive one";
    throw std::invalid_argument(message.str());
  }
  volumes_[as_index(cell)] = volume / 6;
  centres_[as_index(cell)] = base + moment / (4 * volume);
  boxes_[as_index(cell)] = box;
}

}  // namespace millfoam::averaging
