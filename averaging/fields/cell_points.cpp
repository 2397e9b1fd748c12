// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/fields/cell_points.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <stdexcept>
#include <string>

namespace millfoam::averaging {

namespace {

using Eigen::Vector3d;

/// Weights of a tetrahedron's four corners.
using Barycentric = std::array<double, 4>;

/// Centroids of the m^3 tetrahedra of equal volume into which a tetrahedron is cut. Its image is the part 1 >=
/// x >= y >= z >= 0 of the unit cube, which is cut into m^3 small cubes and each of those into the six
/// tetrahedra of the orders of its coordinates (Freudenthal 1942, Ann Math 43:580).
std::vector<Barycentric> centroids(int m) {
  std::vector<Barycentric> result;
  std::array<double, 3> order{0.25, 0.5, 0.75};
  do {
    for (int k = 0; k < m; ++k) {
      for (int j = 0; j < m; ++j) {
        for (int i = 0; i < m; ++i) {
          const double x = (i + order[0]) / m, y = (j + order[1]) / m, z = (k + order[2]) / m;
          if (x > y && y > z) result.push_back({1 - x, x - y, y - z, z});
        }
      }
    }
  } while (std::next_permutation(order.begin(), order.end()));
  return result;
}

}  // namespace

CellPoints::CellPoints(const MeshGeometry& mesh, int divisions) : begin_{0} {
  if (divisions < 1 || divisions > 10) {
    throw std::invalid_argument("an edge is divided by " + std::to_string(divisions) + ", expected 1 to 10");
  }
  const std::vector<Barycentric> parts = centroids(divisions);
  const auto count = static_cast<double>(parts.size());
  for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
    const Vector3d& top = mesh.centres()[cell];
    const auto [first, last] = mesh.facets_of(static_cast<int>(cell));
    for (const int* f = first; f != last; ++f) {
      const Facet& facet = mesh.facets()[static_cast<std::size_t>(*f)];
      const double sign = facet.owner == static_cast<int>(cell) ? 1 : -1;
      const auto corner = [&](int i) -> const Vector3d& {
        return mesh.points()[static_cast<std::size_t>(facet.corners[static_cast<std::size_t>(i)])];
      };
      for (int i = 2; i < facet.corner_count; ++i) {
        const Vector3d &a = corner(0), &b = corner(i - 1), &c = corner(i);
        const double volume = sign * (a - top).dot((b - top).cross(c - top)) / 6;
        for (const Barycentric& w : parts) {
          points_.emplace_back(w[0] * top + w[1] * a + w[2] * b + w[3] * c);
          volumes_.push_back(volume / count);
        }
      }
    }
    begin_.push_back(points_.size());
  }
}

void CellPoints::deposit(const BoxGrid& grid, const Eigen::Isometry3d& place,
                         const std::vector<double>& values, VoxelSums& sums) const {
  const std::size_t components = sums.components;
  assert(values.size() == cells() * components && sums.volume.size() == grid.size());
  for (std::size_t cell = 0; cell < cells(); ++cell) {
    for (std::size_t p = begin_[cell]; p < begin_[cell + 1]; ++p) {
      const Vector3d at = place * points_[p];
      const auto voxel = grid.locate({at.x(), at.y(), at.z()});
      if (!voxel) {
        sums.outside += volumes_[p];
        continue;
      }
      const std::size_t n = grid.offset(*voxel);
      sums.volume[n] += volumes_[p];
      for (std::size_t k = 0; k < components; ++k) {
        sums.values[n * components + k] += volumes_[p] * values[cell * components + k];
      }
    }
  }
}

}  // namespace millfoam::averaging
