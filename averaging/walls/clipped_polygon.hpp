// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>

namespace millfoam::averaging {

/// A flat convex polygon: a triangle, or what planes leave of one.
class ClippedPolygon {
 public:
  ClippedPolygon() = default;
  /// A triangle, corners in m.
  ClippedPolygon(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) : size_(3) {
    corners_[0] = a;
    corners_[1] = b;
    corners_[2] = c;
  }
  /// Copies only the corners that there are.
  ClippedPolygon(const ClippedPolygon& other) { *this = other; }
  ClippedPolygon& operator=(const ClippedPolygon& other) {
    size_ = other.size_;
    std::copy(other.begin(), other.end(), corners_.begin());
    return *this;
  }

  std::size_t size() const { return size_; }  ///< number of corners
  const Eigen::Vector3d& operator[](std::size_t corner) const { return corners_[corner]; }  ///< m
  const Eigen::Vector3d* begin() const { return corners_.data(); }        ///< first corner, m
  const Eigen::Vector3d* end() const { return corners_.data() + size_; }  ///< behind the last

  void clear() { size_ = 0; }  ///< leaves no corner
  /// Adds a corner, m; at most 12.
  void push_back(const Eigen::Vector3d& corner) {
    assert(size_ < corners_.size());
    corners_[size_++] = corner;
  }

 private:
  std::array<Eigen::Vector3d, 12> corners_;  // a plane adds one at most; there are six, or eight with wedges
  std::size_t size_ = 0;
};

/// Divides a polygon by a plane (I. E. Sutherland & G. W. Hodgman 1974, Comm ACM 17:32). A part may be empty.
/// @param polygon  must be another object than the two parts
/// @param height  double(const Eigen::Vector3d&): of a point above the plane, in any unit
/// @param below  overwritten by the part with heights of 0 or less
/// @param above  overwritten by the part with heights of 0 or more
template <typename Height>
void divide(const ClippedPolygon& polygon, Height&& height, ClippedPolygon& below, ClippedPolygon& above) {
  below.clear();
  above.clear();
  if (polygon.size() == 0) return;
  const Eigen::Vector3d* last = polygon.end() - 1;
  double last_height = height(*last);
  for (const Eigen::Vector3d& corner : polygon) {
    const double corner_height = height(corner);
    if ((last_height < 0 && corner_height > 0) || (last_height > 0 && corner_height < 0)) {
      const double part = last_height / (last_height - corner_height);
      const Eigen::Vector3d crossing = *last + part * (corner - *last);
      below.push_back(crossing);
      above.push_back(crossing);
    }
    if (corner_height <= 0) below.push_back(corner);
    if (corner_height >= 0) above.push_back(corner);
    last = &corner;
    last_height = corner_height;
  }
}

/// Cuts a polygon into the equal slabs between lower + i spacing and lower + (i+1) spacing of an axis and
/// calls `visit` with the slab i, from 0 to count - 1, and the part in it; what lies below has i = -1 and
/// what lies above has i = count.
template <typename Visit>
void for_each_slab(const ClippedPolygon& polygon, int axis, double lower, double spacing, int count,
                   Visit&& visit) {
  double least = polygon[0][axis], most = least;
  for (const Eigen::Vector3d& corner : polygon) {
    least = std::min(least, corner[axis]);
    most = std::max(most, corner[axis]);
  }
  const auto slab_of = [&](double x) {
    return static_cast<int>(std::clamp(std::floor((x - lower) / spacing), -1.0, static_cast<double>(count)));
  };
  const int first = slab_of(least), last = slab_of(most);
  if (first == last) {
    visit(first, polygon);
    return;
  }
  ClippedPolygon rest = polygon, below, above;
  for (int slab = first; slab < last; ++slab) {
    const double plane = lower + (slab + 1) * spacing;
    divide(
        rest, [&](const Eigen::Vector3d& p) { return p[axis] - plane; }, below, above);
    if (below.size() > 2) visit(slab, below);
    if (above.size() < 3) return;
    rest = above;
  }
  visit(last, rest);
}

}  // namespace millfoam::averaging
