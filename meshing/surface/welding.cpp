// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/surface/welding.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace millfoam::surface {
namespace {

using Eigen::Vector3d;
using Place = std::array<std::int64_t, 3>;

struct HashPlace {
  std::size_t operator()(const Place& place) const {
    std::uint64_t code = 0;
    for (std::int64_t i : place) code = (code ^ static_cast<std::uint64_t>(i)) * 0x9E3779B97F4A7C15U;
    return code ^ (code >> 29U);
  }
};

/// Kept points in the boxes of a grid twice the tolerance wide: a point's neighbours within the tolerance lie
/// in its own box and in those that the tolerance reaches into.
class Boxes {
 public:
  Boxes(const Vector3d& origin, double tolerance) : origin_(origin), tolerance_(tolerance) {}

  template <typename Visit>
  void for_each_near(const Vector3d& point, const Visit& visit) const {
    const Place low = place(point - Vector3d::Constant(tolerance_));
    const Place high = place(point + Vector3d::Constant(tolerance_));
    for (std::int64_t i = low[0]; i <= high[0]; ++i) {
      for (std::int64_t j = low[1]; j <= high[1]; ++j) {
        for (std::int64_t k = low[2]; k <= high[2]; ++k) {
          const auto [first, last] = boxes_.equal_range({i, j, k});
          for (auto entry = first; entry != last; ++entry) visit(entry->second);
        }
      }
    }
  }

  void insert(const Vector3d& point, int index) { boxes_.emplace(place(point), index); }

 private:
  Place place(const Vector3d& point) const {
    Place place;
    for (int i = 0; i < 3; ++i) {
      place[static_cast<std::size_t>(i)] =
          static_cast<std::int64_t>(std::floor((point[i] - origin_[i]) / (2 * tolerance_)));
    }
    return place;
  }

  Vector3d origin_;
  double tolerance_;
  std::unordered_multimap<Place, int, HashPlace> boxes_;
};

}  // namespace

double extent(const std::vector<Vector3d>& points) {
  Eigen::AlignedBox3d box;
  for (const Vector3d& point : points) box.extend(point);
  return box.isEmpty() ? 0 : box.diagonal().norm();
}

Welding weld(const std::vector<Vector3d>& points, double tolerance) {
  Welding welding;
  if (points.empty()) return welding;
  // Boxes far smaller than the last bit of the coordinates would have numbers beyond an integer's.
  Boxes boxes(points.front(), std::max(tolerance, 1e-16 * extent(points) + 1e-300));
  for (const Vector3d& point : points) {
    int nearest = -1;
    boxes.for_each_near(point, [&](int candidate) {
      const double distance = (welding.points[static_cast<std::size_t>(candidate)] - point).norm();
      if (distance <= tolerance && (nearest < 0 || candidate < nearest)) nearest = candidate;
    });
    if (nearest < 0) {
      nearest = static_cast<int>(welding.points.size());
      welding.points.push_back(point);
      boxes.insert(point, nearest);
    }
    welding.kept.push_back(nearest);
    const double distance = (welding.points[static_cast<std::size_t>(nearest)] - point).norm();
    if (distance > 0) ++welding.moved;
    if (distance > welding.largest_distance) {
      welding.largest_distance = distance;
      welding.farthest = point;
    }
  }
  return welding;
}

}  // namespace millfoam::surface
