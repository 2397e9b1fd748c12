// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "averaging/walls/clipped_polygon.hpp"
#include "averaging/walls/column_volumes.hpp"
#include "averaging/walls/inside_volumes.hpp"
#include "averaging/walls/prism.hpp"
#include "meshing/surface/pi.hpp"

namespace millfoam::averaging {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Cuts polygons into wedges about the z axis: the steps of theta, or equal parts of them so that none is
/// wider than a quarter of a turn.
class Wedges {
 public:
  explicit Wedges(int steps)
      : parts_((4 + steps - 1) / steps), count_(steps * parts_), width_(2 * pi / count_) {
    for (int w = 0; w <= count_; ++w) planes_.emplace_back(-std::sin(w * width_), std::cos(w * width_));
  }

  /// Calls `visit` with the step of theta and the part of the polygon in it.
  template <typename Visit>
  void for_each(const ClippedPolygon& polygon, Visit&& visit) const {
    const double start = std::atan2(polygon[0].y(), polygon[0].x());
    double least = 0, most = 0;
    bool about_the_axis = false;
    for (const Vector3d& corner : polygon) {
      const double turn = std::remainder(std::atan2(corner.y(), corner.x()) - start, 2 * pi);
      least = std::min(least, turn);
      most = std::max(most, turn);
      about_the_axis = about_the_axis || (corner.x() == 0 && corner.y() == 0);
    }
    // A convex polygon that reaches halfway around the axis contains it, or nearly.
    constexpr double half_way = pi - 1e-6;
    if (about_the_axis || most - least > half_way) return cut_by_all(polygon, visit);
    cut_by_some(polygon, static_cast<int>(std::floor((start + least) / width_)),
                static_cast<int>(std::floor((start + most) / width_)), visit);
  }

 private:
  /// Height above the plane through the axis at the beginning of a wedge: positive in the half turn after it.
  double height(int wedge, const Vector3d& point) const {
    const int w = ((wedge % count_) + count_) % count_;
    return planes_[static_cast<std::size_t>(w)].dot(point.head<2>());
  }
  int step(int wedge) const { return (((wedge % count_) + count_) % count_) / parts_; }

  template <typename Visit>
  void cut_by_all(const ClippedPolygon& polygon, Visit&& visit) const {
    ClippedPolygon before, behind, inside, beyond;
    for (int w = 0; w < count_; ++w) {
      divide(
          polygon, [&](const Vector3d& p) { return height(w, p); }, before, behind);
      divide(
          behind, [&](const Vector3d& p) { return height(w + 1, p); }, inside, beyond);
      if (inside.size() > 2) visit(step(w), inside);
    }
  }

  template <typename Visit>
  void cut_by_some(const ClippedPolygon& polygon, int first, int last, Visit&& visit) const {
    if (first == last) return visit(step(first), polygon);
    ClippedPolygon rest = polygon, inside, beyond;
    for (int w = first; w < last; ++w) {
      divide(
          rest, [&](const Vector3d& p) { return height(w + 1, p); }, inside, beyond);
      if (inside.size() > 2) visit(step(w), inside);
      if (beyond.size() < 3) return;
      rest = beyond;
    }
    visit(step(last), rest);
  }

  int parts_;
  int count_;
  double width_;
  std::vector<Vector2d> planes_;
};

class CylinderVolumes {
 public:
  explicit CylinderVolumes(const CylinderGrid& grid)
      : grid_(grid),
        wedges_(grid.shape()[1]),
        columns_(static_cast<std::size_t>(grid.shape()[0]) * static_cast<std::size_t>(grid.shape()[1]),
                 static_cast<std::size_t>(grid.shape()[2])) {}

  void add(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    const Vector3d normal = (b - a).cross(c - a);
    // A triangle along the axis takes no part, and one that is so but for round-off has no slope.
    if (std::abs(normal.z()) <= 1e-15 * normal.norm()) return;
    const Vector2d slope = -normal.head<2>() / normal.z();
    for_each_slab({a, b, c}, 2, grid_.ends()[0], grid_.spacing()[2], grid_.shape()[2],
                  [&](int k, const ClippedPolygon& strip) {
                    if (k < 0) return;
                    wedges_.for_each(strip,
                                     [&](int j, const ClippedPolygon& piece) { add(j, k, piece, slope); });
                  });
  }

  std::vector<double> volumes() const {
    const auto [nr, ntheta, nz] = grid_.shape();
    std::vector<double> result(grid_.size());
    for (int j = 0; j < ntheta; ++j) {
      for (int i = 0; i < nr; ++i) {
        const double whole = grid_.voxel_volume({i, j, 0});
        columns_.for_each_slab(column(i, j), grid_.spacing()[2], [&](std::size_t k, double volume) {
          result[grid_.offset({i, j, static_cast<int>(k)})] = without_round_off(volume, whole);
        });
      }
    }
    return result;
  }

 private:
  std::size_t column(int i, int j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(grid_.shape()[0]) +
           static_cast<std::size_t>(i);
  }
  double radius(int i) const { return grid_.radii()[0] + i * grid_.spacing()[0]; }

  /// Adds a piece within one step of theta and z to the steps of r.
  void add(int j, int k, const ClippedPolygon& piece, const Vector2d& slope) {
    const double level = grid_.ends()[0] + k * grid_.spacing()[2];
    double farthest = 0;
    for (const Vector3d& corner : piece) farthest = std::max(farthest, corner.head<2>().norm());
    const int nr = grid_.shape()[0];
    const auto within = [&](int i) {
      return farthest <= radius(i) ? prism_below(piece, level) : prism_below(piece, level, radius(i), slope);
    };
    int i = static_cast<int>(
        std::clamp(std::ceil((farthest - radius(0)) / grid_.spacing()[0]), 0.0, static_cast<double>(nr)));
    for (Prism outer = within(i); i-- > 0;) {
      const Prism inner = within(i);
      columns_.add(column(i, j), static_cast<std::size_t>(k), outer.area - inner.area,
                   outer.volume - inner.volume);
      if (inner.area == 0 && inner.volume == 0) return;
      outer = inner;
    }
  }

  const CylinderGrid& grid_;
  Wedges wedges_;
  ColumnVolumes columns_;
};

}  // namespace

std::vector<double> inside_volumes(const CylinderGrid& grid, const Surface& walls,
                                   const Eigen::Isometry3d& place) {
  std::vector<Vector3d> points(walls.points.size());
  std::transform(walls.points.begin(), walls.points.end(), points.begin(),
                 [&](const Vector3d& point) { return place * point; });
  CylinderVolumes volumes(grid);
  for (const auto& [a, b, c] : walls.triangles) {
    volumes.add(points[static_cast<std::size_t>(a)], points[static_cast<std::size_t>(b)],
                points[static_cast<std::size_t>(c)]);
  }
  return volumes.volumes();
}

}  // namespace millfoam::averaging
