// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/overlap/gauss_legendre.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "meshing/surface/pi.hpp"

namespace millfoam::averaging {
namespace {

TEST(GaussLegendre, IsExactForPolynomialsUpToItsDegree) {
  for (const int n : {1, 2, 5, 20, 64})
    for (int power = 0; power < 2 * n; ++power) {
      double sum = 0;
      for (const auto& [x, weight] : gauss_legendre(n)) sum += weight * std::pow(x, power);
      EXPECT_NEAR(sum, power % 2 == 0 ? 2.0 / (power + 1) : 0, 1e-14) << n << " points, power " << power;
    }
}

TEST(GaussLegendre, WithRootsIntegratesThem) {
  double sum = 0, circle = 0;
  for (const auto& [x, weight] : gauss_legendre_with_roots(20)) {
    sum += weight * std::pow(1 - x, 1.5);
    circle += weight * std::sqrt(1 - x * x);
  }
  EXPECT_NEAR(sum, std::pow(2, 2.5) / 2.5, 1e-14);
  EXPECT_NEAR(circle, pi / 2, 1e-14);
}

}  // namespace
}  // namespace millfoam::averaging
