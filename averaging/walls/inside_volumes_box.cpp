// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/walls/clipped_polygon.hpp"
#include "averaging/walls/column_volumes.hpp"
#include "averaging/walls/inside_volumes.hpp"

namespace millfoam::averaging {

namespace {

using Eigen::Vector3d;

class BoxVolumes {
 public:
  explicit BoxVolumes(const BoxGrid& grid)
      : grid_(grid),
        columns_(static_cast<std::size_t>(grid.shape()[1]) * static_cast<std::size_t>(grid.shape()[2]),
                 static_cast<std::size_t>(grid.shape()[0])) {}

  void add(const ClippedPolygon& triangle) {
    const VoxelIndex& shape = grid_.shape();
    for_slabs(triangle, 2, [&](int k, const ClippedPolygon& strip) {
      if (k < 0 || k == shape[2]) return;
      for_slabs(strip, 1, [&](int j, const ClippedPolygon& patch) {
        if (j < 0 || j == shape[1]) return;
        const std::size_t column = grid_.offset({0, j, k}) / static_cast<std::size_t>(shape[0]);
        for_slabs(patch, 0, [&](int i, const ClippedPolygon& piece) { add_piece(column, i, piece); });
      });
    });
  }

  std::vector<double> volumes() const {
    const auto nx = static_cast<std::size_t>(grid_.shape()[0]);
    std::vector<double> result(grid_.size());
    for (std::size_t column = 0; column < grid_.size() / nx; ++column) {
      columns_.for_each_slab(column, grid_.spacing()[0], [&](std::size_t i, double volume) {
        result[column * nx + i] = without_round_off(volume, grid_.voxel_volume());
      });
    }
    return result;
  }

 private:
  template <typename Visit>
  void for_slabs(const ClippedPolygon& polygon, int axis, Visit&& visit) const {
    const auto a = static_cast<std::size_t>(axis);
    for_each_slab(polygon, axis, grid_.lower()[a], grid_.spacing()[a], grid_.shape()[a], visit);
  }

  void add_piece(std::size_t column, int i, const ClippedPolygon& piece) {
    if (i < 0) return;
    const double bottom = grid_.lower()[0] + i * grid_.spacing()[0];
    const Vector3d& a = piece[0];
    double area = 0, volume = 0;
    for (std::size_t c = 2; c < piece.size(); ++c) {
      const Vector3d ab = piece[c - 1] - a, ac = piece[c] - a;
      const double part = (ab.y() * ac.z() - ab.z() * ac.y()) / 2;
      area += part;
      volume += part * (a.x() - bottom + (ab.x() + ac.x()) / 3);
    }
    columns_.add(column, static_cast<std::size_t>(i), area, volume);
  }

  const BoxGrid& grid_;
  ColumnVolumes columns_;
};

}  // namespace

std::vector<double> inside_volumes(const BoxGrid& grid, const Surface& walls,
                                   const Eigen::Isometry3d& place) {
  std::vector<Vector3d> points(walls.points.size());
  std::transform(walls.points.begin(), walls.points.end(), points.begin(),
                 [&](const Vector3d& point) { return place * point; });
  BoxVolumes volumes(grid);
  for (const auto& [a, b, c] : walls.triangles) {
    volumes.add({points[static_cast<std::size_t>(a)], points[static_cast<std::size_t>(b)],
                 points[static_cast<std::size_t>(c)]});
  }
  return volumes.volumes();
}

}  // namespace millfoam::averaging
