// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/deposition/sampled_box_deposition.hpp"

#include <cmath>

#include "meshing/surface/pi.hpp"

namespace millfoam::averaging {

namespace {

/// Whether the sphere lies within one voxel, and which.
std::optional<VoxelIndex> holding_voxel(const BoxGrid& grid, const Vector3& centre, double radius) {
  const std::optional<VoxelIndex> voxel = grid.locate(centre);
  if (!voxel) return std::nullopt;
  const Vector3 middle = grid.centre(*voxel);
  for (std::size_t a = 0; a < 3; ++a) {
    if (std::abs(centre[a] - middle[a]) + radius >= grid.spacing()[a] / 2) return std::nullopt;
  }
  return voxel;
}

}  // namespace

SampledBoxDeposition::SampledBoxDeposition(const BoxGrid& grid, int template_points)
    : BoxDeposition(grid, template_points),
      points_(std::make_shared<const SphereTemplate>(template_points)) {}

void SampledBoxDeposition::cut_layers(std::size_t axis, double centre, double radius) {
  std::vector<Run>& runs = runs_[axis];
  runs.clear();
  for (int i = 0; i < points_->points_per_diameter(); ++i) {
    const int voxel = axes()[axis].cell_at(centre + radius * points_->coordinate(i));
    if (runs.empty() || runs.back().voxel != voxel) runs.push_back({voxel, {i, i}});
    runs.back().layers.end = i + 1;
  }
}

void SampledBoxDeposition::deposit(const Particle& sphere, std::vector<Deposit>& deposits) {
  deposits.clear();
  const double volume = 4.0 / 3.0 * pi * sphere.radius * sphere.radius * sphere.radius;
  const Vector3 centre = grid().wrapped(sphere.position);
  if (const std::optional<VoxelIndex> voxel = holding_voxel(grid(), centre, sphere.radius)) {
    deposits.push_back({grid().offset(*voxel), volume});
    return;
  }
  for (std::size_t a = 0; a < 3; ++a) cut_layers(a, centre[a], sphere.radius);
  for (const Run& z : runs_[2]) {
    for (const Run& y : runs_[1]) {
      for (const Run& x : runs_[0]) {
        if (x.voxel < 0 || y.voxel < 0 || z.voxel < 0) continue;
        const int count = points_->count(x.layers, y.layers, z.layers);
        if (count == 0) continue;
        deposits.push_back({grid().offset({x.voxel, y.voxel, z.voxel}), volume * count / points_->size()});
      }
    }
  }
}

}  // namespace millfoam::averaging
