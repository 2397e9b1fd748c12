// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/statistics/window_average.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/averaging/test_support.hpp"

namespace millfoam::averaging {
namespace {

const BoxGrid unit_voxel({0, 0, 0}, {1, 1, 1}, {1, 1, 1});

void add(WindowAverager& averager, const std::vector<Particle>& particles) {
  averager.add(sample_record(unit_voxel, SphereTemplate(), {0, particles}));
}

/// One voxel of 1 m^3. With V the volume of a ball of radius 0.1 m, the records hold
///   1: V at velocity (1, 0, 0);   2: a ball of radius 0.2, so 8 V, at (2, 0, 0);   3: nothing.
struct ThreeRecords : ::testing::Test {
  double v = sphere_volume(0.1);
  WindowAverage window;

  ThreeRecords() {
    WindowAverager averager(unit_voxel);
    add(averager, {{1, {0.5, 0.5, 0.5}, {1, 0, 0}, 0.1}});
    add(averager, {{2, {0.5, 0.5, 0.5}, {2, 0, 0}, 0.2}});
    add(averager, {});
    window = averager.average();
  }
};

TEST_F(ThreeRecords, MeanSolidityCountsTheEmptyRecord) {
  EXPECT_EQ(window.time.records, 3);
  EXPECT_NEAR(window.mean.solidity[0], (v + 8 * v + 0) / 3, 1e-15);
}

TEST_F(ThreeRecords, MeanVelocityIsWeightedBySolidity) {
  EXPECT_NEAR(window.mean.velocity[0], (1 * 1 + 8 * 2) / 9.0, 1e-15);
  EXPECT_EQ(window.mean.velocity[1], 0);
}

TEST_F(ThreeRecords, DiametersAreMeansOverSpaceAndWindow) {
  EXPECT_NEAR(window.mean.diameter[0], 9 / (1 / 0.2 + 8 / 0.4), 1e-15);
  EXPECT_NEAR(window.mean.diameter43[0], (1 * 0.2 + 8 * 0.4) / 9, 1e-15);
}

TEST_F(ThreeRecords, DeviationOfSolidityIsOverTheRecords) {
  // The records differ from their mean, 3 V, by -2, 5 and -3 V.
  EXPECT_NEAR(window.solidity_deviation[0], std::sqrt((4 + 25 + 9) / 3.0) * v, 1e-15);
}

TEST_F(ThreeRecords, DeviationOfVelocityIsWeightedBySolidity) {
  // From 17/9 the records differ by -8/9 with weight 1 and by 1/9 with weight 8.
  EXPECT_NEAR(window.velocity_deviation[0], std::sqrt((64 / 81.0 + 8 / 81.0) / 9), 1e-15);
  EXPECT_EQ(window.velocity_deviation[2], 0);
}

TEST_F(ThreeRecords, GranularTemperatureIsAThirdOfTheMeanSquareFluctuation) {
  EXPECT_NEAR(window.granular_temperature[0], (64 / 81.0 + 8 / 81.0) / 9 / 3, 1e-15);
}

TEST_F(ThreeRecords, TheLedgerHoldsMeansOverTheRecords) {
  EXPECT_NEAR(window.ledger.volume_in, 3 * v, 1e-15);
  EXPECT_NEAR(window.ledger.deposited, 3 * v, 1e-15);
  EXPECT_EQ(window.ledger.outside, 0);
  EXPECT_EQ(window.ledger.clipped, 0);
}

TEST(WindowAverager, OppositeVelocitiesInOneRecordAreTemperatureAndNotSpreadOfTheMean) {
  WindowAverager averager(unit_voxel);
  add(averager, {{1, {0.3, 0.5, 0.5}, {0, 3, 0}, 0.1}, {2, {0.7, 0.5, 0.5}, {0, -3, 0}, 0.1}});
  const WindowAverage window = averager.average();
  EXPECT_NEAR(window.mean.velocity[1], 0, 1e-15);
  EXPECT_NEAR(window.granular_temperature[0], 9.0 / 3, 1e-14);
  EXPECT_NEAR(window.velocity_deviation[1], 0, 1e-15);
}

TEST(WindowAverager, UniformMotionHasNoSpread) {
  WindowAverager averager(unit_voxel);
  for (int record = 0; record < 50; ++record) add(averager, {{1, {0.4, 0.5, 0.6}, {0.1, 0.2, -0.3}, 0.1}});
  const WindowAverage window = averager.average();
  EXPECT_NEAR(window.solidity_deviation[0], 0, 1e-15);
  EXPECT_NEAR(window.velocity_deviation[0], 0, 1e-15);
  EXPECT_NEAR(window.granular_temperature[0], 0, 1e-15);
}

}  // namespace
}  // namespace millfoam::averaging
