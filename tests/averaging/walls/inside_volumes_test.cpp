// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/walls/inside_volumes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "tests/averaging/walls/walls_support.hpp"

namespace millfoam::averaging {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

const Isometry3d at_rest = Isometry3d::Identity();

Isometry3d turned(double angle, const Vector3d& axis = Vector3d::UnitZ()) {
  return Isometry3d(Eigen::AngleAxisd(angle, axis.normalized()));
}

double sum(const std::vector<double>& volumes) {
  return std::accumulate(volumes.begin(), volumes.end(), 0.0);
}

/// Length that two intervals share.
double shared(double a, double b, double c, double d) {
  return std::max(0.0, std::min(b, d) - std::max(a, c));
}

TEST(InsideBox, OfABoxInABoxEachVoxelHasTheProductOfTheSharedLengths) {
  const BoxGrid grid({-1, -2, 0.5}, {3, 1, 2.5}, {7, 5, 6});
  const Vector3d lower(-0.3, -1.9, 0.7), upper(2.9, 0.4, 2.1);
  const std::vector<double> volumes = inside_volumes(grid, box_surface(lower, upper), at_rest);
  const Vector3& d = grid.spacing();
  for (int k = 0; k < 6; ++k) {
    for (int j = 0; j < 5; ++j) {
      for (int i = 0; i < 7; ++i) {
        const double x = -1 + i * d[0], y = -2 + j * d[1], z = 0.5 + k * d[2];
        const double expected = shared(x, x + d[0], lower.x(), upper.x()) *
                                shared(y, y + d[1], lower.y(), upper.y()) *
                                shared(z, z + d[2], lower.z(), upper.z());
        EXPECT_NEAR(volumes[grid.offset({i, j, k})], expected, 1e-14) << i << ' ' << j << ' ' << k;
      }
    }
  }
}

TEST(InsideBox, WallsOnTheFacesBetweenVoxelsLeaveWholeAndEmptyOnesOnly) {
  const BoxGrid grid({0, 0, 0}, {1, 1, 1}, {4, 4, 4});
  const std::vector<double> volumes =
      inside_volumes(grid, box_surface({0.25, 0.25, 0}, {0.75, 1, 1}), at_rest);
  EXPECT_EQ(std::count(volumes.begin(), volumes.end(), grid.voxel_volume()), 2 * 3 * 4);
  EXPECT_EQ(std::count(volumes.begin(), volumes.end(), 0.0), 64 - 2 * 3 * 4);
}

TEST(InsideBox, TheVoxelsOfABallHoldItsVolume) {
  const BoxGrid grid({-1.1, -1.2, -1.3}, {1.4, 1.3, 1.2}, {17, 13, 11});
  const Surface ball = ball_surface({0.1, 0.05, -0.02}, 1, 40);
  EXPECT_NEAR(sum(inside_volumes(grid, ball, at_rest)) / enclosed_volume(ball), 1, 1e-12);
}

TEST(InsideBox, ABallWithinOneVoxelFillsThatOneOnly) {
  const BoxGrid grid({0, 0, 0}, {3, 3, 3}, {3, 3, 3});
  const Surface ball = ball_surface({1.5, 1.4, 1.6}, 0.3, 12);
  const std::vector<double> volumes = inside_volumes(grid, ball, at_rest);
  for (std::size_t v = 0; v < volumes.size(); ++v) {
    EXPECT_NEAR(volumes[v], v == grid.offset({1, 1, 1}) ? enclosed_volume(ball) : 0, 1e-15) << v;
  }
}

TEST(InsideBox, WhatLiesBeyondTheGridIsLeftOut) {
  const BoxGrid grid({0, 0, 0}, {1, 1, 1}, {3, 4, 5});
  const std::vector<double> volumes = inside_volumes(grid, box_surface({0.5, -7, -7}, {9, 9, 9}), at_rest);
  EXPECT_NEAR(sum(volumes), 0.5, 1e-14);
  EXPECT_EQ(*std::max_element(volumes.begin(), volumes.end()), grid.voxel_volume());
}

TEST(InsideBox, ASquarePrismTurnedByAnEighthCutsOffTheCornersOfItsCircumscribedBox) {
  const BoxGrid grid({-1, -1, 0}, {1, 1, 1}, {2, 2, 1});
  const Surface square = box_surface({-0.5, -0.5, 0}, {0.5, 0.5, 1});
  // A quarter of the diamond |x| + |y| < 1/sqrt(2) in each voxel.
  for (const double volume : inside_volumes(grid, square, turned(pi / 4))) EXPECT_NEAR(volume, 0.25, 1e-15);
  const BoxGrid fine({-1, -1, 0}, {1, 1, 1}, {40, 40, 1});
  const std::vector<double> volumes = inside_volumes(fine, square, turned(pi / 4));
  const double tip =
      std::sqrt(0.5) - 0.7;  // what reaches into the voxel from x = 0.7: half of it above y = 0
  EXPECT_NEAR(volumes[fine.offset({34, 20, 0})], tip * tip / 2, 1e-16);
  EXPECT_NEAR(sum(volumes), 1, 1e-13);
}

TEST(InsideBox, AHalfSpaceCutsAVoxelInAPrism) {
  // x + y < 0.7 in the unit cube: a triangle of legs 0.7.
  const BoxGrid grid({0, 0, 0}, {1, 1, 1}, {1, 1, 1});
  const Surface prism_of_triangle = prism({{-5, -5}, {5.7, -5}, {-5, 5.7}}, -1, 3);
  EXPECT_NEAR(inside_volumes(grid, prism_of_triangle, at_rest)[0], 0.245, 1e-15);
}

TEST(InsideBox, ACornerCutOffByAnObliquePlaneIsATetrahedron) {
  const BoxGrid grid({0, 0, 0}, {1, 1, 1}, {1, 1, 1});
  Surface corner;
  corner.points = {{0, 0, 0}, {0.5, 0, 0}, {0, 0.25, 0}, {0, 0, 0.75}};
  corner.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  EXPECT_NEAR(inside_volumes(grid, corner, at_rest)[0], 0.5 * 0.25 * 0.75 / 6, 1e-17);
}

TEST(InsideBox, DoesNotDependOnHowTheWallsAreTurnedTogetherWithTheGrid) {
  const Surface ball = ball_surface({0.2, -0.1, 0.3}, 0.9, 24);
  const BoxGrid grid({-2, -2, -2}, {2, 2, 2}, {8, 8, 8});
  const std::vector<double> still = inside_volumes(grid, ball, at_rest);
  const std::vector<double> quarter = inside_volumes(grid, ball, turned(pi / 2));
  for (int k = 0; k < 8; ++k) {
    for (int j = 0; j < 8; ++j) {
      for (int i = 0; i < 8; ++i) {
        EXPECT_NEAR(quarter[grid.offset({7 - j, i, k})], still[grid.offset({i, j, k})], 1e-15);
      }
    }
  }
}

/// The same walls by the share of random points inside, for a mill of 12 lifters.
TEST(InsideBox, OfAMillWithLiftersEachVoxelHasTheShareOfPointsInside) {
  std::vector<Eigen::Vector2d> outline;
  for (int lifter = 0; lifter < 12; ++lifter) {
    const double angle = lifter * pi / 6;
    for (const auto& [r, turn] :
         {std::pair(0.06, -0.06), {0.052, -0.05}, {0.052, 0.05}, {0.06, 0.06}, {0.06, 0.2}}) {
      outline.emplace_back(r * std::cos(angle + turn), r * std::sin(angle + turn));
    }
  }
  const BoxGrid grid({-0.06, -0.06, 0}, {0.06, 0.06, 0.02}, {6, 6, 1});
  const double angle = 0.3;
  const std::vector<double> volumes = inside_volumes(grid, prism(outline, 0, 0.02), turned(angle));
  const auto is_inside = [&](double x, double y) {
    const Eigen::Vector2d p = Eigen::Rotation2Dd(-angle) * Eigen::Vector2d(x, y);
    bool inside = false;
    for (std::size_t a = 0; a < outline.size(); ++a) {
      const Eigen::Vector2d &u = outline[a], &v = outline[(a + 1) % outline.size()];
      if ((u.y() > p.y()) != (v.y() > p.y()) &&
          p.x() < u.x() + (v.x() - u.x()) * (p.y() - u.y()) / (v.y() - u.y())) {
        inside = !inside;
      }
    }
    return inside;
  };
  constexpr int n = 200;  // points along a voxel's edge; the outline misses up to about 4 n of n^2
  for (int j = 0; j < 6; ++j) {
    for (int i = 0; i < 6; ++i) {
      int inside = 0;
      for (int q = 0; q < n; ++q) {
        for (int p = 0; p < n; ++p) {
          inside += is_inside(-0.06 + 0.02 * (i + (p + 0.5) / n), -0.06 + 0.02 * (j + (q + 0.5) / n)) ? 1 : 0;
        }
      }
      EXPECT_NEAR(volumes[grid.offset({i, j, 0})] / grid.voxel_volume(), inside / double(n) / n, 2.0 / n);
    }
  }
}

TEST(InsideCylinder, OfABoxAboutEverythingAllVoxelsAreWhole) {
  const CylinderGrid grid({0, 1}, {0, 2}, {3, 7, 4});
  const std::vector<double> volumes = inside_volumes(grid, box_surface({-2, -2, -1}, {2, 2, 3}), at_rest);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(volumes[grid.offset({i, 3, 2})], grid.voxel_volume({i, 3, 2}));
  EXPECT_NEAR(sum(volumes), 2 * pi, 1e-13);
}

TEST(InsideCylinder, AHalfSpaceThroughTheAxisHalvesIt) {
  const CylinderGrid grid({0, 1}, {0, 2}, {3, 4, 2});
  const std::vector<double> volumes = inside_volumes(grid, box_surface({-2, 0, -1}, {2, 2, 3}), at_rest);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 4; ++j) {
      EXPECT_NEAR(volumes[grid.offset({i, j, 1})], j < 2 ? grid.voxel_volume({i, j, 1}) : 0, 1e-15);
    }
  }
}

TEST(InsideCylinder, AChordCutsOffASegmentOfTheCircle) {
  const CylinderGrid grid({0, 2}, {0, 1}, {1, 1, 1});
  const double phi = 2 * std::acos(1.2 / 2);
  const double segment = 2 * (phi - std::sin(phi));
  EXPECT_NEAR(sum(inside_volumes(grid, box_surface({1.2, -3, -1}, {3, 3, 2}), at_rest)), segment, 1e-14);
}

TEST(InsideCylinder, AnObliquePlaneLeavesHalfByItsHeightOnTheAxis) {
  // Below the plane z = 1 + 0.4 x the cylinder holds what is below its height on the axis.
  const CylinderGrid grid({0, 1}, {0, 2}, {4, 9, 5});
  Surface wedge = box_surface({-2, -2, -1}, {2, 2, 1});
  for (Vector3d& point : wedge.points) {
    if (point.z() > 0) point.z() = 1 + 0.4 * point.x();
  }
  const std::vector<double> volumes = inside_volumes(grid, wedge, turned(0.7));
  EXPECT_NEAR(sum(volumes), pi, 1e-13);
  const auto lowest = std::min_element(volumes.begin(), volumes.end());
  EXPECT_GE(*lowest, 0);
}

TEST(InsideCylinder, TheVoxelsOfAnyBallHoldItsVolumeHoweverItLies) {
  const CylinderGrid grid({0, 2}, {-2, 2}, {9, 16, 13});
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(-0.5, 0.5);
  for (int ball_number = 0; ball_number < 12; ++ball_number) {
    const Vector3d centre(2 * number(random), 2 * number(random), 2 * number(random));
    const Surface ball = ball_surface(centre, 0.55, 16);
    const Isometry3d place = turned(6 * number(random), {number(random), number(random), 0.5});
    const std::vector<double> volumes = inside_volumes(grid, ball, place);
    EXPECT_NEAR(sum(volumes) / enclosed_volume(ball), 1, 1e-12) << centre.transpose();
  }
}

TEST(InsideCylinder, ASteepWallIsNoLessExact) {
  const CylinderGrid grid({0.2, 2}, {-2, 2}, {9, 16, 13});
  for (const double tilt : {1e-3, 1e-6, 1e-9, 1e-12, 1e-15}) {
    const Surface square = box_surface({0.3, -0.6, -1}, {1.4, 0.6, 1});
    const std::vector<double> volumes = inside_volumes(grid, square, turned(tilt, {0.3, 1, 0}));
    EXPECT_NEAR(sum(volumes), enclosed_volume(square), 1e-12) << tilt;
  }
}

TEST(InsideCylinder, AgreesWithTheBoxGridWhereBothCoverTheWalls) {
  // The part of a ball at x > 0 and above z = 0.
  const Surface ball = ball_surface({0.2, 0.1, -0.1}, 0.9, 30);
  const CylinderGrid cylinder({0, 1.5}, {-1.5, 1.5}, {5, 8, 2});
  const BoxGrid box({-1.5, -1.5, -1.5}, {1.5, 1.5, 1.5}, {2, 2, 2});
  const std::vector<double> by_theta = inside_volumes(cylinder, ball, at_rest);
  const std::vector<double> by_x = inside_volumes(box, ball, at_rest);
  double first_octant = 0;
  for (int i = 0; i < 5; ++i) {
    for (int j = 0; j < 2; ++j) first_octant += by_theta[cylinder.offset({i, j, 1})];
  }
  EXPECT_NEAR(first_octant, by_x[box.offset({1, 1, 1})], 1e-14);
}

TEST(InsideCylinder, ACoaxialConeFollowsItsRadius) {
  // A cone of many sides, z from 0 to 1, radius 1 - z: the ring from r1 to r2 holds 2 pi Int r (1 - r) dr.
  const int n = 2000;
  Surface cone;
  for (const Eigen::Vector2d& p : regular_polygon(n, 1)) cone.points.emplace_back(p.x(), p.y(), 0);
  cone.points.emplace_back(0, 0, 0);
  cone.points.emplace_back(0, 0, 1);
  for (int a = 0; a < n; ++a) {
    cone.triangles.push_back({(a + 1) % n, a, n});
    cone.triangles.push_back({a, (a + 1) % n, n + 1});
  }
  const CylinderGrid grid({0, 1}, {0, 1}, {4, 5, 1});
  const std::vector<double> volumes = inside_volumes(grid, cone, at_rest);
  const auto below_r = [](double r) { return 2 * pi * (r * r / 2 - r * r * r / 3) / 5; };
  for (int i = 0; i < 4; ++i) {
    // The sides lie within the cone by up to 1 - cos(pi/n) = 1.2e-6.
    EXPECT_NEAR(volumes[grid.offset({i, 2, 0})], below_r((i + 1) / 4.0) - below_r(i / 4.0), 1e-6);
  }
}

}  // namespace
}  // namespace millfoam::averaging
