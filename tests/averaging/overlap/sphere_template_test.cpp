// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/overlap/sphere_template.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "tests/averaging/test_support.hpp"

namespace millfoam::averaging {
namespace {

TEST(SphereTemplate, HoldsAsManyPointsAsIsDocumented) {
  EXPECT_EQ(SphereTemplate(6).size(), 136);
  EXPECT_EQ(SphereTemplate(12).size(), 912);
  EXPECT_EQ(SphereTemplate(24).size(), 7208);
}

TEST(SphereTemplate, CountsABlockAsIfItsPointsWereVisited) {
  const SphereTemplate points(9);
  int visited = 0;
  for (int k = 1; k < 6; ++k) {
    for (int j = 0; j < 9; ++j) {
      for (int i = 3; i < 8; ++i) visited += points.contains(i, j, k) ? 1 : 0;
    }
  }
  EXPECT_EQ(points.count({3, 8}, {0, 9}, {1, 6}), visited);
}

/// Largest error of the share of the sphere below a plane across an axis at height h, in radii: (2 + 3h -
/// h^3)/4.
double largest_share_error(const SphereTemplate& points) {
  const int n = points.points_per_diameter();
  double largest = 0;
  for (double h = -1; h <= 1; h += 1e-4) {
    int layers = 0;
    while (layers < n && points.coordinate(layers) < h) ++layers;
    const double share = static_cast<double>(points.count({0, layers}, {0, n}, {0, n})) / points.size();
    largest = std::max(largest, std::abs(share - (2 + 3 * h - h * h * h) / 4));
  }
  return largest;
}

TEST(SphereTemplate, SharesAcrossAPlaneAreWrongByTheDocumentedErrorAndNoMore) {
  EXPECT_NEAR(largest_share_error(SphereTemplate(8)), 0.093, 5e-4);
  EXPECT_NEAR(largest_share_error(SphereTemplate(12)), 0.062, 5e-4);
  EXPECT_NEAR(largest_share_error(SphereTemplate(24)), 0.031, 5e-4);
}

TEST(SphereTemplate, ASizeThatMakesNoSenseIsRefused) {
  const auto one_point = [] { SphereTemplate(1); };
  expect_named(message_of<std::invalid_argument>(one_point), {"1", "2 to 200"});
}

}  // namespace
}  // namespace millfoam::averaging
