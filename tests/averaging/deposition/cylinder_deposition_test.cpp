// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/deposition/cylinder_deposition.hpp"

#include <gtest/gtest.h>

#include "averaging/deposition/exact_cylinder_deposition.hpp"
#include "averaging/deposition/sampled_cylinder_deposition.hpp"
#include "tests/averaging/deposition/deposition_support.hpp"

namespace millfoam::averaging {
namespace {

TEST(CylinderDeposition, CellsHaveTheVoxelsVolume) {
  const CylinderGrid grid({0, 2}, {0, 3}, {2, 4, 1});
  const std::vector<double> exact = ExactCylinderDeposition(grid).volumes(),
                            sampled = SampledCylinderDeposition(grid).volumes();
  ASSERT_EQ(exact.size(), 8U);
  EXPECT_NEAR(exact[0], pi * 3 / 4, 1e-14);
  EXPECT_NEAR(exact[7], pi * (4 - 1) * 3 / 4, 1e-14);
  EXPECT_EQ(exact, sampled);
}

TEST(CylinderDeposition, ACloneDepositsAlike) {
  const CylinderGrid grid({0, 1}, {-1, 1}, {4, 4, 4});
  ExactCylinderDeposition exact(grid);
  SampledCylinderDeposition sampling(grid, 7);
  const Particle ball{1, {0.1, -0.2, 0.3}, {}, 0.6};
  EXPECT_EQ(deposited(*exact.clone(), ball), deposited(exact, ball));
  EXPECT_EQ(deposited(*sampling.clone(), ball), deposited(sampling, ball));
}

TEST(CylinderDeposition, SuperquadricsAddUpAndTurnWithTheGrid) {
  const CylinderGrid grid({0, 1}, {-1, 1}, {3, 4, 4});
  ExactCylinderDeposition deposition(grid);
  const Superquadric shape{{0.3, 0.1, 0.2}, {4, 3}, {0.3, -0.5, 0.7, 0.1}};
  for (const Particle& ball : random_balls(50, 0.4, 0.4)) {
    const std::vector<double> cells = deposited(deposition, ball, shape);
    EXPECT_NEAR(sum(cells) / superquadric_volume(shape), 1, 1e-13);
    // A quarter turn about z of ball and body moves the deposits on by one sector.
    const auto& [w, x, y, z] = shape.quaternion;
    Superquadric turned = shape;
    turned.quaternion = {w - z, x - y, x + y, w + z};
    const Particle moved{2, {-ball.position[1], ball.position[0], ball.position[2]}, {}, ball.radius};
    const std::vector<double> after = deposited(deposition, moved, turned);
    for (int n = 0; n < 3 * 4 * 4; ++n) {
      const int i = n % 3, j = n / 3 % 4, k = n / 12;
      EXPECT_NEAR(after[grid.offset({i, (j + 1) % 4, k})], cells[grid.offset({i, j, k})], 1e-15);
    }
  }
}

}  // namespace
}  // namespace millfoam::averaging
