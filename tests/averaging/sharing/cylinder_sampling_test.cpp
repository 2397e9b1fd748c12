// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/sharing/cylinder_sampling.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "averaging/sharing/cylinder_exact.hpp"
#include "tests/averaging/sharing/share_helpers.hpp"

namespace millfoam::averaging {
namespace {

TEST(CylinderSampling, AgreesWithLocatingEveryPointOfTheTemplate) {
  const CylinderGrid grid({0.2, 1}, {-0.5, 0.5}, {3, 7, 5}, true);
  const SphereTemplate points(10);
  CylinderSampling sharing(grid, 10);
  for (const Particle& ball : random_balls(200, 0.9, 0.4)) {
    const std::vector<double> visited = by_visiting(grid, points, ball);
    const std::vector<double> cells = shared(sharing, ball);
    for (std::size_t v = 0; v < visited.size(); ++v) ASSERT_NEAR(cells[v], visited[v], 1e-13);
  }
}

TEST(CylinderSampling, OnTheAxisGivesEqualPartsToEqualSectors) {
  CylinderSampling sharing(CylinderGrid({0, 1}, {-1, 1}, {1, 4, 2}), 12);
  for (const double volume : shared(sharing, {1, {0, 0, 0}, {}, 0.5})) {
    EXPECT_NEAR(volume, sphere_volume(0.5) / 8, 1e-15);
  }
}

TEST(CylinderSharing, CellsHaveTheVoxelsVolume) {
  const CylinderGrid grid({0, 2}, {0, 3}, {2, 4, 1});
  const std::vector<double> exact = CylinderExact(grid).volumes(), sampled = CylinderSampling(grid).volumes();
  ASSERT_EQ(exact.size(), 8U);
  EXPECT_NEAR(exact[0], pi * 3 / 4, 1e-14);
  EXPECT_NEAR(exact[7], pi * (4 - 1) * 3 / 4, 1e-14);
  EXPECT_EQ(exact, sampled);
}

TEST(CylinderSharing, ACloneSharesAlike) {
  const CylinderGrid grid({0, 1}, {-1, 1}, {4, 4, 4});
  CylinderExact exact(grid);
  CylinderSampling sampling(grid, 7);
  const Particle ball{1, {0.1, -0.2, 0.3}, {}, 0.6};
  EXPECT_EQ(shared(*exact.clone(), ball), shared(exact, ball));
  EXPECT_EQ(shared(*sampling.clone(), ball), shared(sampling, ball));
}

TEST(CylinderSharing, SuperquadricsAddUpAndTurnWithTheGrid) {
  const CylinderGrid grid({0, 1}, {-1, 1}, {3, 4, 4});
  CylinderExact sharing(grid);
  const Superquadric shape{{0.3, 0.1, 0.2}, {4, 3}, {0.3, -0.5, 0.7, 0.1}};
  for (const Particle& ball : random_balls(50, 0.4, 0.4)) {
    const std::vector<double> cells = shared(sharing, ball, shape);
    EXPECT_NEAR(sum(cells) / superquadric_volume(shape), 1, 1e-13);
    // A quarter turn about z of ball and body moves the shares on by one sector.
    const auto& [w, x, y, z] = shape.quaternion;
    Superquadric turned = shape;
    turned.quaternion = {w - z, x - y, x + y, w + z};
    const Particle moved{2, {-ball.position[1], ball.position[0], ball.position[2]}, {}, ball.radius};
    const std::vector<double> after = shared(sharing, moved, turned);
    for (int n = 0; n < 3 * 4 * 4; ++n) {
      const int i = n % 3, j = n / 3 % 4, k = n / 12;
      EXPECT_NEAR(after[grid.offset({i, (j + 1) % 4, k})], cells[grid.offset({i, j, k})], 1e-15);
    }
  }
}

}  // namespace
}  // namespace millfoam::averaging
