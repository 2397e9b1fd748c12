// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/fields/cell_samples.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>

#include "averaging/fields/cell_points.hpp"

namespace millfoam::averaging {

namespace {

using Eigen::Vector3d;

/// Of a length over a voxel's: a cell of the voxel's size, of slightly another form, is no larger.
constexpr double tolerance = 1.05;

/// Lengths in voxels that the points of an undivided tetrahedron reach without a gap of a voxel: along a
/// brick they are at most 0.29 of its length apart.
constexpr double reach = 2.5;

constexpr int most_divisions = 10;

/// Divisions of a cell's tetrahedra for its length in voxels, 0 for a cell that is not divided.
int divisions_of(double length) {
  return length <= tolerance ? 0 : static_cast<int>(std::ceil(length / reach * (1 - 1e-6)));
}

/// Length of a cell over a voxel's, the larger one of that across z, at any angle about z, and that along z.
double length_in_voxels(const MeshGeometry& mesh, std::size_t cell, const Vector3& spacing) {
  const Vector3d& centre = mesh.centres()[cell];
  double across = 0, along = 0;
  const auto [first, last] = mesh.facets_of(static_cast<int>(cell));
  for (const int* f = first; f != last; ++f) {
    const Facet& facet = mesh.facets()[static_cast<std::size_t>(*f)];
    for (std::size_t c = 0; c < static_cast<std::size_t>(facet.corner_count); ++c) {
      const Vector3d from = mesh.points()[static_cast<std::size_t>(facet.corners[c])] - centre;
      across = std::max(across, std::hypot(from[0], from[1]));
      along = std::max(along, std::abs(from[2]));
    }
  }
  // The corners of a square are sqrt(1/2) of its edge from its centre
  return std::max(std::sqrt(2.0) * across / std::min(spacing[0], spacing[1]), 2 * along / spacing[2]);
}

}  // namespace

CellSamples::CellSamples(const MeshGeometry& mesh, const BoxGrid& grid) : begin_{0} {
  std::array<std::optional<CellPoints>, most_divisions + 1> points;  // by divisions
  for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
    const double length = length_in_voxels(mesh, cell, grid.spacing());
    const int divisions = divisions_of(length);
    if (divisions == 0) {
      points_.push_back(mesh.centres()[cell]);
      shares_.push_back(1);
    } else {
      if (divisions > most_divisions)
        throw std::invalid_argument("a cell of the flow's mesh is " + std::to_string(std::lround(length)) +
                                    " voxels of the balls' averages long; expected at most " +
                                    std::to_string(std::lround(reach * most_divisions)) +
                                    ": make more layers of cells, or larger voxels");
      std::optional<CellPoints>& parts = points[static_cast<std::size_t>(divisions)];
      if (!parts) parts.emplace(mesh, divisions);
      double volume = 0;
      parts->for_points(cell, [&](const Vector3d& point, double part) {
        // A part outside the cell counts negative, and has no solids of its own
        if (!(part > 0)) return;
        points_.push_back(point);
        shares_.push_back(part);
        volume += part;
      });
      for (std::size_t n = begin_.back(); n < shares_.size(); ++n) shares_[n] /= volume;
    }
    begin_.push_back(points_.size());
  }
}

}  // namespace millfoam::averaging
