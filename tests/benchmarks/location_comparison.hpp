// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <chrono>
#include <string>
#include <vector>

#include "averaging/mesh/mesh_geometry.hpp"

/// Other programs' point location and averaging's, of the same points in one run. Times are best ones of
/// several.
namespace millfoam::averaging {

/// Points in the order of sampling: the template of one ball after the other, at random places in the mesh;
/// some stick out of it. Of about the size of a cell.
std::vector<Eigen::Vector3d> sampled_points(const MeshGeometry& geometry, std::size_t balls);

/// How one way to locate the points did.
struct Located {
  std::string name;
  std::vector<int> cells;  ///< [points], -1 outside
  double points_per_second = 0;
};

/// @param locate  (point, cell of the last point or -1) -> cell or -1
template <typename Locate>
Located locate_all(std::string name, const std::vector<Eigen::Vector3d>& points, int repetitions,
                   Locate&& locate) {
  Located result{std::move(name), std::vector<int>(points.size(), -1)};
  for (int i = 0; i < repetitions; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    int last = -1;
    for (std::size_t p = 0; p < points.size(); ++p) {
      const int cell = locate(points[p], last);
      result.cells[p] = cell;
      if (cell >= 0) last = cell;
    }
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begin;
    result.points_per_second =
        std::max(result.points_per_second, static_cast<double>(points.size()) / time.count());
  }
  return result;
}

/// Averaging's CellLocator on a mesh that has turned about z: each point is carried into the mesh's frame
/// first.
Located locate_in_rotated_mesh(const MeshGeometry& geometry, const std::vector<Eigen::Vector3d>& points);

/// Prints a table: rates, how many times faster `ours` is, and how many points the two place differently.
void print_comparison(const MeshGeometry& geometry, const Located& ours, const std::vector<Located>& others);

}  // namespace millfoam::averaging
