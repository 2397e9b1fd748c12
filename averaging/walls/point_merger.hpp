// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace millfoam::averaging {

/// Numbers points such that those within a tolerance of an earlier one share its number.
class PointMerger {
 public:
  /// @param points     gets the points that differ; must outlive this object
  /// @param tolerance  m, positive
  PointMerger(std::vector<Eigen::Vector3d>& points, double tolerance)
      : points_(points), tolerance_(tolerance) {}

  /// The place, in the points that differ, of a point, m; a new one is put at the end.
  int number_of(const Eigen::Vector3d& point) {
    std::array<std::int64_t, 3> box{};
    for (int axis = 0; axis < 3; ++axis) {
      box[static_cast<std::size_t>(axis)] = std::llround(point[axis] / (4 * tolerance_));
    }
    for (std::int64_t i = -1; i <= 1; ++i) {
      for (std::int64_t j = -1; j <= 1; ++j) {
        for (std::int64_t k = -1; k <= 1; ++k) {
          const auto found = boxes_.find({box[0] + i, box[1] + j, box[2] + k});
          if (found == boxes_.end()) continue;
          for (const int number : found->second) {
            if ((points_[static_cast<std::size_t>(number)] - point).norm() <= tolerance_) return number;
          }
        }
      }
    }
    const auto number = static_cast<int>(points_.size());
    points_.push_back(point);
    boxes_[box].push_back(number);
    return number;
  }

 private:
  struct Hash {
    std::size_t operator()(const std::array<std::int64_t, 3>& box) const {
      std::uint64_t hash = 0;
      for (const std::int64_t i : box) hash = (hash ^ static_cast<std::uint64_t>(i)) * 0x9E3779B97F4A7C15U;
      return static_cast<std::size_t>(hash ^ (hash >> 32U));
    }
  };

  std::vector<Eigen::Vector3d>& points_;
  double tolerance_;
  std::unordered_map<std::array<std::int64_t, 3>, std::vector<int>, Hash> boxes_;
};

}  // namespace millfoam::averaging
