// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/benchmarks/location_comparison.hpp"

#include <cmath>
#include <cstdio>
#include <memory>
#include <random>

#include "averaging/mesh/cell_locator.hpp"
#include "averaging/overlap/sphere_template.hpp"

namespace millfoam::averaging {

namespace {

using Eigen::Vector3d;

void print_row(const Located& located, const Located& ours) {
  std::size_t different = 0;
  for (std::size_t p = 0; p < ours.cells.size(); ++p) different += located.cells[p] != ours.cells[p];
  std::printf("%-44s %12.3f %12.1f %12zu\n", located.name.c_str(), located.points_per_second / 1e6,
              ours.points_per_second / located.points_per_second, different);
}

}  // namespace

std::vector<Vector3d> sampled_points(const MeshGeometry& geometry, std::size_t balls) {
  const SphereTemplate shape(8);
  std::vector<Vector3d> offsets;
  for (int k = 0; k < 8; ++k) {
    for (int j = 0; j < 8; ++j) {
      for (int i = 0; i < 8; ++i) {
        if (!shape.contains(i, j, k)) continue;
        offsets.emplace_back(shape.coordinate(i), shape.coordinate(j), shape.coordinate(k));
      }
    }
  }
  std::mt19937 random(1);
  std::uniform_int_distribution<std::size_t> any_cell(0, geometry.cells() - 1);
  std::vector<Vector3d> points;
  for (std::size_t ball = 0; ball < balls; ++ball) {
    const std::size_t cell = any_cell(random);
    const double radius = std::cbrt(geometry.volumes()[cell]) / 2;
    for (const Vector3d& offset : offsets) points.emplace_back(geometry.centres()[cell] + radius * offset);
  }
  return points;
}

Located locate_in_rotated_mesh(const MeshGeometry& geometry, const std::vector<Vector3d>& points) {
  const auto begin = std::chrono::steady_clock::now();
  const CellLocator locator(std::make_shared<const MeshGeometry>(geometry));
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begin;
  std::printf("CellLocator: built in %.2f s\n", time.count());

  const Eigen::Isometry3d place(Eigen::AngleAxisd(0.7, Vector3d::UnitZ()));
  const Eigen::Isometry3d into_mesh = place.inverse();
  std::vector<Vector3d> turned;
  for (const Vector3d& point : points) turned.emplace_back(place * point);
  return locate_all("averaging's CellLocator, turned mesh", turned, 20,
                    [&](const Vector3d& point, int hint) { return locator.locate(into_mesh * point, hint); });
}

void print_comparison(const MeshGeometry& geometry, const Located& ours, const std::vector<Located>& others) {
  std::printf("%zu points in a mesh of %zu cells, one core\n\n", ours.cells.size(), geometry.cells());
  std::printf("%-44s %12s %12s %12s\n", "", "10^6 pts/s", "ours/this", "other cell");
  print_row(ours, ours);
  for (const Located& other : others) print_row(other, ours);
}

}  // namespace millfoam::averaging
