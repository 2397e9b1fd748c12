// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "averaging/mesh/facet_cut.hpp"
#include "averaging/overlap/sphere_triangle.hpp"
#include "averaging/sharing/mesh_sharing.hpp"
#include "averaging/values/as_index.hpp"
#include "averaging/values/pi.hpp"

namespace millfoam::averaging {

namespace {

using Eigen::Vector3d;

bool holds(const Vector3d& centre, double radius, const Eigen::AlignedBox3d& box) {
  return (centre - box.min()).cwiseAbs().cwiseMax((box.max() - centre).cwiseAbs()).squaredNorm() <
         radius * radius;
}

double cone_volume(const Facet& facet, const MeshPoints& points, const Vector3d& centre, double radius) {
  const Vector3d a = points[as_index(facet.corners[0])] - centre;
  double sum = 0;
  for (int i = 2; i < facet.corner_count; ++i) {
    sum += sphere_triangle_volume(a, points[as_index(facet.corners[as_index(i - 1)])] - centre,
                                  points[as_index(facet.corners[as_index(i)])] - centre, radius);
  }
  return sum;
}

}  // namespace

void MeshExact::share_image(const Vector3d& centre, double radius, std::vector<Share>& shares) {
  clear_parts();
  if (!share_quickly(centre, radius)) share_robustly(centre, radius);
  hand_over(4.0 / 3.0 * pi * radius * radius * radius, shares);
}

/// Where in `parts_` a cell is that is now known to be near.
int MeshExact::meet(int cell, const Vector3d& centre, double radius) {
  const int known = find_part(cell);
  if (known >= 0) return known;
  const int number = part_of(cell);
  if (holds(centre, radius, mesh().geometry().boxes()[as_index(cell)])) {
    parts_[as_index(number)].whole = true;
    parts_[as_index(number)].volume = mesh().geometry().volumes()[as_index(cell)];
  }
  return number;
}

void MeshExact::add_candidates(const Vector3d& centre, double radius) {
  const Vector3d reach = Vector3d::Constant(radius);
  mesh().search().candidates({centre - reach, centre + reach}, candidates_);
  for (const int cell : candidates_) {
    if (mesh().geometry().boxes()[as_index(cell)].squaredExteriorDistance(centre) < radius * radius) {
      meet(cell, centre, radius);
    }
  }
}

/// Returns false when a facet is delicate.
bool MeshExact::share_quickly(const Vector3d& centre, double radius) {
  const int holding = mesh().search().locate(centre);
  bool at_boundary = holding < 0, looked_around = false;
  if (holding >= 0) {
    Part& part = parts_[as_index(meet(holding, centre, radius))];
    if (!part.whole) part.volume = 4.0 / 3.0 * pi * radius * radius * radius;
  }
  for (std::size_t number = 0;; ++number) {
    if (number == parts_.size()) {
      if (!at_boundary || looked_around) return true;
      looked_around = true;
      add_candidates(centre, radius);
      if (number == parts_.size()) return true;
    }
    if (!cut_cell(number, centre, radius, at_boundary)) return false;
  }
}

/// Works out the facets of a cell that its other cells have not; returns false when one is delicate.
bool MeshExact::cut_cell(std::size_t number, const Vector3d& centre, double radius, bool& at_boundary) {
  const MeshGeometry& geometry = mesh().geometry();
  const int cell = parts_[number].cell;
  const bool whole = parts_[number].whole;
  const auto [begin, end] = geometry.facets_of(cell);
  for (const int* f = begin; f != end; ++f) {
    const Facet& facet = geometry.facets()[as_index(*f)];
    if (std::abs(facet.offset - facet.normal.dot(centre)) >= radius) continue;
    const int other = facet.other(cell);
    if (other >= 0) {
      const int other_part = find_part(other);
      if (other_part >= 0 && as_index(other_part) < number) continue;
      if (whole && parts_[as_index(meet(other, centre, radius))].whole) continue;
    } else if (whole) {
      at_boundary = true;
      continue;
    }
    const FacetCut cut = cut_facet(facet, geometry.points(), centre, radius);
    if (cut.kind == FacetCut::Kind::none) continue;
    if (cut.kind == FacetCut::Kind::delicate) return false;
    const double beyond = facet.owner == cell ? cut.beyond : -cut.beyond;
    if (!whole) parts_[number].volume -= beyond;
    if (other < 0) {
      at_boundary = true;
      continue;
    }
    Part& part = parts_[as_index(meet(other, centre, radius))];
    if (!part.whole) part.volume += beyond;
  }
  return true;
}

void MeshExact::share_robustly(const Vector3d& centre, double radius) {
  const MeshGeometry& geometry = mesh().geometry();
  clear_parts();
  add_candidates(centre, radius);
  const auto count = static_cast<int>(parts_.size());
  for (int number = 0; number < count; ++number) {
    Part& part = parts_[as_index(number)];
    const auto [begin, end] = geometry.facets_of(part.cell);
    for (const int* f = begin; f != end; ++f) {
      const Facet& facet = geometry.facets()[as_index(*f)];
      const int other = facet.other(part.cell), other_part = other < 0 ? -1 : find_part(other);
      if (other_part >= 0 && other_part < number) continue;
      const bool for_other = other_part >= 0 && !parts_[as_index(other_part)].whole;
      if (part.whole && !for_other) continue;
      const double outwards = cone_volume(facet, geometry.points(), centre, radius);
      const double volume = facet.owner == part.cell ? outwards : -outwards;
      if (!part.whole) part.volume += volume;
      if (for_other) parts_[as_index(other_part)].volume -= volume;
    }
  }
}

}  // namespace millfoam::averaging
