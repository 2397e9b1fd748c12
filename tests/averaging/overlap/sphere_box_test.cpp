// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/overlap/sphere_box.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include "averaging/overlap/sphere_triangle.hpp"
#include "tests/averaging/overlap/quadrature_support.hpp"
#include "tests/averaging/test_support.hpp"

namespace millfoam::averaging {
namespace {

using Planes = std::array<std::vector<double>, 3>;

constexpr double rounding = 1e-15 * 4 * pi / 3;  ///< of the unit sphere's volume

/// The sphere in x < a, y < b, z < c.
double corner_volume(double a, double b, double c, double radius = 1) {
  return sphere_box_volume({-9, -9, -9}, {a, b, c}, radius);
}

/// By the sum over the box's twelve triangles.
double volume_by_triangles(const std::array<double, 3>& lower, const std::array<double, 3>& upper,
                           double radius) {
  const auto corner = [&](unsigned bits) -> Eigen::Vector3d {
    return {(bits & 1 ? upper : lower)[0], (bits & 2 ? upper : lower)[1], (bits & 4 ? upper : lower)[2]};
  };
  double sum = 0;
  for (const auto& f : {std::array<unsigned, 4>{0, 4, 6, 2},
                        {1, 3, 7, 5},
                        {0, 1, 5, 4},
                        {2, 6, 7, 3},
                        {0, 2, 3, 1},
                        {4, 5, 7, 6}}) {
    sum += sphere_triangle_volume(corner(f[0]), corner(f[1]), corner(f[2]), radius) +
           sphere_triangle_volume(corner(f[0]), corner(f[2]), corner(f[3]), radius);
  }
  return sum;
}

TEST(SphereBoxVolume, BelowOnePlaneIsASegment) {
  for (const double h : {-0.999, -0.3, 0.0, 1e-9, 0.5, 1.0}) {
    const double exact = pi / 3 * (1 + h) * (1 + h) * (2 - h);
    EXPECT_NEAR(corner_volume(h, 2, 2), exact, rounding) << h;
    EXPECT_NEAR(corner_volume(7, h, 2), exact, rounding) << h;
    EXPECT_NEAR(corner_volume(2, 2, h), exact, rounding) << h;
  }
}

TEST(SphereBoxVolume, BelowTwoOrThreePlanesThroughTheCentreIsAQuarterOrAnEighth) {
  EXPECT_NEAR(corner_volume(0, 0, 2), pi / 3, rounding);
  EXPECT_NEAR(corner_volume(2, 0, 0), pi / 3, rounding);
  EXPECT_NEAR(corner_volume(0, 0, 0), pi / 6, rounding);
  EXPECT_NEAR(corner_volume(0, 0, 0, 0.5), pi / 48, rounding);
}

TEST(SphereBoxVolume, BelowTwoOrThreePlanesOffTheCentreIsTheQuadraturesVolume) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> place(-1, 1);
  for (int n = 0; n < 40; ++n) {
    const double a = place(random), b = place(random), c = n % 2 ? place(random) : 2.0;
    EXPECT_NEAR(corner_volume(a, b, c), corner_volume_by_quadrature(a, b, c), 1e-11)
        << a << ' ' << b << ' ' << c;
  }
}

TEST(SphereBoxVolume, IsTheSumOverTheBoxsTriangles) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> place(-1.3, 1.3);
  for (int n = 0; n < 20000; ++n) {
    std::array<double, 3> lower{}, upper{};
    for (std::size_t a = 0; a < 3; ++a) {
      const double one = place(random), two = place(random);
      lower[a] = std::min(one, two);
      upper[a] = std::max(one, two);
    }
    ASSERT_NEAR(sphere_box_volume(lower, upper, 1), volume_by_triangles(lower, upper, 1), 5e-15);
  }
}

TEST(SphereBoxVolume, OfACellWithinTheSphereIsTheCells) {
  EXPECT_NEAR(sphere_box_volume({-0.1, 0.2, 0.3}, {0.3, 0.5, 0.4}, 1), 0.4 * 0.3 * 0.1, 1e-15);
}

TEST(SphereBoxVolume, ThroughASquareHoleIsTheClassicalOne) {
  // A hole of edge sqrt(2) r, whose edges touch the sphere: V - 4 segments beyond 1/sqrt(2).
  const double a = std::sqrt(0.5), segment = pi / 3 * (1 - a) * (1 - a) * (2 + a);
  EXPECT_NEAR(sphere_box_volume({-a, -a, -2}, {a, a, 2}, 1), 4 * pi / 3 - 4 * segment, rounding);
}

struct SphereOnAGrid : ::testing::Test {
  std::mt19937 random{9};
  SphereBoxes boxes;

  /// Planes at unit distance about a random place, or through the centre, or touching the sphere.
  Planes planes(double radius) {
    std::uniform_real_distribution<double> place(0, 1);
    std::uniform_int_distribution<int> kind(0, 3);
    Planes planes;
    for (std::vector<double>& along : planes) {
      const int which = kind(random);
      const double first = which == 0 ? 0 : which == 1 ? radius - std::ceil(radius) : place(random);
      for (double x = first - std::ceil(radius) - 1; x < radius + 1; ++x) along.push_back(x);
    }
    return planes;
  }
};

TEST_F(SphereOnAGrid, AddsUpToItsVolumeAndNoBoxIsNegative) {
  for (const double radius : {1e-6, 1e-3, 0.25, 0.5, 1.0, 2.2, 5.0, 10.0}) {
    for (int n = 0; n < 200; ++n) {
      boxes.cut(planes(radius), radius);
      const std::vector<double>& volumes = boxes.volumes();
      EXPECT_GE(*std::min_element(volumes.begin(), volumes.end()), 0);
      const double sum = std::accumulate(volumes.begin(), volumes.end(), 0.0);
      EXPECT_NEAR(sum / sphere_volume(radius), 1, 2e-15 + 4e-16 * radius * radius * radius);
    }
  }
}

TEST_F(SphereOnAGrid, GivesABoxOutOfItsReachExactlyNothing) {
  const double radius = 3.3;
  const Planes at = planes(radius);
  boxes.cut(at, radius);
  for (std::size_t k = 1; k + 1 < boxes.boxes(2); ++k) {
    for (std::size_t j = 1; j + 1 < boxes.boxes(1); ++j) {
      for (std::size_t i = 1; i + 1 < boxes.boxes(0); ++i) {
        double near2 = 0;
        for (const auto& [axis, n] : {std::pair{0U, i}, {1U, j}, {2U, k}}) {
          const double x = std::max({at[axis][n - 1], -at[axis][n], 0.0});
          near2 += x * x;
        }
        const double volume = boxes.volumes()[(k * boxes.boxes(1) + j) * boxes.boxes(0) + i];
        EXPECT_EQ(volume > 0, near2 < radius * radius) << i << ' ' << j << ' ' << k;
      }
    }
  }
}

}  // namespace
}  // namespace millfoam::averaging
