// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/walls/prism.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace millfoam::averaging {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Adds the triangle of three points.
void add_triangle(const Vector3d& a, const Vector3d& b, const Vector3d& c, double level, Prism& sum) {
  const Vector3d ab = b - a, ac = c - a;
  const double area = (ab.x() * ac.y() - ab.y() * ac.x()) / 2;
  sum.area += area;
  sum.volume += area * (a.z() - level + (ab.z() + ac.z()) / 3);
}

/// phi - sin phi, of which the difference would leave few digits for a small angle.
double excess_over_sine(double angle) {
  if (std::abs(angle) > 0.3) return angle - std::sin(angle);
  const double square = angle * angle;
  double sum = 1;
  for (const double k : {156.0, 110.0, 72.0, 42.0, 20.0}) sum = 1 - square / k * sum;
  return angle * square / 6 * sum;
}

/// Adds the segment of the circle between the chord from `a` to `b` and the arc, of less than half a turn.
void add_segment(const Vector3d& a, const Vector3d& b, double level, double radius, const Vector2d& slope,
                 Prism& sum) {
  const Vector2d from = a.head<2>(), to = b.head<2>();
  const double angle = std::atan2(from.x() * to.y() - from.y() * to.x(), from.dot(to));
  const double sine = std::sin(angle / 2), cosine = std::cos(angle / 2);
  const double area = radius * radius * excess_over_sine(angle) / 2;
  // About the chord, not about the axis: of a steep plane the height at the axis may be very large.
  const double moment = 2.0 / 3 * radius * radius * radius * sine * sine * sine - radius * cosine * area;
  const Vector2d bisector = (from + to).normalized();
  sum.area += area;
  sum.volume += area * ((a.z() + b.z()) / 2 - level) + moment * slope.dot(bisector);
}

/// The part of the way from `a` to `b` that is within the radius, as shares of the way; nothing when none is.
std::optional<std::array<double, 2>> inner_part(const Vector3d& a, const Vector3d& b, double radius) {
  const Vector2d start = a.head<2>(), way = b.head<2>() - start;
  const double length2 = way.squaredNorm(), along = start.dot(way);
  const double root2 = along * along - length2 * (start.squaredNorm() - radius * radius);
  if (!(length2 > 0 && root2 > 0)) return std::nullopt;
  const double root = std::sqrt(root2);
  const double enter = std::max(0.0, (-along - root) / length2),
               leave = std::min(1.0, (-along + root) / length2);
  if (!(enter < leave)) return std::nullopt;
  return std::array<double, 2>{enter, leave};
}

}  // namespace

Prism prism_below(const ClippedPolygon& polygon, double level) {
  Prism sum;
  for (std::size_t c = 2; c < polygon.size(); ++c) {
    add_triangle(polygon[0], polygon[c - 1], polygon[c], level, sum);
  }
  return sum;
}

Prism prism_below(const ClippedPolygon& polygon, double level, double radius, const Vector2d& slope) {
  Prism sum;
  Vector3d first, last;
  bool any = false, last_leaves = false, first_enters = false;
  const auto join = [&](const Vector3d& next, bool next_enters) {
    if (last_leaves && next_enters) add_segment(last, next, level, radius, slope, sum);
    if (any) add_triangle(first, last, next, level, sum);
  };
  for (std::size_t c = 0; c < polygon.size(); ++c) {
    const Vector3d &a = polygon[c], &b = polygon[(c + 1) % polygon.size()];
    const auto part = inner_part(a, b, radius);
    if (!part) continue;
    const auto [enter, leave] = *part;
    const Vector3d from = enter > 0 ? Vector3d(a + enter * (b - a)) : a;
    const Vector3d to = leave < 1 ? Vector3d(a + leave * (b - a)) : b;
    join(from, enter > 0);
    if (!any) {
      first = from;
      first_enters = enter > 0;
      any = true;
    }
    add_triangle(first, from, to, level, sum);
    last = to;
    last_leaves = leave < 1;
  }
  if (any && last_leaves && first_enters) add_segment(last, first, level, radius, slope, sum);
  return sum;
}

}  // namespace millfoam::averaging
