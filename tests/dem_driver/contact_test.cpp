// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/contact.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace millfoam::dem_driver {
namespace {

const Elastic glass{6.5e7, 0.23};
const Elastic nylon{3e9, 0.4};

/// Largest overlap and duration of an elastic impact, from stepping m x'' = -k x^1.5.
struct Impact {
  double overlap = 0;
  double duration = 0;
};

Impact integrate(const ContactPair& pair, double speed) {
  const double stiffness = pair.stiffness();
  double overlap = 0;
  double velocity = speed;
  Impact impact;
  const double step = 1e-9;
  do {
    velocity -= 0.5 * step * stiffness * std::pow(std::max(overlap, 0.0), 1.5) / pair.mass;
    overlap += step * velocity;
    velocity -= 0.5 * step * stiffness * std::pow(std::max(overlap, 0.0), 1.5) / pair.mass;
    impact.overlap = std::max(impact.overlap, overlap);
    impact.duration += step;
  } while (overlap > 0);
  return impact;
}

TEST(Contact, TwoEqualBallsHaveHalfTheModulusRadiusAndMassOfOneOnARigidWall) {
  const auto pair = ball_on_ball(0.004, 0.004, 2700, glass, glass);
  const auto wall = ball_on_wall(0.004, 2700, glass, {1e30, 0.3});
  EXPECT_NEAR(pair.modulus / wall.modulus, 0.5, 1e-12);
  EXPECT_NEAR(pair.radius / wall.radius, 0.5, 1e-12);
  EXPECT_NEAR(pair.mass / wall.mass, 0.5, 1e-12);
}

TEST(Contact, AVeryLargeBallActsLikeAWallOfTheSameMaterial) {
  const auto pair = ball_on_ball(0.004, 4e6, 2700, glass, glass);
  const auto wall = ball_on_wall(0.004, 2700, glass, glass);
  EXPECT_NEAR(pair.stiffness() / wall.stiffness(), 1, 1e-8);
  EXPECT_NEAR(pair.mass / wall.mass, 1, 1e-8);
}

TEST(Contact, TheModulusOfTwoMaterialsIsThatOfTwoSpringsInSeries) {
  const auto pair = ball_on_wall(0.004, 2700, glass, nylon);
  EXPECT_NEAR(1 / pair.modulus, (1 - 0.23 * 0.23) / 6.5e7 + (1 - 0.4 * 0.4) / 3e9, 1e-20);
}

TEST(Contact, RayleighTimeOfA2MillimetreGlassBallWith10MegapascalIs89Microseconds) {
  // R = 1 mm, G = 1e7/2.46 Pa: pi 1e-3 sqrt(2700/4065040.65)/(0.1631 0.23 + 0.8766) by hand
  EXPECT_NEAR(rayleigh_time(0.001, 2700, {1e7, 0.23}), 8.85726e-5, 1e-10);
}

TEST(Contact, AnElasticImpactTurnsAllKineticEnergyIntoTheHertzSpring) {
  const auto pair = ball_on_wall(0.004, 2700, glass, nylon);
  const double overlap = largest_overlap(pair, 1.7, 1);
  EXPECT_NEAR(0.4 * pair.stiffness() * std::pow(overlap, 2.5) / (0.5 * pair.mass * 1.7 * 1.7), 1, 1e-12);
}

TEST(Contact, DurationAndOverlapAgreeWithTheIntegratedEquationOfMotion) {
  const auto pair = ball_on_ball(0.002, 0.006, 2700, glass, glass);
  const Impact impact = integrate(pair, 1.3);
  EXPECT_NEAR(hertz_contact_time(pair, 1.3) / impact.duration, 1, 1e-4);
  EXPECT_NEAR(largest_overlap(pair, 1.3, 1) / impact.overlap, 1, 1e-4);
}

TEST(Contact, AnImpactWithoutReboundHasTheOverlapFactor046) {
  // e -> 0: damping -> 1, so the factor is 0.73 - 0.27 = 0.46.
  const auto pair = ball_on_wall(0.004, 2700, glass, nylon);
  EXPECT_NEAR(largest_overlap(pair, 2, 1e-300) / largest_overlap(pair, 2, 1), 0.46, 1e-4);
}

}  // namespace
}  // namespace millfoam::dem_driver
