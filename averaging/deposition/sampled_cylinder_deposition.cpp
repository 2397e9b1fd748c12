// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/deposition/sampled_cylinder_deposition.hpp"

#include <algorithm>
#include <cmath>

#include "meshing/surface/pi.hpp"

namespace millfoam::averaging {

SampledCylinderDeposition::SampledCylinderDeposition(const CylinderGrid& grid, int template_points)
    : CylinderDeposition(grid, template_points),
      points_(std::make_shared<const SphereTemplate>(template_points)) {
  const int n = points_->points_per_diameter();
  std::vector<Column> columns;
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      int begin = 0;
      while (2 * begin < n && !points_->contains(i, j, begin)) ++begin;
      if (2 * begin < n) columns.push_back({points_->coordinate(i), points_->coordinate(j), begin});
    }
  }
  columns_ = std::make_shared<const std::vector<Column>>(std::move(columns));
}

void SampledCylinderDeposition::cut_layers(double centre, double radius) {
  runs_.clear();
  for (int k = 0; k < points_->points_per_diameter(); ++k) {
    const int layer = z_axis().cell_at(centre + radius * points_->coordinate(k));
    if (runs_.empty() || runs_.back().layer != layer) runs_.push_back({layer, k, k});
    runs_.back().end = k + 1;
  }
}

int* SampledCylinderDeposition::counts_of(int ring, int sector) {
  const std::array<int, 2> cell{ring, sector};
  const auto found = std::find(cells_.rbegin(), cells_.rend(), cell);
  auto number = static_cast<std::size_t>(cells_.rend() - found) - 1;
  if (found == cells_.rend()) {
    number = cells_.size();
    cells_.push_back(cell);
    counts_.resize(counts_.size() + runs_.size(), 0);
  }
  return counts_.data() + number * runs_.size();
}

void SampledCylinderDeposition::deposit(const Particle& sphere, std::vector<Deposit>& deposits) {
  deposits.clear();
  cells_.clear();
  counts_.clear();
  const Vector3 centre = grid().wrapped(sphere.position);
  cut_layers(centre[2], sphere.radius);
  const int n = points_->points_per_diameter();
  for (const Column& column : *columns_) {
    const auto voxel = grid().locate(
        {centre[0] + sphere.radius * column.x, centre[1] + sphere.radius * column.y, grid().ends()[0]});
    if (!voxel) continue;
    int* counts = counts_of((*voxel)[0], (*voxel)[1]);
    for (const Run& run : runs_) {
      *counts++ += std::max(0, std::min(run.end, n - column.begin) - std::max(run.begin, column.begin));
    }
  }
  const double volume = 4.0 / 3.0 * pi * sphere.radius * sphere.radius * sphere.radius;
  const int* count = counts_.data();
  for (const auto& [ring, sector] : cells_) {
    for (const Run& run : runs_) {
      const int points = *count++;
      if (points == 0 || run.layer == GridAxis::outside) continue;
      deposits.push_back({grid().offset({ring, sector, run.layer}), volume * points / points_->size()});
    }
  }
}

}  // namespace millfoam::averaging
