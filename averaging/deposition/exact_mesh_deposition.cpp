// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/deposition/exact_mesh_deposition.hpp"

#include <algorithm>
#include <cmath>

#include "averaging/mesh/facet_cut.hpp"
#include "averaging/overlap/sphere_triangle.hpp"
#include "averaging/values/as_index.hpp"
#include "meshing/surface/pi.hpp"

namespace millfoam::averaging {

namespace {

using Eigen::Vector3d;

bool sphere_holds(const Vector3d& centre, double radius, const Eigen::AlignedBox3d& box) {
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

void ExactMeshDeposition::deposit_image(const Vector3d& centre, double radius,
                                        std::vector<Deposit>& deposits) {
  clear_met_cells();
  if (!deposit_by_facet_cuts(centre, radius)) deposit_by_cones(centre, radius);
  append_deposits(4.0 / 3.0 * pi * radius * radius * radius, deposits);
}

/// Where in `met_cells_` a cell is that is now known to be near.
int ExactMeshDeposition::meet_cell(int cell, const Vector3d& centre, double radius) {
  const int known = find_met_cell(cell);
  if (known >= 0) return known;
  const int number = add_met_cell(cell);
  if (sphere_holds(centre, radius, mesh().geometry().boxes()[as_index(cell)])) {
    met_cells_[as_index(number)].whole = true;
    met_cells_[as_index(number)].volume = mesh().geometry().volumes()[as_index(cell)];
  }
  return number;
}

void ExactMeshDeposition::add_candidates(const Vector3d& centre, double radius) {
  const Vector3d reach = Vector3d::Constant(radius);
  mesh().search().candidates({centre - reach, centre + reach}, candidates_);
  // The tree's order depends on the times that it has followed, and with it the sums' round-off
  std::sort(candidates_.begin(), candidates_.end());
  for (const int cell : candidates_) {
    if (mesh().geometry().boxes()[as_index(cell)].squaredExteriorDistance(centre) < radius * radius) {
      meet_cell(cell, centre, radius);
    }
  }
}

/// From cell to cell through the facets that the sphere meets; returns false when one is delicate.
bool ExactMeshDeposition::deposit_by_facet_cuts(const Vector3d& centre, double radius) {
  const int holding = mesh().search().locate(centre);
  bool at_boundary = holding < 0, looked_around = false;
  if (holding >= 0) {
    MetCell& met = met_cells_[as_index(meet_cell(holding, centre, radius))];
    if (!met.whole) met.volume = 4.0 / 3.0 * pi * radius * radius * radius;
  }
  for (std::size_t number = 0;; ++number) {
    if (number == met_cells_.size()) {
      if (!at_boundary || looked_around) return true;
      looked_around = true;
      add_candidates(centre, radius);
      if (number == met_cells_.size()) return true;
    }
    if (!cut_cell(number, centre, radius, at_boundary)) return false;
  }
}

/// Works out the facets of a cell that its other cells have not; returns false when one is delicate.
bool ExactMeshDeposition::cut_cell(std::size_t number, const Vector3d& centre, double radius,
                                   bool& at_boundary) {
  const MeshGeometry& geometry = mesh().geometry();
  const int cell = met_cells_[number].cell;
  const bool whole = met_cells_[number].whole;
  const auto [begin, end] = geometry.facets_of(cell);
  for (const int* f = begin; f != end; ++f) {
    const Facet& facet = geometry.facets()[as_index(*f)];
    if (std::abs(facet.offset - facet.normal.dot(centre)) >= radius) continue;
    const int other = facet.other(cell);
    if (other >= 0) {
      const int other_number = find_met_cell(other);
      if (other_number >= 0 && as_index(other_number) < number) continue;
      if (whole && met_cells_[as_index(meet_cell(other, centre, radius))].whole) continue;
    } else if (whole) {
      at_boundary = true;
      continue;
    }
    const FacetCut cut = cut_facet(facet, geometry.points(), centre, radius);
    if (cut.kind == FacetCut::Kind::none) continue;
    if (cut.kind == FacetCut::Kind::delicate) return false;
    const double beyond = facet.owner == cell ? cut.beyond : -cut.beyond;
    if (!whole) met_cells_[number].volume -= beyond;
    if (other < 0) {
      at_boundary = true;
      continue;
    }
    MetCell& met = met_cells_[as_index(meet_cell(other, centre, radius))];
    if (!met.whole) met.volume += beyond;
  }
  return true;
}

/// All cells around, each by the cones from the centre over its facets.
void ExactMeshDeposition::deposit_by_cones(const Vector3d& centre, double radius) {
  const MeshGeometry& geometry = mesh().geometry();
  clear_met_cells();
  add_candidates(centre, radius);
  const auto count = static_cast<int>(met_cells_.size());
  for (int number = 0; number < count; ++number) {
    MetCell& met = met_cells_[as_index(number)];
    const auto [begin, end] = geometry.facets_of(met.cell);
    for (const int* f = begin; f != end; ++f) {
      const Facet& facet = geometry.facets()[as_index(*f)];
      const int other = facet.other(met.cell), other_number = other < 0 ? -1 : find_met_cell(other);
      if (other_number >= 0 && other_number < number) continue;
      const bool for_other = other_number >= 0 && !met_cells_[as_index(other_number)].whole;
      if (met.whole && !for_other) continue;
      const double outwards = cone_volume(facet, geometry.points(), centre, radius);
      const double volume = facet.owner == met.cell ? outwards : -outwards;
      if (!met.whole) met.volume += volume;
      if (for_other) met_cells_[as_index(other_number)].volume -= volume;
    }
  }
}

}  // namespace millfoam::averaging
