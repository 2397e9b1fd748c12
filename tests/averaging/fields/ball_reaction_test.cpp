// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/fields/ball_reaction.hpp"

#include <gtest/gtest.h>

#include <random>

namespace millfoam::averaging {
namespace {

const BoxGrid box({-0.03, -0.03, 0}, {0.03, 0.03, 0.02}, {4, 4, 2}, {false, false, true});

/// Balls at random in voxels that walls cut; none in every fifth.
SolidsWindow random_balls(std::mt19937& random) {
  std::uniform_real_distribution<double> share(0.1, 0.6), speed(-1, 1);
  SolidsWindow window;
  for (std::size_t n = 0; n < box.size(); ++n) {
    window.solidity.push_back(n % 5 == 0 ? 0 : share(random));
    for (int k = 0; k < 3; ++k) window.velocity.push_back(speed(random));
    window.diameter.push_back(0.004);
    window.diameter43.push_back(0.005);
    window.inside_fraction.push_back(share(random));
  }
  return window;
}

/// Volume of the balls in a voxel, m^3.
double balls_in(const SolidsWindow& window, std::size_t n) {
  return window.solidity[n] * window.inside_fraction[n] * box.voxel_volume();
}

TEST(BallReaction, gives_the_balls_what_the_cells_give) {
  std::mt19937 random(5);
  const SolidsWindow window = random_balls(random);
  std::uniform_real_distribution<double> across(-0.03, 0.03), along(0, 0.02), any(-1, 1), positive(0.1, 1);
  BallReaction reaction(box.size());
  Vector3 given{}, given_by_drag{};
  for (int cell = 0; cell < 500; ++cell) {
    const Vector3 centre{across(random), across(random), along(random)};
    const LocalSolids solids = sample(box, window, centre, Interpolation::linear);
    if (solids.solidity == 0) continue;
    const double volume = 1e-9 * positive(random), exchange = 1e4 * positive(random);
    const Vector3 pressure{any(random), any(random), any(random)}, u{any(random), any(random), any(random)};
    reaction.add(solids_shares(box, window, centre), volume / solids.solidity, pressure, exchange, u);
    for (std::size_t k = 0; k < 3; ++k) {
      given[k] += volume * pressure[k];
      given_by_drag[k] += volume * exchange * (u[k] - solids.velocity[k]);
    }
  }
  const BallFields felt = reaction.fields(box, window);
  Vector3 taken{}, taken_by_drag{};
  for (std::size_t n = 0; n < box.size(); ++n)
    for (std::size_t k = 0; k < 3; ++k) {
      taken[k] += balls_in(window, n) * felt.pressure_force[3 * n + k];
      taken_by_drag[k] +=
          balls_in(window, n) * (felt.drag_force[3 * n + k] - felt.exchange[n] * window.velocity[3 * n + k]);
    }
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(taken[k] / given[k], 1, 1e-12);
    EXPECT_NEAR(taken_by_drag[k] / given_by_drag[k], 1, 1e-12);
  }
}

TEST(BallReaction, leaves_out_voxels_without_balls_or_cells) {
  std::mt19937 random(6);
  const SolidsWindow window = random_balls(random);
  BallReaction reaction(box.size());
  const Vector3 centre = box.centre({1, 0, 0});
  reaction.add(solids_shares(box, window, centre), 1e-9, {1, 2, 3}, 1, {});
  const BallFields felt = reaction.fields(box, window);
  for (std::size_t n = 0; n < box.size(); ++n)
    EXPECT_EQ(felt.inside[n], n == box.offset({1, 0, 0}) ? window.inside_fraction[n] : 0);
}

TEST(SolidsShares, add_up_to_the_solidity_or_are_none) {
  std::mt19937 random(7);
  SolidsWindow window = random_balls(random);
  const auto sum = [&](const Vector3& point) {
    double all = 0;
    for (const SolidsShare& one : solids_shares(box, window, point)) all += one.solidity;
    return all;
  };
  const Vector3 point{0.001, -0.012, 0.019};
  EXPECT_NEAR(sum(point), sample(box, window, point, Interpolation::linear).solidity, 1e-15);
  EXPECT_EQ(sum({0.04, 0, 0}), 0);
  window.solidity.assign(box.size(), 0);
  EXPECT_EQ(sum(point), 0);
}

}  // namespace
}  // namespace millfoam::averaging
