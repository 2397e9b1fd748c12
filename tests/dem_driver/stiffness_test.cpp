// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/stiffness.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "dem_driver/pairs.hpp"
#include "dem_driver/time_step.hpp"
#include "small_mill.hpp"

namespace millfoam::dem_driver {
namespace {

using tests::message_of;
using tests::small_mill;

meshing::Mill mill_of_overlap(double share) {
  auto mill = small_mill();
  mill.dem.youngs_modulus = 0;
  mill.dem.largest_overlap = share;
  return mill;
}

TEST(Stiffness, AModulusOfTheDescriptionIsTakenAsItStands) {
  EXPECT_EQ(choose_stiffness(small_mill()).modulus, 5e6);
  EXPECT_EQ(choose_stiffness(small_mill()).of_ball(0.002), 5e6);
}

TEST(Stiffness, TheModulusFollowsFromTheLargestOverlap) {
  const auto mill = mill_of_overlap(0.03);
  EXPECT_NEAR(expected_overlap(mill, choose_stiffness(mill)).ratio, 0.03, 1e-12);
}

TEST(Stiffness, SoDoesItWithSofterSmallBalls) {
  auto mill = mill_of_overlap(0.02);
  mill.dem.soften_below = 0.003;
  EXPECT_NEAR(expected_overlap(mill, choose_stiffness(mill)).ratio, 0.02, 1e-12);
}

TEST(Stiffness, NoBallIsStifferThanTheRealOne) {
  EXPECT_EQ(choose_stiffness(mill_of_overlap(1e-6)).modulus, 6e10);
}

TEST(Stiffness, NoBallIsSofterThanLiggghtsAccepts) {
  EXPECT_EQ(choose_stiffness(mill_of_overlap(0.15)).modulus, smallest_modulus);
  auto mill = mill_of_overlap(0.15);
  mill.dem.soften_below = 0.003;
  EXPECT_NEAR(choose_stiffness(mill).of_ball(0.002) / smallest_modulus, 1, 1e-12);
}

TEST(Stiffness, AModulusTooSoftIsRefusedByItsKey) {
  auto mill = small_mill();
  mill.dem.youngs_modulus = 1e6;
  EXPECT_EQ(
      message_of([&] { choose_stiffness(mill); }),
      "key 'dem.youngs_modulus' = 1e+06: expected at least 5e+06 Pa, the softest that LIGGGHTS accepts");
  mill.dem.youngs_modulus = 6e6;
  mill.dem.soften_below = 0.003;
  EXPECT_EQ(
      message_of([&] { choose_stiffness(mill); }),
      "key 'dem.soften_below' = 0.003: expected a diameter in m with which the balls of 0.002 m have at "
      "least 5e+06 Pa, the softest that LIGGGHTS accepts, not 2.17732e+06 Pa");
}

TEST(Stiffness, TheSmallestBallsNoLongerShortenTheTimeStep) {
  auto mill = small_mill();
  mill.dem.youngs_modulus = 2e7;
  const double all_hard = choose_time_step(mill).limits.at(0).value;
  mill.dem.soften_below = 0.003;
  const double softened = choose_time_step(mill).limits.at(0).value;
  EXPECT_NEAR(softened / all_hard, 1.5, 1e-12);
}

TEST(Stiffness, TwoBallsOfDifferentModulusShareTheirCompliance) {
  const Elastic hard{4e7, 0.25};
  const Elastic soft{1e7, 0.25};
  const double pair = ball_on_ball(0.002, 0.003, 2500, hard, soft).modulus;
  EXPECT_NEAR(1 / pair, (1 - 0.0625) * (1 / 4e7 + 1 / 1e7), 1e-12 / pair);
}

TEST(Stiffness, FinesHaveNoPart) {
  auto mill = small_mill();
  mill.charge.fines_below = 0.0025;
  EXPECT_EQ(smallest_simulated(mill), 0.003);
  EXPECT_EQ(all_pairs(mill, choose_stiffness(mill)).size(), 2u);
  mill.charge.fines_below = 0.01;
  EXPECT_NE(message_of([&] { smallest_simulated(mill); }).find("no size class"), std::string::npos);
}

TEST(Stiffness, TheAdviceListsModulusOverlapAndCost) {
  std::ostringstream out;
  print_advice(out, small_mill());
  EXPECT_NE(out.str().find("5e+06"), std::string::npos) << out.str();
  EXPECT_NE(out.str().find("6e+10"), std::string::npos) << out.str();
}

}  // namespace
}  // namespace millfoam::dem_driver
