// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/time_step.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "dem_driver/contact.hpp"
#include "small_mill.hpp"

namespace millfoam::dem_driver {
namespace {

using tests::message_of;
using tests::small_mill;

TEST(TimeStep, ARecordIntervalIsAWholeNumberOfStepsNoLongerThanAnyLimit) {
  const auto mill = small_mill();
  const TimeStep step = choose_time_step(mill);
  EXPECT_NEAR(step.value * static_cast<double>(step.steps_per_record), mill.dem.record_interval, 1e-17);
  for (const auto& limit : step.limits) EXPECT_LE(step.value, limit.value) << limit.reason;
}

TEST(TimeStep, OneStepFewerPerRecordWouldBreakALimit) {
  const auto mill = small_mill();
  const TimeStep step = choose_time_step(mill);
  double longest = 1;
  for (const auto& limit : step.limits) longest = std::min(longest, limit.value);
  EXPECT_GT(mill.dem.record_interval / static_cast<double>(step.steps_per_record - 1), longest);
}

TEST(TimeStep, ASmallRayleighFractionGovernsThroughTheSmallestBall) {
  auto mill = small_mill();
  mill.dem.rayleigh_fraction = 0.01;
  const TimeStep step = choose_time_step(mill);
  const double rayleigh = rayleigh_time(0.001, 2500, {5e6, 0.25});
  EXPECT_LE(step.value, 0.01 * rayleigh);
  EXPECT_GT(step.value, 0.01 * rayleigh * (1 - 0.01 * rayleigh / mill.dem.record_interval));
}

TEST(TimeStep, FourTimesTheModulusHalvesTheRayleighLimit) {
  auto mill = small_mill();
  const double soft = choose_time_step(mill).limits.at(0).value;
  mill.dem.youngs_modulus *= 4;
  EXPECT_NEAR(choose_time_step(mill).limits.at(0).value / soft, 0.5, 1e-12);
}

TEST(TimeStep, OfSuperquadricsTheLeastRadiusOfCurvatureAndTheFlatSidesGovern) {
  auto mill = small_mill();
  mill.charge.classes.pop_back();
  const auto spheres = choose_time_step(mill);
  const auto shape = meshing::scaled_to({{1, 1, 1}, 6}, 0.002);
  mill.charge.classes.back().shape = shape;
  mill.dem.curvature_limit = 10;
  const auto blocks = choose_time_step(mill);
  EXPECT_NEAR(blocks.limits.at(0).value / spheres.limits.at(0).value,
              meshing::least_radius_of_curvature(shape) / 0.001, 1e-9);
  // A Hertz contact is shorter by the fifth root of the radii
  EXPECT_NEAR(blocks.limits.at(1).value / spheres.limits.at(1).value, std::pow(10, -0.2), 1e-9);
  EXPECT_NEAR(blocks.overlap.ratio / spheres.overlap.ratio,
              std::pow(meshing::least_radius_of_curvature(shape) / 0.001, -0.2), 1e-9);
  EXPECT_NE(blocks.limits.at(0).reason.find("2 mm of blockiness 6"), std::string::npos);
}

TEST(TimeStep, TheHardestImpactIsAFallThroughTheDiameterPlusTheShellsSpeed) {
  auto mill = small_mill();
  mill.geometry.diameter = 0.2;
  mill.angular_velocity = -5;
  EXPECT_NEAR(expected_impact_speed(mill), std::sqrt(2 * 9.81 * 0.2) + 0.5, 1e-12);
}

TEST(TimeStep, AFastMillIsLimitedByTheCrossingOfTheAllowedOverlap) {
  auto mill = small_mill();
  mill.angular_velocity = -5000;
  mill.dem.rayleigh_fraction = 100;
  const TimeStep step = choose_time_step(mill);
  const double crossing = 0.15 * 0.002 / 6 / expected_impact_speed(mill);
  EXPECT_LE(step.value, crossing);
  EXPECT_GT(step.value, 0.99 * crossing);
}

TEST(TimeStep, TheReportNamesTheLimitsAndWarnsWhenBallsAreTooSoft) {
  auto mill = small_mill();
  std::ostringstream fine;
  print_time_step(fine, choose_time_step(mill), mill);
  EXPECT_NE(fine.str().find("Rayleigh time of 2 mm"), std::string::npos);
  EXPECT_EQ(fine.str().find("WARNING"), std::string::npos);
  mill.angular_velocity = -500;
  std::ostringstream soft;
  print_time_step(soft, choose_time_step(mill), mill);
  EXPECT_NE(soft.str().find("raise dem.youngs_modulus"), std::string::npos);
}

TEST(TimeStep, TheReportWarnsOfBallsThatAreStifferThanRealOnesOrNotStiffEnough) {
  const auto warning = [](const meshing::Mill& mill) {
    std::ostringstream out;
    print_time_step(out, choose_time_step(mill), mill);
    const auto at = out.str().find("WARNING");
    return at == std::string::npos ? std::string() : out.str().substr(at);
  };
  auto mill = small_mill();
  mill.dem.youngs_modulus = 2 * mill.ball.youngs_modulus;
  EXPECT_EQ(warning(mill).find("WARNING: dem.youngs_modulus is above the balls' real modulus"), 0u);
  mill.dem.youngs_modulus = 0;
  mill.dem.largest_overlap = 0.07;
  EXPECT_EQ(warning(mill), "");
  mill.dem.largest_overlap = 1e-9;
  EXPECT_EQ(warning(mill).find("WARNING: dem.largest_overlap, 1e-07 %, is not kept"), 0u) << warning(mill);
}

TEST(Softness, HarderBallsOverlapLessAndCostMoreByHertzAndRayleigh) {
  auto mill = small_mill();
  mill.dem.rayleigh_fraction = 0.01;
  mill.dem.youngs_modulus = 1e8;
  const std::vector<Softness> table = softness_table(mill);
  ASSERT_EQ(table.size(), 7U);
  const std::vector<double> moduli{5e6, 1e7, 3e7, 1e8, 1e9, 1e10, 6e10};
  const TimeStep chosen = choose_time_step(mill);
  for (std::size_t i = 0; i < table.size(); ++i) {
    EXPECT_EQ(table[i].modulus, moduli[i]);
    // The largest overlap goes with E^-0.4, the step with E^-0.5 and is cut to a whole number of records
    EXPECT_NEAR(table[i].overlap / chosen.overlap.ratio, std::pow(moduli[i] / 1e8, -0.4), 1e-9);
    const double cut = 2 * std::max(table[i].time_step, chosen.value) / mill.dem.record_interval;
    EXPECT_NEAR(table[i].time_step / chosen.value / std::pow(moduli[i] / 1e8, -0.5), 1, cut);
    EXPECT_DOUBLE_EQ(table[i].cost, chosen.value / table[i].time_step);
  }
  EXPECT_EQ(table[3].time_step, chosen.value);
}

TEST(Softness, EndsAtTheBallsOwnModulus) {
  auto mill = small_mill();
  const auto moduli = [&](double real) {
    mill.ball.youngs_modulus = real;
    std::vector<double> result;
    for (const Softness& row : softness_table(mill)) result.push_back(row.modulus);
    return result;
  };
  EXPECT_EQ(moduli(3e7), (std::vector<double>{5e6, 1e7, 3e7}));
  EXPECT_EQ(moduli(2e7), (std::vector<double>{5e6, 1e7, 2e7}));
  EXPECT_EQ(moduli(5e6), (std::vector<double>{5e6}));
}

TEST(Softness, IsPrintedAsATable) {
  const auto mill = small_mill();
  std::ostringstream out;
  print_advice(out, mill);
  std::istringstream lines(out.str());
  std::string heading;
  std::getline(lines, heading);
  EXPECT_EQ(heading, "softness: modulus Pa   largest overlap %   time-step us   cost");
  for (const Softness& row : softness_table(mill)) {
    double modulus = 0, overlap = 0, step = 0, cost = 0;
    ASSERT_TRUE(lines >> modulus >> overlap >> step >> cost);
    EXPECT_NEAR(modulus / row.modulus, 1, 5e-3);
    EXPECT_NEAR(overlap / (100 * row.overlap), 1, 5e-3);
    EXPECT_NEAR(step / (1e6 * row.time_step), 1, 5e-3);
    EXPECT_NEAR(cost / row.cost, 1, 5e-3);
  }
}

TEST(TimeStep, AMillWithoutBallsIsRefused) {
  auto mill = small_mill();
  mill.charge.classes.clear();
  EXPECT_NE(message_of([&] { choose_time_step(mill); }).find("no size class"), std::string::npos);
}

}  // namespace
}  // namespace millfoam::dem_driver
