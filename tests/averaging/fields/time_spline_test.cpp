// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/fields/time_spline.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>
#include <vector>

namespace millfoam::averaging {
namespace {

constexpr double unbounded = 1e30;

double value(const TimeSpline& spline, const std::vector<double>& coefficients, std::size_t window,
             double share) {
  const SplineMoment moment = spline.at(window, share);
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) sum += moment.shares[i] * coefficients[moment.windows[i]];
  return sum;
}

/// Mean over a window by Simpson's rule, exact for parabolas.
double mean(const TimeSpline& spline, const std::vector<double>& coefficients, std::size_t window) {
  return (value(spline, coefficients, window, 0) + 4 * value(spline, coefficients, window, 0.5) +
          value(spline, coefficients, window, 1)) /
         6;
}

/// Slope over the window's length at its begin (0) or end (1), exact for parabolas.
double slope(const TimeSpline& spline, const std::vector<double>& coefficients, std::size_t window,
             double share) {
  const double side = share == 0 ? 1 : -1;
  return side *
         (-3 * value(spline, coefficients, window, share) + 4 * value(spline, coefficients, window, 0.5) -
          value(spline, coefficients, window, 1 - share));
}

std::vector<double> random_numbers(unsigned seed, double lowest, double highest) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> number(lowest, highest);
  std::vector<double> result(200);
  std::generate(result.begin(), result.end(), [&] { return number(engine); });
  return result;
}

TEST(TimeSpline, KeepsTheMeansOfTheWindows) {
  const auto lengths = random_numbers(1, 0.5, 2);
  const auto means = random_numbers(2, 0.2, 0.3);
  for (const bool repeats : {false, true}) {
    const TimeSpline spline(lengths, repeats);
    const auto coefficients = spline.coefficients(means, 0.9);
    for (std::size_t k = 0; k < means.size(); ++k)
      EXPECT_NEAR(mean(spline, coefficients, k), means[k], 1e-15) << k;
  }
}

TEST(TimeSpline, ValuesAndSlopesAgreeWhereWindowsMeet) {
  const auto lengths = random_numbers(3, 0.5, 2);
  const TimeSpline spline(lengths, true);
  const auto coefficients = random_numbers(4, 0, 1);
  for (std::size_t k = 0; k < lengths.size(); ++k) {
    const std::size_t next = (k + 1) % lengths.size();
    EXPECT_NEAR(value(spline, coefficients, k, 1), value(spline, coefficients, next, 0), 1e-15) << k;
    EXPECT_NEAR(slope(spline, coefficients, k, 1) / lengths[k],
                slope(spline, coefficients, next, 0) / lengths[next], 1e-13)
        << k;
  }
}

TEST(TimeSpline, IsFlatAtTheEndsOfWindowsThatDoNotRepeat) {
  const TimeSpline spline({1, 2, 3}, false);
  EXPECT_NEAR(slope(spline, {0.1, 0.3, 0.2}, 0, 0), 0, 1e-15);
  EXPECT_NEAR(slope(spline, {0.1, 0.3, 0.2}, 2, 1), 0, 1e-15);
  EXPECT_NEAR(value(spline, {0.1, 0.3, 0.2}, 2, 1), 0.2, 1e-15);
}

TEST(TimeSpline, SharesAreZeroOrAboveAndHaveTheSumOne) {
  const auto lengths = random_numbers(5, 0.1, 10);
  const TimeSpline spline(lengths, false);
  for (std::size_t k = 0; k < lengths.size(); ++k) {
    for (const double share : {0.0, 0.01, 0.5, 0.99, 1.0}) {
      const auto shares = spline.at(k, share).shares;
      EXPECT_GE(*std::min_element(shares.begin(), shares.end()), 0);
      EXPECT_NEAR(shares[0] + shares[1] + shares[2], 1, 1e-15);
    }
  }
}

TEST(TimeSpline, StaysWithinTheBoundsAndKeepsTheMeanOverAllWindows) {
  auto means = random_numbers(7, -0.3, 0.64);
  for (double& each : means) each = std::max(each, 0.0);
  for (const bool repeats : {false, true}) {
    const TimeSpline spline(std::vector<double>(means.size(), 0.5), repeats);
    const auto coefficients = spline.coefficients(means, 0.65);
    const auto [lowest, highest] = std::minmax_element(coefficients.begin(), coefficients.end());
    EXPECT_GE(*lowest, 0);
    EXPECT_LE(*highest, 0.65 * (1 + 1e-15));
    double difference = 0;
    double largest = 0;
    int kept = 0;
    for (std::size_t k = 0; k < means.size(); ++k) {
      const double error = mean(spline, coefficients, k) - means[k];
      difference += error;
      largest = std::max(largest, std::abs(error));
      kept += std::abs(error) < 1e-14;
    }
    EXPECT_NEAR(difference, 0, 1e-12);
    EXPECT_LT(largest, 0.64 / 3 + 1e-15);
    EXPECT_GT(kept, 0);
    EXPECT_LT(kept, 190);
  }
}

TEST(TimeSpline, KeepsTheMeanOverAllWindowsOfAnyLengths) {
  const auto lengths = random_numbers(8, 0.5, 2);
  auto means = random_numbers(9, -0.3, 0.6);
  for (double& each : means) each = std::max(each, 0.0);
  for (const bool repeats : {false, true}) {
    const TimeSpline spline(lengths, repeats);
    const auto coefficients = spline.coefficients(means, 0.9);
    double difference = 0;
    for (std::size_t k = 0; k < means.size(); ++k) {
      EXPECT_GE(coefficients[k], 0) << k;
      if (means[k] == 0) {
        EXPECT_EQ(coefficients[k], 0) << k;
      }
      difference += lengths[k] * (mean(spline, coefficients, k) - means[k]);
    }
    EXPECT_NEAR(difference, 0, 1e-12);
  }
}

TEST(TimeSpline, FewBoundsLeaveTheOtherMeans) {
  // One empty window among full ones: the means away from it are kept
  std::vector<double> means(41, 0.3);
  means[20] = 0;
  const TimeSpline spline(std::vector<double>(41, 0.1), false);
  const auto coefficients = spline.coefficients(means, 0.9);
  for (std::size_t k = 0; k < means.size(); ++k) {
    const double error = mean(spline, coefficients, k) - means[k];
    if (k < 15 || k > 25) {
      EXPECT_NEAR(error, 0, 1e-4) << k;
    }
  }
}

TEST(TimeSpline, KeepsAMeanAboveTheLargest) {
  const TimeSpline spline({1, 1, 1}, false);
  const auto coefficients = spline.coefficients({0.95, 0.95, 0.95}, 0.9);
  for (const double each : coefficients) EXPECT_NEAR(each, 0.95, 1e-15);
}

TEST(TimeSpline, FollowsAStraightLineBetweenTheOuterWindows) {
  // The ends are flat, which dies out by a factor of 2 + sqrt(3) from window to window
  std::vector<double> means(101);
  for (std::size_t k = 0; k < means.size(); ++k) means[k] = 1 + 0.01 * double(k);
  const TimeSpline spline(std::vector<double>(means.size(), 0.2), false);
  const auto coefficients = spline.coefficients(means, unbounded);
  for (const double share : {0.0, 0.3, 1.0}) {
    EXPECT_NEAR(value(spline, coefficients, 50, share), 1.5 + 0.01 * (share - 0.5), 1e-15);
  }
  EXPECT_GT(std::abs(value(spline, coefficients, 0, 0) - 0.995), 1e-3);
}

TEST(TimeSpline, OneWindowIsConstant) {
  for (const bool repeats : {false, true}) {
    const TimeSpline spline({0.5}, repeats);
    const auto coefficients = spline.coefficients({0.4}, 0.9);
    EXPECT_NEAR(coefficients[0], 0.4, 1e-16);
    EXPECT_NEAR(value(spline, coefficients, 0, 0.3), 0.4, 1e-16);
  }
}

TEST(TimeSpline, RefusesWindowsWithoutLength) {
  EXPECT_THROW(TimeSpline({}, false), std::invalid_argument);
  EXPECT_THROW(TimeSpline({1, 0}, false), std::invalid_argument);
}

}  // namespace
}  // namespace millfoam::averaging
