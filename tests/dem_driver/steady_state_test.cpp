// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/steady_state.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace millfoam::dem_driver {
namespace {

/// 2 + transient(i) + noise that is correlated over about five values.
template <typename Transient>
std::vector<double> series(std::size_t count, double noise, Transient transient) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> step(-1, 1);
  std::vector<double> values;
  double now = 0;
  for (std::size_t i = 0; i < count; ++i) {
    now = 0.8 * now + noise * step(random);
    values.push_back(2 + transient(static_cast<double>(i)) + now);
  }
  return values;
}

TEST(SteadyState, NoiseAboutAMeanIsSteadyAndTheMeanIsWithinThreeErrors) {
  const auto result = judge_steadiness(series(1000, 0.2, [](double) { return 0.0; }));
  EXPECT_TRUE(result.steady);
  EXPECT_NEAR(result.mean, 2, 3 * result.standard_error);
  // Of the mean of 1000 correlated values: 0.2/sqrt(3)/(1 - 0.8)/sqrt(1000)
  EXPECT_NEAR(result.standard_error, 0.018, 0.012);
}

TEST(SteadyState, ATransientIsCutOffAfterAFewOfItsTimes) {
  const auto result = judge_steadiness(series(1000, 0.02, [](double i) { return 3 * std::exp(-i / 40); }));
  EXPECT_TRUE(result.steady);
  EXPECT_GT(result.begin, 100u);
  EXPECT_LT(result.begin, 400u);
  EXPECT_NEAR(result.mean, 2, 0.02);
}

TEST(SteadyState, ASeriesThatStillClimbsIsNotSteady) {
  EXPECT_FALSE(judge_steadiness(series(1000, 0.05, [](double i) { return i / 500; })).steady);
}

TEST(SteadyState, ATransientLongerThanTheSeriesIsNotSteady) {
  EXPECT_FALSE(judge_steadiness(series(1000, 0.02, [](double i) { return 3 * std::exp(-i / 800); })).steady);
}

TEST(SteadyState, AHighPeakAtTheStartHidesNoDriftAfterIt) {
  const auto result =
      judge_steadiness(series(1000, 0.01, [](double i) { return 30 * std::exp(-i / 10) + i / 2500; }));
  EXPECT_FALSE(result.steady);
}

TEST(SteadyState, AConstantSeriesIsSteadyFromItsBeginning) {
  const auto result = judge_steadiness(std::vector<double>(100, 2.5));
  EXPECT_TRUE(result.steady);
  EXPECT_EQ(result.begin, 0u);
  EXPECT_EQ(result.mean, 2.5);
}

TEST(SteadyState, TooFewValuesAreNotSteady) {
  const auto few = judge_steadiness(std::vector<double>(fewest_values - 1, 2.5));
  EXPECT_FALSE(few.steady);
  EXPECT_EQ(few.mean, 2.5);
  EXPECT_TRUE(std::isnan(few.standard_error)) << "not 0: it is not known";
  EXPECT_FALSE(judge_steadiness({}).steady);
}

TEST(SteadyState, WhatRepeatsWithEveryTurnHasNoErrorAndNoDrift) {
  const double turn = 17.3;
  std::vector<double> values;
  for (double i = 0; i < 150; ++i) values.push_back(2 + std::cos(2 * std::acos(-1) * (i + 0.5) / turn));
  const auto by_turns = judge_steadiness(values, turn);
  EXPECT_TRUE(by_turns.steady);
  EXPECT_NEAR(by_turns.mean, 2, 1e-3);
  EXPECT_LT(by_turns.standard_error, 5e-3);
  EXPECT_NEAR(by_turns.drift, 0, 5e-3);
  EXPECT_GT(judge_steadiness(values).standard_error, 3 * by_turns.standard_error);
}

TEST(SteadyState, AMeanOverTurnsBeginsWithAWholeTurn) {
  std::vector<double> values(105, 1.0);
  std::fill(values.begin(), values.begin() + 5, 100.0);
  const auto found = mean_since(values, 2, 20);
  EXPECT_EQ(found.begin, 5U);
  EXPECT_EQ(found.mean, 1);
  EXPECT_EQ(found.standard_error, 0);
  // Half of a value at the begin
  EXPECT_NEAR(mean_since(values, 2, 25.125).mean, 1 + 0.5 * 99 / 100.5, 1e-12);
  // Three turns are not enough: all values count
  EXPECT_NEAR(mean_since(values, 2, 30).mean, (3 * 100.0 + 100) / 103, 1e-12);
  EXPECT_TRUE(std::isnan(mean_since(values, 100, 20).standard_error));
}

TEST(SteadyState, TheErrorOverTurnsIsThatOfTheirMeansAboutALine) {
  // Turns of two values with the means 1, 2, 3, 5: 0.2, -0.1, -0.4, 0.3 off the line
  const auto found = mean_since({0, 2, 1, 3, 2, 4, 4, 6}, 0, 2);
  EXPECT_NEAR(found.mean, 2.75, 1e-12);
  EXPECT_NEAR(found.standard_error, std::sqrt(0.3 / 8), 1e-12);
  EXPECT_NEAR(found.drift, 2.5, 1e-12);
}

}  // namespace
}  // namespace millfoam::dem_driver
