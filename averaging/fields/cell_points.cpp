// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/fields/cell_points.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

namespace millfoam::averaging {

namespace {

using Eigen::Vector3d;

/// Centroids of the m^3 tetrahedra of equal volume into which a tetrahedron is cut. Its image is the part 1
/// >= x >= y >= z >= 0 of the unit cube, which is cut into m^3 small cubes and each of those into the six
/// tetrahedra of the orders of its coordinates (Freudenthal 1942, Ann Math 43:580).
/// @return weights of the corners (1,0,0), (1,1,0) and (1,1,1)
std::vector<std::array<double, 3>> centroids(int m) {
  std::vector<std::array<double, 3>> result;
  std::array<double, 3> order{0.25, 0.5, 0.75};
  do {
    for (int k = 0; k < m; ++k) {
      for (int j = 0; j < m; ++j) {
        for (int i = 0; i < m; ++i) {
          const double x = (i + order[0]) / m, y = (j + order[1]) / m, z = (k + order[2]) / m;
          if (x > y && y > z) result.push_back({x - y, y - z, z});
        }
      }
    }
  } while (std::next_permutation(order.begin(), order.end()));
  return result;
}

}  // namespace

/// Finds the voxels of points and adds volume to them. What goes to one voxel in a row is added up first, so
/// that a cell's values are multiplied about once for each voxel that it meets.
class CellPoints::Voxels {
 public:
  Voxels(const BoxGrid& grid, const std::vector<double>& values, VoxelSums& sums)
      : grid_(grid),
        values_(values),
        sums_(sums),
        lower_(Eigen::Map<const Vector3d>(grid.lower().data())),
        per_metre_(Eigen::Map<const Vector3d>(grid.spacing().data()).cwiseInverse()) {}

  /// Whole steps of the grid from its lower corner to a point.
  Eigen::Array3d steps(const Vector3d& point) const {
    return ((point - lower_).array() * per_metre_.array()).floor();
  }

  void begin_cell(std::size_t cell) {
    finish();
    cell_ = cell;
  }

  void add(const Eigen::Array3d& steps, double volume) {
    if (!(steps == last_steps_).all()) {
      finish();
      last_steps_ = steps;
    }
    gathered_ += volume;
  }

  /// Passes on the last sum.
  void finish() {
    if (gathered_ == 0) return;
    const double volume = std::exchange(gathered_, 0.0);
    const std::optional<std::size_t> voxel = voxel_at(last_steps_);
    if (!voxel) {
      sums_.outside += volume;
      return;
    }
    sums_.volume[*voxel] += volume;
    for (std::size_t k = 0; k < sums_.components; ++k) {
      sums_.values[*voxel * sums_.components + k] += volume * values_[cell_ * sums_.components + k];
    }
  }

 private:
  std::optional<std::size_t> voxel_at(const Eigen::Array3d& steps) const {
    VoxelIndex voxel{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double count = grid_.shape()[axis];
      double step = steps[static_cast<Eigen::Index>(axis)];
      if (grid_.periodic()[axis]) step -= count * std::floor(step / count);
      if (!(step >= 0 && step < count)) return std::nullopt;
      voxel[axis] = static_cast<int>(step);
    }
    return grid_.offset(voxel);
  }

  const BoxGrid& grid_;
  const std::vector<double>& values_;
  VoxelSums& sums_;
  Vector3d lower_;
  Vector3d per_metre_;
  std::size_t cell_ = 0;
  Eigen::Array3d last_steps_ = Eigen::Array3d::Zero();
  double gathered_ = 0;
};

CellPoints::CellPoints(const MeshGeometry& mesh, int divisions)
    : points_(mesh.points()), centroids_(mesh.centres()), begin_{0} {
  if (divisions < 1 || divisions > 10) {
    throw std::invalid_argument("an edge is divided by " + std::to_string(divisions) + ", expected 1 to 10");
  }
  parts_ = centroids(divisions);
  for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
    const auto [first, last] = mesh.facets_of(static_cast<int>(cell));
    for (const int* f = first; f != last; ++f) {
      const Facet& facet = mesh.facets()[static_cast<std::size_t>(*f)];
      const double sign = facet.owner == static_cast<int>(cell) ? 1 : -1;
      for (std::size_t i = 2; i < static_cast<std::size_t>(facet.corner_count); ++i) {
        const std::array<int, 3> corners{facet.corners[0], facet.corners[i - 1], facet.corners[i]};
        const auto side = [&](std::size_t c) -> Vector3d {
          return points_[static_cast<std::size_t>(corners[c])] - centroids_[cell];
        };
        tetrahedra_.push_back({corners, sign * side(0).cross(side(1)).dot(side(2)) / 6});
      }
    }
    begin_.push_back(tetrahedra_.size());
  }
}

void CellPoints::deposit(const BoxGrid& grid, const Eigen::Isometry3d& place,
                         const std::vector<double>& values, VoxelSums& sums) const {
  assert(values.size() == cells() * sums.components && sums.volume.size() == grid.size());
  std::vector<Vector3d> points(points_.size());
  std::transform(points_.begin(), points_.end(), points.begin(),
                 [&](const Vector3d& p) { return place * p; });
  Voxels voxels(grid, values, sums);
  for (std::size_t cell = 0; cell < cells(); ++cell) {
    voxels.begin_cell(cell);
    deposit_cell(cell, points, place * centroids_[cell], voxels);
  }
  voxels.finish();
}

void CellPoints::deposit_cell(std::size_t cell, const std::vector<Vector3d>& points, const Vector3d& centroid,
                              Voxels& voxels) const {
  const Eigen::Array3d home = voxels.steps(centroid);
  const auto at_home = [&](const Vector3d& point) { return (voxels.steps(point) == home).all(); };
  for (std::size_t t = begin_[cell]; t < begin_[cell + 1]; ++t) {
    const auto corner = [&](std::size_t c) -> const Vector3d& {
      return points[static_cast<std::size_t>(tetrahedra_[t].corners[c])];
    };
    if (at_home(corner(0)) && at_home(corner(1)) && at_home(corner(2))) {
      voxels.add(home, tetrahedra_[t].volume);
      continue;
    }
    const Vector3d a = corner(0) - centroid, b = corner(1) - centroid, c = corner(2) - centroid;
    const double volume = tetrahedra_[t].volume / static_cast<double>(parts_.size());
    for (const auto& [u, v, w] : parts_) voxels.add(voxels.steps(centroid + u * a + v * b + w * c), volume);
  }
}

}  // namespace millfoam::averaging
