// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/steady_state.hpp"

#include <gtest/gtest.h>

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
  EXPECT_FALSE(judge_steadiness(std::vector<double>(fewest_values - 1, 2.5)).steady);
  EXPECT_FALSE(judge_steadiness({}).steady);
}

}  // namespace
}  // namespace millfoam::dem_driver
