// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/sharing/box_sampling.hpp"

#include <algorithm>
#include <cmath>

namespace millfoam::averaging {

namespace {

constexpr double pi = 3.14159265358979323846;
constexpr int outside = -1;

/// Neighbouring layers of the template's lattice that fall into one voxel along an axis.
struct Run {
  int voxel;  ///< number along the axis, or `outside`
  SphereTemplate::Layers layers;
};

int voxel_along(const BoxGrid& grid, std::size_t axis, double coordinate) {
  const double cells = grid.shape()[axis];
  double place = std::floor((coordinate - grid.lower()[axis]) / grid.spacing()[axis]);
  if (grid.periodic()[axis]) {
    place -= cells * std::floor(place / cells);
  } else if (!(coordinate >= grid.lower()[axis] && coordinate < grid.upper()[axis])) {
    return outside;
  }
  // Rounding can put a point just below the upper face into the voxel after the last; an absurd size gives no
  // number.
  return place > 0 ? static_cast<int>(std::min(place, cells - 1)) : 0;
}

/// Cuts the lattice's layers along an axis into the voxels that they fall into; `runs` is overwritten.
void cut_layers(const BoxGrid& grid, const SphereTemplate& points, std::size_t axis, double centre,
                double radius, std::vector<Run>& runs) {
  runs.clear();
  for (int i = 0; i < points.points_per_diameter(); ++i) {
    const int voxel = voxel_along(grid, axis, centre + radius * points.coordinate(i));
    if (runs.empty() || runs.back().voxel != voxel) runs.push_back({voxel, {i, i}});
    runs.back().layers.end = i + 1;
  }
}

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

void add_part(const Particle& particle, double volume, std::size_t voxel, RecordSums& sums) {
  const double diameter = 2 * particle.radius;
  double speed2 = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    sums.momentum[3 * voxel + a] += volume * particle.velocity[a];
    speed2 += particle.velocity[a] * particle.velocity[a];
  }
  sums.volume[voxel] += volume;
  sums.volume_over_diameter[voxel] += volume / diameter;
  sums.volume_times_diameter[voxel] += volume * diameter;
  sums.volume_times_speed2[voxel] += volume * speed2;
}

/// Shares a sphere between voxels and returns the number of the template's points in the grid.
int share_out(const BoxGrid& grid, const SphereTemplate& points, const Particle& particle,
              const Vector3& centre, double volume, RecordSums& sums) {
  thread_local std::array<std::vector<Run>, 3> runs;
  for (std::size_t a = 0; a < 3; ++a) cut_layers(grid, points, a, centre[a], particle.radius, runs[a]);
  int deposited = 0;
  for (const Run& z : runs[2]) {
    for (const Run& y : runs[1]) {
      for (const Run& x : runs[0]) {
        if (x.voxel == outside || y.voxel == outside || z.voxel == outside) continue;
        const int count = points.count(x.layers, y.layers, z.layers);
        if (count == 0) continue;
        deposited += count;
        add_part(particle, volume * count / points.size(), grid.offset({x.voxel, y.voxel, z.voxel}), sums);
      }
    }
  }
  return deposited;
}

}  // namespace

RecordSums::RecordSums(std::size_t voxels)
    : volume(voxels, 0.0),
      momentum(3 * voxels, 0.0),
      volume_over_diameter(voxels, 0.0),
      volume_times_diameter(voxels, 0.0),
      volume_times_speed2(voxels, 0.0) {}

void deposit(const BoxGrid& grid, const SphereTemplate& points, const Particle& particle, RecordSums& sums) {
  const double volume = 4.0 / 3.0 * pi * particle.radius * particle.radius * particle.radius;
  const Vector3 centre = grid.wrapped(particle.position);
  int inside = points.size();
  if (const std::optional<VoxelIndex> voxel = holding_voxel(grid, centre, particle.radius)) {
    add_part(particle, volume, grid.offset(*voxel), sums);
  } else {
    inside = share_out(grid, points, particle, centre, volume, sums);
  }
  sums.ledger.volume_in += volume;
  sums.ledger.deposited += volume * inside / points.size();
  sums.ledger.outside += volume * (points.size() - inside) / points.size();
  sums.balls += static_cast<double>(inside) / points.size();
}

RecordSums sample_record(const BoxGrid& grid, const SphereTemplate& points, const ParticleRecord& record) {
  RecordSums sums(grid.size());
  for (const Particle& particle : record.particles) deposit(grid, points, particle, sums);
  return sums;
}

}  // namespace millfoam::averaging
