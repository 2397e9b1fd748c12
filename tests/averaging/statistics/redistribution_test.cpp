// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/statistics/redistribution.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <random>

#include "averaging/grids/neighbours.hpp"
#include "tests/averaging/test_support.hpp"

namespace millfoam::averaging {
namespace {

/// Five cells in a row.
const std::vector<std::array<int, 2>> row{{0, 1}, {1, 2}, {2, 3}, {3, 4}};

TEST(Redistribution, LeavesWhatIsBelowTheCapAlone) {
  std::vector<double> volumes{0.1, 0.5, 0.2, 0.5, 0};
  const std::vector<double> before = volumes;
  EXPECT_EQ(redistribute_excess(volumes, 1, {0.5, 0.5, 0.5, 0.5, 0.5}, row), 0);
  EXPECT_EQ(volumes, before);
}

TEST(Redistribution, SharesTheExcessInProportionToTheFreeRoomBesideIt) {
  std::vector<double> volumes{0, 0.4, 0.9, 0.2, 0};
  EXPECT_NEAR(redistribute_excess(volumes, 1, {0.5, 0.5, 0.6, 0.5, 0.5}, row), 0.3, 1e-15);
  const std::vector<double> expected{0, 0.4 + 0.3 / 4, 0.6, 0.2 + 0.3 * 3 / 4, 0};
  for (std::size_t c = 0; c < 5; ++c) EXPECT_NEAR(volumes[c], expected[c], 1e-15) << c;
}

TEST(Redistribution, GoesOnToTheNextRingWhenTheNearestIsFull) {
  std::vector<double> volumes{0, 0.45, 1.0, 0.5, 0};
  EXPECT_NEAR(redistribute_excess(volumes, 1, {0.5, 0.5, 0.6, 0.5, 0.5}, row), 0.4, 1e-15);
  const std::vector<double> expected{0.175, 0.5, 0.6, 0.5, 0.175};
  for (std::size_t c = 0; c < 5; ++c) EXPECT_NEAR(volumes[c], expected[c], 1e-15) << c;
}

TEST(Redistribution, WhatBelongsToTheVolumeTravelsWithIt) {
  std::vector<double> values{0, 0, 1.0, 3.0};
  redistribute_excess(values, 2, {0.5, 0.8}, {{0, 1}});
  EXPECT_NEAR(values[0], 0.2, 1e-15);
  EXPECT_NEAR(values[1], 0.6, 1e-15);
  EXPECT_NEAR(values[3], 2.4, 1e-15);
}

TEST(Redistribution, WallsAreEmptiedIntoTheNearestRoomInProportionToIt) {
  std::vector<double> values{0.1, 1, 0.2, 2, 0, 0, 0.1, 1, 0.3, 3};
  const Redistributed result = redistribute_from_walls(values, 2, {0, 0, 0.5, 0, 1.5}, row);
  const std::vector<double> expected{0, 0, 0, 0, 0.1 + 0.2 + 0.025, 3.25, 0, 0, 0.375, 3.75};
  for (std::size_t n = 0; n < 10; ++n) EXPECT_NEAR(values[n], expected[n], 1e-15) << n;
  EXPECT_NEAR(result.moved, 0.4, 1e-15);
  EXPECT_EQ(result.lost, 0);
}

TEST(Redistribution, WallsDoNotGiveBackWhatIsFarFromTheMill) {
  std::vector<double> volumes{0.1, 0, 0, 0, 0.3};
  const Redistributed result = redistribute_from_walls(volumes, 1, {0, 0, 0, 0, 1}, row);
  EXPECT_EQ(result.moved, 0);
  EXPECT_EQ(result.lost, 0.1);
  EXPECT_EQ(volumes, (std::vector<double>{0, 0, 0, 0, 0.3}));
}

TEST(Redistribution, KeepsTheTotalsAndTheCapWhateverTheField) {
  const BoxGrid grid({0, 0, 0}, {1, 1, 1}, {8, 7, 6}, {true, false, true});
  std::mt19937 random(5);
  std::uniform_real_distribution<double> number(0, 1);
  std::vector<double> values, capacities;
  for (std::size_t c = 0; c < grid.size(); ++c) {
    values.insert(values.end(), {number(random), number(random) - 0.5});
    capacities.push_back(0.5 + 0.2 * number(random));
  }
  const auto total = [&](std::size_t column) {
    double sum = 0;
    for (std::size_t c = 0; c < grid.size(); ++c) sum += values[2 * c + column];
    return sum;
  };
  const double volume = total(0), other = total(1);
  EXPECT_GT(redistribute_excess(values, 2, capacities, neighbours(grid)), 0.1 * volume);
  EXPECT_NEAR(total(0) / volume, 1, 1e-13);
  EXPECT_NEAR(total(1), other, 1e-12);
  for (std::size_t c = 0; c < grid.size(); ++c) EXPECT_LE(values[2 * c], capacities[c] * (1 + 1e-11)) << c;
}

TEST(Redistribution, WithoutRoomForAllIsRefusedWithTheNumbers) {
  std::vector<double> volumes{0.5, 0.9, 0.5, 0, 0};
  const std::vector<std::array<int, 2>> apart{{0, 1}, {1, 2}, {3, 4}};
  expect_named(message_of<std::runtime_error>([&] {
                 redistribute_excess(volumes, 1, {0.5, 0.5, 0.6, 0.5, 0.5}, apart);
               }),
               {"cell 1", "0.3 m3", "0.5 m3", "larger cap"});
}

}  // namespace
}  // namespace millfoam::averaging
