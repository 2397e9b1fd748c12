// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

namespace millfoam::surface {

/// Points of which those closer than a tolerance have become one.
struct Welding {
  std::vector<Eigen::Vector3d> points;  ///< those that are kept, in their order, where they were
  std::vector<int> kept;        ///< for each point given, the index of the kept point that replaces it
  int moved = 0;                ///< points that lay elsewhere than the kept point
  double largest_distance = 0;  ///< between a point and its kept point, m
  Eigen::Vector3d farthest = Eigen::Vector3d::Zero();  ///< where that is

  /// Number of points that were joined to another.
  std::size_t joined() const { return kept.size() - points.size(); }
};

/// Each point is joined to the first kept one that is no farther than `tolerance` (m, above 0). Points must
/// be finite. Takes the time of a few look-ups in a hash table for each point.
Welding weld(const std::vector<Eigen::Vector3d>& points, double tolerance);

/// The diagonal of the points' bounding box, m; 0 for no points.
double extent(const std::vector<Eigen::Vector3d>& points);

}  // namespace millfoam::surface
