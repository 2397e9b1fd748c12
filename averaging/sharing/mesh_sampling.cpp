// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "averaging/sharing/mesh_sharing.hpp"
#include "averaging/values/pi.hpp"

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

MeshSampling::MeshSampling(std::unique_ptr<MovingMesh> mesh, int points_per_diameter,
                           std::optional<double> period_z)
    : MeshSharing(std::move(mesh), points_per_diameter, period_z),
      points_(lattice_points(SphereTemplate(points_per_diameter))) {}

bool MeshSampling::is_in_one_cell(int cell, const Vector3d& centre, double radius) const {
  const MeshGeometry& geometry = mesh().geometry();
  const auto [begin, end] = geometry.facets_of(cell);
  for (const int* f = begin; f != end; ++f) {
    const Facet& facet = geometry.facets()[static_cast<std::size_t>(*f)];
    if (std::abs(facet.offset - facet.normal.dot(centre)) < radius) return false;
  }
  return true;
}

void MeshSampling::share_image(const Vector3d& centre, double radius, std::vector<Share>& shares) {
  // A point outside the mesh belongs to another image of the ball, so here nothing is wrapped.
  const CellSearch& search = mesh().search();
  const double volume = 4.0 / 3.0 * pi * radius * radius * radius;
  const int holding = search.locate(centre);
  clear_parts();
  if (holding >= 0 && is_in_one_cell(holding, centre, radius)) {
    shares.push_back({static_cast<std::size_t>(holding), volume});
    return;
  }
  int hint = holding;
  for (const Vector3d& point : *points_) {
    const int cell = search.locate(centre + radius * point, hint);
    if (cell < 0) continue;
    hint = cell;
    parts_[static_cast<std::size_t>(part_of(cell))].volume += 1;
  }
  for (const Part& part : parts_) {
    shares.push_back(
        {static_cast<std::size_t>(part.cell), volume * (part.volume / static_cast<double>(points_->size()))});
  }
}

}  // namespace millfoam::averaging
