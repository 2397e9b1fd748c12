// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/dumps/bounding_radius.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "meshing/surface/pi.hpp"

namespace millfoam::averaging {
namespace {

TEST(BoundingRadius, OfACubeIsNearlyHalfItsDiagonalAndOfABallItsRadius) {
  EXPECT_NEAR(bounding_radius({{1, 1, 1}, {1e6, 1e6}, {}}), std::sqrt(3), 1e-5);
  EXPECT_EQ(bounding_radius({{1, 1, 1}, {2, 2}, {}}), 1);
  EXPECT_NEAR(bounding_radius({{1, 1, 1}, {2 + 1e-9, 2 + 1e-9}, {}}), 1, 1e-8);
}

TEST(BoundingRadius, IsTheFarthestPointOfTheSurface) {
  for (const std::array<double, 2> n :
       {std::array{2.0, 2.0}, {3.0, 5.0}, {8.0, 2.0}, {2.0, 4.0}, {4.0, 4.0}}) {
    const Superquadric shape{{1, 1.5, 0.8}, n, {}};
    double farthest = 0;
    const auto power = [](double u, double e) { return std::copysign(std::pow(std::abs(u), e), u); };
    for (int i = 0; i <= 400; ++i) {
      for (int j = 0; j <= 400; ++j) {
        const double u = pi / 2 * i / 400, v = pi / 2 * j / 400;
        const double flat = power(std::cos(v), 2 / n[0]);
        farthest = std::max(farthest, std::hypot(std::hypot(power(std::cos(u), 2 / n[1]) * flat,
                                                            1.5 * power(std::sin(u), 2 / n[1]) * flat),
                                                 0.8 * power(std::sin(v), 2 / n[0])));
      }
    }
    // The lattice misses the farthest point by up to half a step, of second order in distance.
    EXPECT_GE(bounding_radius(shape), farthest * (1 - 1e-14));
    EXPECT_NEAR(bounding_radius(shape), farthest, 1e-4);
  }
}

}  // namespace
}  // namespace millfoam::averaging
