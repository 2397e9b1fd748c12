// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/faces/face_geometry.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "meshing/faces/polygon_filling.hpp"

namespace millfoam::meshing {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

const Vector3d& at(const Points& points, int p) {
  return points[static_cast<std::size_t>(p)];
}

/// Calls visit(a, b) with the ends of each side.
template <typename Visit>
void for_each_side(const Points& points, const Face& face, const Visit& visit) {
  for (std::size_t i = 0; i < face.size(); ++i)
    visit(at(points, face[i]), at(points, face[(i + 1) % face.size()]));
}

double triangle_solid_angle(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const double na = a.norm(), nb = b.norm(), nc = c.norm();
  const double denominator = na * nb * nc + a.dot(b) * nc + b.dot(c) * na + c.dot(a) * nb;
  return 2 * std::atan2(a.dot(b.cross(c)), denominator);
}

/// The face's points in the plane across its area vector, anticlockwise.
std::vector<Vector2d> flattened(const Points& points, const Face& face) {
  const Vector3d normal = area_vector(points, face).normalized();
  const Vector3d u = normal.unitOrthogonal();
  const Vector3d v = normal.cross(u);
  const Vector3d origin = middle(points, face);
  std::vector<Vector2d> flat;
  for (int p : face) flat.emplace_back((at(points, p) - origin).dot(u), (at(points, p) - origin).dot(v));
  return flat;
}

double turn(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
}

bool cross(const Vector2d& a, const Vector2d& b, const Vector2d& c, const Vector2d& d) {
  return turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0;
}

/// The diagonal from point 0 or from point 1, whichever leaves the larger smallest triangle.
std::vector<std::array<int, 3>> halves(const Face& f, const std::vector<Vector2d>& flat) {
  const double first = std::min(turn(flat[0], flat[1], flat[2]), turn(flat[0], flat[2], flat[3]));
  const double second = std::min(turn(flat[1], flat[2], flat[3]), turn(flat[1], flat[3], flat[0]));
  if (first >= second) return {{f[0], f[1], f[2]}, {f[0], f[2], f[3]}};
  return {{f[1], f[2], f[3]}, {f[1], f[3], f[0]}};
}

}  // namespace

Vector3d middle(const Points& points, const Face& face) {
  Vector3d sum = Vector3d::Zero();
  for (int p : face) sum += at(points, p);
  return sum / static_cast<double>(face.size());
}

Vector3d area_vector(const Points& points, const Face& face) {
  const Vector3d origin = at(points, face.front());
  Vector3d area = Vector3d::Zero();
  for_each_side(points, face,
                [&](const Vector3d& a, const Vector3d& b) { area += (a - origin).cross(b - origin) / 2; });
  return area;
}

double pyramid_volume(const Points& points, const Face& face, const Vector3d& apex) {
  const Vector3d top = middle(points, face) - apex;
  double volume = 0;
  for_each_side(points, face, [&](const Vector3d& a, const Vector3d& b) {
    volume += (a - apex).cross(b - apex).dot(top) / 6;
  });
  return volume;
}

double solid_angle(const Points& points, const Face& face, const Vector3d& from) {
  const Vector3d top = middle(points, face) - from;
  double angle = 0;
  for_each_side(points, face, [&](const Vector3d& a, const Vector3d& b) {
    angle += triangle_solid_angle(a - from, b - from, top);
  });
  return angle;
}

bool crosses_itself(const Points& points, const Face& face) {
  if (face.size() < 4) return false;
  const std::vector<Vector2d> flat = flattened(points, face);
  const std::size_t n = flat.size();
  for (std::size_t i = 0; i + 2 < n; ++i) {
    for (std::size_t j = i + 2; j < n - (i == 0 ? 1 : 0); ++j) {
      if (cross(flat[i], flat[i + 1], flat[j], flat[(j + 1) % n])) return true;
    }
  }
  return false;
}

std::vector<std::array<int, 3>> triangles_of(const Points& points, const Face& face) {
  if (face.size() == 3) return {{face[0], face[1], face[2]}};
  const std::vector<Vector2d> flat = flattened(points, face);
  if (face.size() == 4) return halves(face, flat);
  if (crosses_itself(points, face)) return {};
  std::vector<std::array<int, 2>> sides;
  sides.reserve(face.size());
  const int n = static_cast<int>(face.size());
  for (int i = 0; i < n; ++i) sides.push_back({i, (i + 1) % n});
  std::vector<std::array<int, 3>> triangles = fill_polygon(flat, sides);
  for (auto& triangle : triangles) {
    for (int& p : triangle) p = face[static_cast<std::size_t>(p)];
  }
  return triangles;
}

}  // namespace millfoam::meshing
