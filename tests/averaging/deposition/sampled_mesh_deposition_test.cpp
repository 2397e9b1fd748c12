// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/deposition/sampled_mesh_deposition.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "averaging/deposition/exact_mesh_deposition.hpp"
#include "tests/averaging/deposition/mesh_deposition_support.hpp"

namespace millfoam::averaging {
namespace {

TEST(SampledMeshDeposition, ABallWithinACellGivesItItsVolume) {
  SampledMeshDeposition deposition =
      at_rest<SampledMeshDeposition>(box_mesh({0, 0, 0}, {3, 3, 3}, {3, 3, 3}));
  EXPECT_EQ(deposited(deposition, ball_at({1.5, 1.5, 1.5}, 0.49))[13], sphere_volume(0.49));
}

TEST(SampledMeshDeposition, ConvergesToTheExactDeposits) {
  const std::vector<Particle> balls = balls_in_drum(60, 0.002, 0.009);
  ExactMeshDeposition exact = at_rest<ExactMeshDeposition>(warped_drum());
  std::array<double, 2> error{};
  for (const std::size_t level : {0U, 1U}) {
    SampledMeshDeposition sampling = at_rest<SampledMeshDeposition>(warped_drum(), level == 0 ? 8 : 32);
    for (const Particle& ball : balls) {
      const std::vector<double> a = deposited(exact, ball), b = deposited(sampling, ball);
      for (std::size_t c = 0; c < a.size(); ++c)
        error[level] += std::abs(a[c] - b[c]) / sphere_volume(ball.radius);
    }
  }
  // A face of random slope gives errors of the order of the lattice's spacing at worst, and of its square on
  // average: four times as many points along a diameter give 1/4 to 1/16.
  EXPECT_LT(error[1], error[0] / 4);
  EXPECT_GT(error[1], error[0] / 64);
}

}  // namespace
}  // namespace millfoam::averaging
