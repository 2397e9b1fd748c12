// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/overlap/sphere_triangle.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "tests/averaging/overlap/quadrature_support.hpp"
#include "tests/averaging/test_support.hpp"

namespace millfoam::averaging {
namespace {

using Eigen::Vector3d;
using Polygon = std::vector<Vector3d>;    ///< anticlockwise seen from outside its cell
using ConvexCell = std::vector<Polygon>;  ///< closed

Vector3d random_point(std::mt19937& random, double reach = 1) {
  std::uniform_real_distribution<double> place(-reach, reach);
  const double x = place(random), y = place(random), z = place(random);
  return {x, y, z};
}

ConvexCell box_cell(const Vector3d& lower, const Vector3d& upper) {
  const auto at = [&](int corner) -> Vector3d {
    return {(corner & 1 ? upper : lower).x(), (corner & 2 ? upper : lower).y(),
            (corner & 4 ? upper : lower).z()};
  };
  ConvexCell cell;
  for (const auto& f : {std::array<int, 4>{0, 4, 6, 2},
                        {1, 3, 7, 5},
                        {0, 1, 5, 4},
                        {2, 6, 7, 3},
                        {0, 2, 3, 1},
                        {4, 5, 7, 6}}) {
    cell.push_back({at(f[0]), at(f[1]), at(f[2]), at(f[3])});
  }
  return cell;
}

/// The part of a cell where normal . x <= offset.
ConvexCell cut(const ConvexCell& cell, const Vector3d& normal, double offset) {
  ConvexCell kept;
  Polygon rim;
  for (const Polygon& face : cell) {
    Polygon part;
    for (std::size_t i = 0; i < face.size(); ++i) {
      const Vector3d &from = face[i], &to = face[(i + 1) % face.size()];
      const double d_from = normal.dot(from) - offset, d_to = normal.dot(to) - offset;
      if (d_from <= 0) part.push_back(from);
      if ((d_from <= 0) == (d_to <= 0)) continue;
      // The same point for both faces of the edge, whichever way they run along it.
      const bool up = d_from < d_to;
      const Vector3d &low = up ? from : to, &high = up ? to : from;
      const double d_low = std::min(d_from, d_to), d_high = std::max(d_from, d_to);
      part.push_back(low + (high - low) * (d_low / (d_low - d_high)));
      rim.push_back(part.back());
    }
    if (part.size() > 2) kept.push_back(part);
  }
  if (rim.empty()) return kept;
  Vector3d middle = Vector3d::Zero();
  for (const Vector3d& point : rim) middle += point / static_cast<double>(rim.size());
  const Vector3d u = normal.unitOrthogonal(), v = normal.normalized().cross(u);
  const auto angle = [&](const Vector3d& p) { return std::atan2(v.dot(p - middle), u.dot(p - middle)); };
  std::sort(rim.begin(), rim.end(), [&](const auto& p, const auto& q) { return angle(p) < angle(q); });
  Polygon lid;
  for (std::size_t i = 0; i < rim.size(); i += 2) lid.push_back(rim[i]);  // each point came from two faces
  kept.push_back(lid);
  return kept;
}

double overlap(const ConvexCell& cell, const Vector3d& centre, double radius) {
  double sum = 0;
  for (const Polygon& face : cell) {
    for (std::size_t i = 2; i < face.size(); ++i) {
      sum += sphere_triangle_volume(face[0] - centre, face[i - 1] - centre, face[i] - centre, radius);
    }
  }
  return sum;
}

double volume(const ConvexCell& cell) {
  double sum = 0;
  for (const Polygon& face : cell) {
    for (std::size_t i = 2; i < face.size(); ++i) sum += face[0].dot(face[i - 1].cross(face[i])) / 6;
  }
  return sum;
}

/// A cube of edge 2 cut by random planes into convex cells.
std::vector<ConvexCell> random_cells(std::mt19937& random, int planes) {
  std::vector<ConvexCell> cells{box_cell(Vector3d(-1, -1, -1), Vector3d(1, 1, 1))};
  for (int n = 0; n < planes; ++n) {
    const Vector3d normal = random_point(random).normalized();
    const double offset = normal.dot(random_point(random, 0.7));
    std::vector<ConvexCell> parts;
    for (const ConvexCell& cell : cells) {
      for (const ConvexCell& part : {cut(cell, normal, offset), cut(cell, -normal, -offset)}) {
        if (!part.empty()) parts.push_back(part);
      }
    }
    cells = parts;
  }
  return cells;
}

/// Expects the parts of a sphere in cells to be parts, and to make up `whole` of its volume.
void expect_shared(const std::vector<ConvexCell>& cells, const Vector3d& centre, double radius,
                   double whole = 1) {
  double sum = 0;
  for (const ConvexCell& cell : cells) {
    const double part = overlap(cell, centre, radius) / sphere_volume(radius);
    EXPECT_GT(part, -1e-12) << centre.transpose() << " radius " << radius;
    EXPECT_LT(part, 1 + 1e-12);
    sum += part;
  }
  EXPECT_NEAR(sum, whole, 1e-12) << centre.transpose() << " radius " << radius;
}

struct RandomCells : ::testing::Test {
  std::mt19937 random{11};
  std::vector<std::vector<ConvexCell>> tessellations;

  RandomCells() {
    for (const int planes : {1, 3, 6, 10}) tessellations.push_back(random_cells(random, planes));
  }
};

TEST_F(RandomCells, FillTheCube) {
  for (const auto& cells : tessellations) {
    double sum = 0;
    for (const ConvexCell& cell : cells) sum += volume(cell);
    EXPECT_NEAR(sum, 8, 1e-13);
  }
}

TEST_F(RandomCells, ShareASphereOfAnySizeWithoutLoss) {
  for (const auto& cells : tessellations) {
    for (const double radius : {1e-6, 1e-3, 0.03, 0.1, 0.3}) {
      for (int n = 0; n < 10; ++n) expect_shared(cells, random_point(random, 0.7), radius);
    }
  }
}

TEST_F(RandomCells, ShareASphereOnTheirFacesEdgesAndCornersWithoutLoss) {
  for (const auto& cells : tessellations) {
    for (const ConvexCell& cell : cells) {
      for (const Polygon& face : cell) {
        const Vector3d corner = face[0], on_edge = 0.3 * face[0] + 0.7 * face[1];
        const Vector3d on_face = 0.2 * face[0] + 0.5 * face[1] + 0.3 * face[2];
        for (const Vector3d& centre : {corner, on_edge, on_face}) {
          if (centre.cwiseAbs().maxCoeff() > 0.99) continue;
          // Two cells split their common face each in its own way; its corners are rounded to 1e-16, so the
          // two are 1e-13 of the smaller radius apart.
          for (const double radius : {1e-3, 0.01}) expect_shared(cells, centre, radius);
        }
      }
    }
    if (cells.size() > 20) break;  // the finer ones add time, not cases
  }
}

TEST_F(RandomCells, ShareASphereThatTouchesAFaceWithoutLoss) {
  for (const ConvexCell& cell : tessellations[1]) {
    for (const Polygon& face : cell) {
      const Vector3d middle = (face[0] + face[1] + face[2]) / 3;
      const Vector3d inward = (face[2] - face[0]).cross(face[1] - face[0]).normalized();
      for (const double radius : {1e-6, 1e-3, 0.05}) {
        if (middle.cwiseAbs().maxCoeff() + 2 * radius < 1) {
          expect_shared(tessellations[1], middle + radius * inward, radius);
        }
      }
    }
  }
}

TEST_F(RandomCells, WithinAHugeSphereHoldTheirWholeVolumes) {
  for (const auto& cells : tessellations) {
    for (const ConvexCell& cell : cells) {
      EXPECT_NEAR(overlap(cell, random_point(random, 2), 10), volume(cell), 1e-12);
    }
  }
}

TEST_F(RandomCells, GiveTheSameSharesWhenTurned) {
  const Eigen::Quaterniond turn = Eigen::Quaterniond(0.3, -0.5, 0.7, 0.1).normalized();
  for (const ConvexCell& cell : tessellations[2]) {
    ConvexCell turned = cell;
    for (Polygon& face : turned) {
      for (Vector3d& point : face) point = turn * point;
    }
    const Vector3d centre = random_point(random);
    EXPECT_NEAR(overlap(turned, turn * centre, 0.6), overlap(cell, centre, 0.6), 1e-14);
  }
}

/// A grid of n^3 hexahedra with displaced inner corners and warped faces, which two neighbours split along
/// one diagonal or about one middle point.
class WarpedGrid {
 public:
  WarpedGrid(int n, double displacement, bool about_middle) : n_(n), about_middle_(about_middle) {
    std::mt19937 random(5);
    for (int c = 0; c < (n + 1) * (n + 1) * (n + 1); ++c) {
      const std::array<int, 3> at{c % (n + 1), c / (n + 1) % (n + 1), c / (n + 1) / (n + 1)};
      Vector3d point(at[0], at[1], at[2]);
      for (int a = 0; a < 3; ++a) {
        const double shift = random_point(random, displacement).x();
        if (at[static_cast<std::size_t>(a)] % n != 0) point[a] += shift;
      }
      points_.push_back(point);
    }
  }

  const Vector3d& point(int i, int j, int k) const {
    return points_[static_cast<std::size_t>(i + (n_ + 1) * (j + (n_ + 1) * k))];
  }

  double overlap(const std::array<int, 3>& cell, const Vector3d& centre, double radius) const {
    double sum = 0;
    for (int axis = 0; axis < 3; ++axis) {
      std::array<int, 3> upper = cell;
      ++upper[static_cast<std::size_t>(axis)];
      sum += face(axis, upper, centre, radius) - face(axis, cell, centre, radius);
    }
    return sum;
  }

 private:
  /// Of the face that is lower along the axis, its normal pointing up the axis.
  double face(int axis, const std::array<int, 3>& cell, const Vector3d& centre, double radius) const {
    const auto corner = [&](int du, int dv) {
      std::array<int, 3> at = cell;
      at[static_cast<std::size_t>((axis + 1) % 3)] += du;
      at[static_cast<std::size_t>((axis + 2) % 3)] += dv;
      return point(at[0], at[1], at[2]);
    };
    const Polygon q{corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)};
    const auto part = [&](const Vector3d& a, const Vector3d& b, const Vector3d& c) {
      return sphere_triangle_volume(a - centre, b - centre, c - centre, radius);
    };
    if (!about_middle_) return part(q[0], q[1], q[2]) + part(q[0], q[2], q[3]);
    const Vector3d middle = (q[0] + q[1] + q[2] + q[3]) / 4;
    return part(q[0], q[1], middle) + part(q[1], q[2], middle) + part(q[2], q[3], middle) +
           part(q[3], q[0], middle);
  }

  int n_;
  bool about_middle_;
  std::vector<Vector3d> points_;
};

TEST(WarpedCells, ShareSpheresUpToTenTimesTheirSizeWithoutLoss) {
  std::mt19937 random(2);
  for (const bool about_middle : {false, true}) {
    const WarpedGrid grid(12, 0.2, about_middle);
    for (const double radius : {1e-6, 0.1, 0.5, 2.0, 5.0}) {
      const Vector3d centre = Vector3d(6, 6, 6) + random_point(random, 0.9);
      const Vector3d &a = grid.point(6, 6, 6), &b = grid.point(6, 7, 6), &c = grid.point(6, 7, 7);
      const Vector3d on_edge = 0.4 * a + 0.6 * b, on_face = 0.3 * a + 0.4 * b + 0.3 * c;
      const Vector3d touching = on_face + std::min(radius, 0.5) * (b - a).cross(c - a).normalized();
      for (const Vector3d& place : {centre, a, on_edge, on_face, touching}) {
        double sum = 0;
        for (int n = 0; n < 12 * 12 * 12; ++n) {
          const double part = grid.overlap({n % 12, n / 12 % 12, n / 144}, place, radius);
          EXPECT_GT(part, -1e-12 * sphere_volume(radius));
          sum += part;
        }
        EXPECT_NEAR(sum / sphere_volume(radius), 1, 1e-12) << radius;
      }
    }
  }
}

/// The unit sphere about the origin in the part of a large cube below planes, normal . x <= offset.
double below(const std::vector<std::pair<Vector3d, double>>& planes) {
  ConvexCell cell = box_cell(Vector3d(-5, -6, -7), Vector3d(6, 7, 5));
  for (const auto& [normal, offset] : planes) cell = cut(cell, normal, offset);
  return overlap(cell, Vector3d::Zero(), 1);
}

TEST(SphereCutByPlanes, ByOneIsASegment) {
  const Vector3d normal = Vector3d(1, -2, 3).normalized();
  for (const double h : {-1.0, -0.99999, -0.7, -1e-9, 0.0, 1e-5, 0.4, 0.999, 1.0}) {
    EXPECT_NEAR(below({{normal, h}}), pi / 3 * (1 + h) * (1 + h) * (2 - h), 1e-14) << h;
  }
}

TEST(SphereCutByPlanes, ByTwoThroughTheCentreIsAWedge) {
  for (const double angle : {0.01, 0.5, pi / 2, 2.0, 3.1}) {
    const Vector3d first(0, -1, 0), second(-std::sin(angle), std::cos(angle), 0);
    EXPECT_NEAR(below({{first, 0}, {second, 0}}), 2 * angle / 3, 1e-14) << angle;
  }
}

TEST(SphereCutByPlanes, ByThreeThroughTheCentreIsAThirdOfASolidAngle) {
  EXPECT_NEAR(below({{Vector3d(1, 0, 0), 0}, {Vector3d(0, 1, 0), 0}, {Vector3d(0, 0, 1), 0}}), pi / 6, 1e-14);
  const Vector3d a(1, 0.2, -0.1), b(-0.3, 1, 0.4), c(0.1, -0.2, 1);  // edges of the corner at the centre
  const double angle =
      2 * std::atan2(a.dot(b.cross(c)), a.norm() * b.norm() * c.norm() + a.dot(b) * c.norm() +
                                            b.dot(c) * a.norm() + c.dot(a) * b.norm());
  EXPECT_NEAR(below({{b.cross(a), 0}, {c.cross(b), 0}, {a.cross(c), 0}}), angle / 3, 1e-14);
}

TEST(SphereCutByPlanes, ByTwoOrThreeOffTheCentreIsTheQuadraturesVolume) {
  for (const Vector3d& at : {Vector3d(0.3, -0.4, 2), Vector3d(-0.6, -0.5, 2), Vector3d(0.8, 0.7, 2),
                             Vector3d(0.2, 0.3, 0.1), Vector3d(-0.5, 0.3, 0.6), Vector3d(0.6, 0.6, 0.9),
                             Vector3d(-0.57, -0.57, -0.57), Vector3d(0, 0.2, -0.3)}) {
    const double exact = corner_volume_by_quadrature(at.x(), at.y(), at.z());
    EXPECT_NEAR(
        below({{Vector3d(1, 0, 0), at.x()}, {Vector3d(0, 1, 0), at.y()}, {Vector3d(0, 0, 1), at.z()}}), exact,
        1e-11)
        << at.transpose();
  }
}

TEST(SphereCutByPlanes, ByTwoObliqueOnesOffTheCentreIsTheQuadraturesVolume) {
  // Across their common edge the sphere is a stack of discs, cut by the wedge x < 0.3, x cos t + y sin t <
  // -0.1.
  for (const double t : {0.4, 1.9, 2.8}) {
    const double a = 0.3, b = -0.1, c = std::cos(t), s = std::sin(t);
    const double corner_y = (b - a * c) / s, corner = std::hypot(a, corner_y);
    const auto area = [&](double z) {
      const double r = std::sqrt(std::max(0.0, 1 - z * z)), half = std::sqrt(std::max(0.0, r * r - b * b));
      const auto height = [&](double x) {
        const double top = std::sqrt(std::max(0.0, r * r - x * x));
        return std::clamp((b - x * c) / s, -top, top) + top;
      };
      return integral(height, -r, std::clamp(a, -r, r), {b * c - s * half, b * c + s * half});
    };
    const double exact = 2 * integral(area, 0, 1,
                                      {std::sqrt(std::max(0.0, 1 - corner * corner)), std::sqrt(1 - a * a),
                                       std::sqrt(1 - b * b)});
    EXPECT_NEAR(below({{Vector3d(1, 0, 0), a}, {Vector3d(c, s, 0), b}}), exact, 1e-11) << t;
  }
}

TEST(SphereTriangle, OfATinySphereIsASegmentToTheSphersOwnScale) {
  const double radius = 1e-6;
  for (const double h : {-0.5, 0.0, 0.25}) {
    // A face of a unit cube at x = 0, which the sphere meets close to its diagonal; the cube's other faces
    // add their solid angles.
    const ConvexCell cube = box_cell(Vector3d(0, 0, 0), Vector3d(1, 1, 1));
    const Vector3d centre(h * radius, 0.5 + 0.3 * radius, 0.5);
    EXPECT_NEAR(overlap(cube, centre, radius) / std::pow(radius, 3), pi / 3 * (1 + h) * (1 + h) * (2 - h),
                1e-11);  // the centre's own place is rounded to 1e-10 radii across the cube
  }
}

TEST(SphereTriangle, IsMinusItselfWhenTurnedRoundToTheLastBit) {
  std::mt19937 random(3);
  for (int n = 0; n < 1000; ++n) {
    const Vector3d a = random_point(random), b = random_point(random), c = random_point(random);
    const double value = sphere_triangle_volume(a, b, c, 0.5);
    EXPECT_EQ(sphere_triangle_volume(a, c, b, 0.5), -value);
    EXPECT_EQ(sphere_triangle_volume(b, c, a, 0.5), value);
  }
}

TEST(SphereTriangle, IsNothingWithoutAnArea) {
  const Vector3d a(0.1, 0.2, 0.3), b(1, -2, 0.5);
  EXPECT_EQ(sphere_triangle_volume(a, a, b, 1), 0);
  EXPECT_EQ(sphere_triangle_volume(a, a, a, 1), 0);
  EXPECT_NEAR(sphere_triangle_volume(a, b, 0.25 * a + 0.75 * b, 1), 0, 1e-15);
  EXPECT_EQ(sphere_triangle_volume(Vector3d::Zero(), a, 2 * a, 1), 0);
}

TEST(SphereTriangle, SplitAlongASliverKeepsItsVolume) {
  std::mt19937 random(8);
  for (int n = 0; n < 1000; ++n) {
    const Vector3d a = random_point(random), b = random_point(random), c = random_point(random);
    const double width = std::pow(10.0, -3.0 - n % 14);
    const Vector3d inner = (a + b) / 2 + width * (c - a);
    const double parts = sphere_triangle_volume(a, b, inner, 0.5) + sphere_triangle_volume(b, c, inner, 0.5) +
                         sphere_triangle_volume(c, a, inner, 0.5);
    EXPECT_NEAR(parts, sphere_triangle_volume(a, b, c, 0.5), 1e-14) << width;
  }
}

}  // namespace
}  // namespace millfoam::averaging
