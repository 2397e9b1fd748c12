// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/deposition/exact_box_deposition.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "averaging/deposition/sampled_box_deposition.hpp"
#include "tests/averaging/deposition/deposition_support.hpp"

namespace millfoam::averaging {
namespace {

TEST(ExactBoxDeposition, GivesTheSpheresVolumeWhereNothingSticksOut) {
  ExactBoxDeposition deposition(BoxGrid({-1, -1, -1}, {1, 1, 1}, {9, 8, 7}));
  for (const Particle& ball : random_balls(2000, 0.6, 0.4)) {
    EXPECT_NEAR(sum(deposited(deposition, ball)) / sphere_volume(ball.radius), 1, 1e-14);
  }
}

TEST(ExactBoxDeposition, AVoxelGetsTheSphereInItsOwnBox) {
  const BoxGrid grid({-1, -1.5, -1}, {1, 1, 2}, {5, 6, 7});
  ExactBoxDeposition deposition(grid);
  for (const Particle& ball : random_balls(50, 1.5, 0.8)) {
    const std::vector<double> cells = deposited(deposition, ball);
    for (int v = 0; v < 5 * 6 * 7; ++v) {
      const VoxelIndex voxel{v % 5, v / 5 % 6, v / 30};
      const Vector3 centre = grid.centre(voxel);
      std::array<double, 3> lower{}, upper{};
      for (std::size_t a = 0; a < 3; ++a) {
        lower[a] = centre[a] - grid.spacing()[a] / 2 - ball.position[a];
        upper[a] = centre[a] + grid.spacing()[a] / 2 - ball.position[a];
      }
      ASSERT_NEAR(cells[grid.offset(voxel)], sphere_box_volume(lower, upper, ball.radius), 3e-15);
    }
  }
}

TEST(ExactBoxDeposition, ASphereWhollyInOneVoxelGivesItExactlyItsVolume) {
  const BoxGrid grid({0, 0, 0}, {3, 3, 3}, {3, 3, 3});
  ExactBoxDeposition deposition(grid);
  const std::vector<double> cells = deposited(deposition, {1, {1.45, 1.5, 1.6}, {}, 0.39});
  EXPECT_NEAR(cells[grid.offset({1, 1, 1})] / sphere_volume(0.39), 1, 1e-15);
  EXPECT_EQ(cells[grid.offset({1, 1, 1})], sum(cells));
}

TEST(ExactBoxDeposition, BeyondTheGridASphereGivesNothingAndAcrossItsFaceTheSegment) {
  ExactBoxDeposition deposition(BoxGrid({0, 0, 0}, {2, 2, 2}, {4, 4, 4}));
  EXPECT_EQ(sum(deposited(deposition, {1, {2.5, 1, 1}, {}, 0.49})), 0);
  EXPECT_EQ(sum(deposited(deposition, {1, {2.4, 2.4, 1}, {}, 0.5})), 0);
  EXPECT_NEAR(sum(deposited(deposition, {1, {2, 1, 1}, {}, 0.4})), sphere_volume(0.4) / 2, 1e-15);
  EXPECT_NEAR(sum(deposited(deposition, {1, {0, 2, 0}, {}, 0.4})), sphere_volume(0.4) / 8, 1e-15);
}

TEST(ExactBoxDeposition, ASphereAcrossAPeriodicFaceComesInOnTheOtherSide) {
  ExactBoxDeposition deposition(BoxGrid({0, 0, 0}, {1, 1, 4}, {1, 1, 4}, {false, false, true}));
  for (const double z : {0.0, 4.0, -8.0}) {
    const std::vector<double> cells = deposited(deposition, {1, {0.5, 0.5, z}, {}, 0.4});
    EXPECT_NEAR(cells[0], sphere_volume(0.4) / 2, 1e-15);
    EXPECT_NEAR(cells[3], sphere_volume(0.4) / 2, 1e-15);
  }
}

TEST(ExactBoxDeposition, AnEverRepeatingSphereLargerThanThePeriodLosesNothing) {
  ExactBoxDeposition deposition(BoxGrid({-3, -3, 0}, {3, 3, 0.5}, {6, 6, 3}, {false, false, true}));
  EXPECT_NEAR(sum(deposited(deposition, {1, {0, 0, 0.1}, {}, 1.7})) / sphere_volume(1.7), 1, 1e-14);
}

TEST(ExactBoxDeposition, IsWhatSamplingTendsToAtFirstOrderOrFaster) {
  // Over random places the template's error has no bias; its root mean square at a plane falls as 1/n or
  // faster
  // (`sphere_template.hpp` has 2.6 % at n = 12 and 1.3 % at 24).
  const BoxGrid grid({-1, -1, -1}, {1, 1, 1}, {4, 4, 4});
  ExactBoxDeposition exact(grid);
  std::vector<double> errors;
  for (const int n : {6, 12, 24, 48, 96}) {
    SampledBoxDeposition sampling(grid, n);
    errors.push_back(root_mean_square_difference(exact, sampling, random_balls(400, 0.6, 0.4)));
  }
  EXPECT_LT(errors[1], 0.026);
  for (std::size_t i = 1; i < errors.size(); ++i) EXPECT_LT(errors[i] / errors[i - 1], 0.6) << i;
}

TEST(ExactBoxDeposition, AnAbsurdlyLargeBallIsRefusedWithItsNumber) {
  ExactBoxDeposition deposition(BoxGrid({0, 0, 0}, {1, 1, 1}, {4, 4, 4}, {false, true, false}));
  std::vector<Deposit> deposits;
  const auto deposit = [&] { deposition.deposit({17, {0, 0, 0}, {}, 1e9}, deposits); };
  expect_named(message_of<std::invalid_argument>(deposit), {"17", "1e+09", "along y", "0.25"});
}

}  // namespace
}  // namespace millfoam::averaging
