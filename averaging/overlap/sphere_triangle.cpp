// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/overlap/sphere_triangle.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

namespace millfoam::averaging {

namespace {

constexpr long double long_pi = 3.14159265358979323846L;

template <typename Real>
using Point = Eigen::Matrix<Real, 3, 1>;

/// Sum of angles, each of (-pi, pi) and given by a point of the plane in its direction, with one arc tangent
/// for all of them.
template <typename Real>
class AngleSum {
 public:
  void add(Real cosine, Real sine) {
    const Real x = x_ * cosine - y_ * sine, y = x_ * sine + y_ * cosine;
    // Whether the turn led over the negative x axis. Two points with x > 0 have a turn of less than pi/2
    // between them, or rounding, and not that axis.
    if (x_ < 0 || x < 0) {
      if (sine >= 0 && y_ >= 0 && y < 0) ++turns_;
      if (sine < 0 && y_ < 0 && y >= 0) --turns_;
    }
    x_ = x;
    y_ = y;
  }
  Real sum() const { return std::atan2(y_, x_) + turns_ * Real(2 * long_pi); }

 private:
  Real x_ = 1;
  Real y_ = 0;
  int turns_ = 0;
};

/// An edge as seen from the foot of the perpendicular from the sphere's centre on the triangle's plane.
template <typename Real>
struct Edge {
  Real distance;  ///< of its line, positive when the foot lies on the triangle's side
  Real begin;     ///< coordinate along the line, 0 being nearest to the foot
  Real end;
  Real half_chord;  ///< the line is in the sphere for coordinates below it in size; 0 when it misses

  bool meets_sphere() const { return half_chord > 0 && begin < half_chord && end > -half_chord; }
};

/// The triangle's plane, lengths in radii of the sphere.
template <typename Real>
struct Plane {
  Point<Real> normal;
  Real height;       ///< over the sphere's centre along the normal
  Real double_area;  ///< of the triangle; 0 when it has none, and then nothing else holds
};

template <typename Real>
Edge<Real> edge_seen(const Plane<Real>& plane, const Point<Real>& from, const Point<Real>& to) {
  const Point<Real> along = to - from;
  const Point<Real> direction = along * (1 / along.norm());
  const Real begin = direction.dot(from), end = direction.dot(to);
  const Real distance = plane.normal.dot((std::abs(begin) < std::abs(end) ? from : to).cross(direction));
  const Real squared = (1 - plane.height) * (1 + plane.height) - distance * distance;
  return {distance, begin, end, squared > 0 ? std::sqrt(squared) : Real(0)};
}

template <typename Real>
Plane<Real> plane_of(const std::array<Point<Real>, 3>& corners) {
  const std::array<Real, 3> length2{(corners[1] - corners[0]).squaredNorm(),
                                    (corners[2] - corners[1]).squaredNorm(),
                                    (corners[0] - corners[2]).squaredNorm()};
  const std::size_t longest =
      length2[0] > length2[1] ? (length2[0] > length2[2] ? 0 : 2) : (length2[1] > length2[2] ? 1 : 2);
  const Point<Real>& from = corners[longest];
  const Point<Real>& to = corners[(longest + 1) % 3];
  const Point<Real> along = to - from;
  const Point<Real> across = along.cross(corners[(longest + 2) % 3] - from);
  Plane<Real> plane{across, 0, across.norm()};
  if (!(plane.double_area > 0)) return plane;
  plane.normal *= 1 / plane.double_area;
  if (plane.double_area < Real(0.01) * length2[longest]) {
    // A sliver's normal is made right across its longest edge, or the ends would leave the plane.
    plane.normal -= along * (plane.normal.dot(along) / length2[longest]);
    plane.normal.normalize();
  }
  plane.height = plane.normal.dot(from.squaredNorm() < to.squaredNorm() ? from : to);
  return plane;
}

/// Signed solid angle of the triangle (Van Oosterom & Strackee 1983, IEEE Trans Biomed Eng 30:125).
template <typename Real>
Real solid_angle(const std::array<Point<Real>, 3>& corners, const Plane<Real>& plane) {
  const auto& [a, b, c] = corners;
  const Real length_a = a.norm(), length_b = b.norm(), length_c = c.norm();
  const Real denominator =
      length_a * length_b * length_c + a.dot(b) * length_c + b.dot(c) * length_a + c.dot(a) * length_b;
  return 2 * std::atan2(plane.height * plane.double_area, denominator);
}

/// Of the plane's points nearer to the foot than the triangle's edges: what lies in the sphere as an area,
/// what lies beyond as angles about the foot and solid angles.
template <typename Real>
class Pieces {
 public:
  explicit Pieces(Real height) : height_(height), size_(std::abs(height)) {}

  void add(const Edge<Real>& edge) {
    const Real q = edge.half_chord;
    if (edge.meets_sphere()) {
      area_ += edge.distance * (std::min(edge.end, q) - std::max(edge.begin, -q)) / 2;
      if (edge.begin < -q) add_beyond(edge, edge.begin, -q);
      if (edge.end > q) add_beyond(edge, q, edge.end);
    } else {
      add_beyond(edge, edge.begin, edge.end);
    }
  }

  /// h/3 area + h r^2/6 angle + (h angle - sgn(h) bent)/3 with r^2 = 1 - h^2.
  Real volume() const {
    return height_ * (area_ / 3 + (3 - height_ * height_) / 6 * angle_.sum()) -
           std::copysign(Real(1), height_) * bent_.sum() / 3;
  }

 private:
  /// A piece of an edge outside the sphere. With p its line's distance, s the coordinate of an end and h the
  /// height, an end is seen from the foot at the angle atan(s/p); the cone over what lies nearer than the
  /// edge has the solid angle of its turn less that of atan(h s/(p L)), L the end's distance from the centre.
  void add_beyond(const Edge<Real>& edge, Real from, Real to) {
    const Real p = edge.distance, d2 = p * p + height_ * height_;
    const Real far_from = std::sqrt(d2 + from * from), far_to = std::sqrt(d2 + to * to);
    angle_.add(p * p + from * to, p * (to - from));
    bent_.add(p * p * far_from * far_to + height_ * height_ * from * to,
              p * size_ * (to * far_from - from * far_to));
  }

  Real height_;
  Real size_;
  Real area_ = 0;
  AngleSum<Real> angle_;
  AngleSum<Real> bent_;
};

/// As `sphere_triangle_volume`, for the unit sphere and corners in any order that does not change.
template <typename Real>
Real unit_sphere_volume(const std::array<Point<Real>, 3>& corners) {
  const Plane<Real> plane = plane_of(corners);
  const Real h = plane.height;
  if (!(plane.double_area > 0) || h == 0) return 0;
  if (std::abs(h) >= 1) return solid_angle(corners, plane) / 3;
  if (std::all_of(corners.begin(), corners.end(), [](const auto& c) { return c.squaredNorm() <= 1; })) {
    return h * plane.double_area / 6;
  }
  const std::array<Edge<Real>, 3> edges{edge_seen(plane, corners[0], corners[1]),
                                        edge_seen(plane, corners[1], corners[2]),
                                        edge_seen(plane, corners[2], corners[0])};
  if (std::any_of(edges.begin(), edges.end(), [](const auto& edge) { return edge.meets_sphere(); })) {
    Pieces<Real> pieces(h);
    for (const Edge<Real>& edge : edges) pieces.add(edge);
    return pieces.volume();
  }
  // Either the whole disc lies in the triangle, or nothing of it.
  const Real beyond = 1 - std::abs(h);
  const bool disc =
      std::all_of(edges.begin(), edges.end(), [](const auto& edge) { return edge.distance > 0; });
  const Real cap = disc ? Real(long_pi) * beyond * beyond * (3 - beyond) / 3 : Real(0);
  return solid_angle(corners, plane) / 3 - std::copysign(cap, h);
}

bool comes_before(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::tie(a.x(), a.y(), a.z()) < std::tie(b.x(), b.y(), b.z());
}

}  // namespace

double sphere_triangle_volume(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                              double radius) {
  const double scale = 1 / radius;
  std::array<Point<double>, 3> corners{a * scale, b * scale, c * scale};
  double sign = radius * radius * radius;
  const auto order = [&](std::size_t i, std::size_t j) {
    if (!comes_before(corners[j], corners[i])) return;
    corners[i].swap(corners[j]);
    sign = -sign;
  };
  order(0, 1);
  order(1, 2);
  order(0, 1);
  // Rounding moves a plane by the rounding of its corners. Where that is much for the sphere, the planes
  // about an edge would no longer meet in it.
  constexpr double far = 256;
  const auto near = [](const auto& corner) { return corner.squaredNorm() < far * far; };
  if (std::all_of(corners.begin(), corners.end(), near)) return sign * unit_sphere_volume(corners);
  std::array<Point<long double>, 3> precise;
  for (std::size_t i = 0; i < 3; ++i) precise[i] = corners[i].cast<long double>();
  return sign * static_cast<double>(unit_sphere_volume(precise));
}

}  // namespace millfoam::averaging
