// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/deposition/sampled_mesh_deposition.hpp"

#include <cmath>

#include "averaging/overlap/sphere_template.hpp"
#include "meshing/surface/pi.hpp"

namespace millfoam::averaging {

namespace {

using Eigen::Vector3d;

std::shared_ptr<const std::vector<Vector3d>> lattice_points(const SphereTemplate& lattice) {
  auto points = std::make_shared<std::vector<Vector3d>>();
  const int n = lattice.points_per_diameter();
  for (int k = 0; k < n; ++k) {
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        if (!lattice.contains(i, j, k)) continue;
        points->emplace_back(lattice.coordinate(i), lattice.coordinate(j), lattice.coordinate(k));
      }
    }
  }
  return points;
}

}  // namespace

SampledMeshDeposition::SampledMeshDeposition(std::unique_ptr<MovingMesh> mesh, int points_per_diameter,
                                             std::optional<double> period_z)
    : MeshDeposition(std::move(mesh), points_per_diameter, period_z),
      points_(lattice_points(SphereTemplate(points_per_diameter))) {}

bool SampledMeshDeposition::is_in_one_cell(int cell, const Vector3d& centre, double radius) const {
  const MeshGeometry& geometry = mesh().geometry();
  const auto [begin, end] = geometry.facets_of(cell);
  for (const int* f = begin; f != end; ++f) {
    const Facet& facet = geometry.facets()[static_cast<std::size_t>(*f)];
    if (std::abs(facet.offset - facet.normal.dot(centre)) < radius) return false;
  }
  return true;
}

void SampledMeshDeposition::deposit_image(const Vector3d& centre, double radius,
                                          std::vector<Deposit>& deposits) {
  // A point outside the mesh belongs to another image of the ball, so here nothing is wrapped.
  const CellSearch& search = mesh().search();
  const double volume = 4.0 / 3.0 * pi * radius * radius * radius;
  const int holding = search.locate(centre);
  clear_met_cells();
  if (holding >= 0 && is_in_one_cell(holding, centre, radius)) {
    deposits.push_back({static_cast<std::size_t>(holding), volume});
    return;
  }
  int hint = holding;
  for (const Vector3d& point : *points_) {
    const int cell = search.locate(centre + radius * point, hint);
    if (cell < 0) continue;
    hint = cell;
    met_cells_[static_cast<std::size_t>(add_met_cell(cell))].volume += 1;
  }
  for (const MetCell& met : met_cells_) {
    deposits.push_back(
        {static_cast<std::size_t>(met.cell), volume * (met.volume / static_cast<double>(points_->size()))});
  }
}

}  // namespace millfoam::averaging
