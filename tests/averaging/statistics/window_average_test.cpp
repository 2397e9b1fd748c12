// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/statistics/window_average.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "averaging/deposition/exact_box_deposition.hpp"
#include "averaging/files/solids_file.hpp"
#include "tests/averaging/test_support.hpp"

namespace millfoam::averaging {
namespace {

const BoxGrid unit_voxel({0, 0, 0}, {1, 1, 1}, {1, 1, 1});

void add(WindowMoments& moments, const std::vector<Particle>& particles) {
  ExactBoxDeposition deposition(unit_voxel);
  RecordSums sums;
  sum_record(deposition, {0, particles, {}}, 0, sums);
  moments.add(sums);
}

/// One voxel of 1 m^3. With V the volume of a ball of radius 0.1 m, the records hold
///   1: V at velocity (1, 0, 0);   2: a ball of radius 0.2, so 8 V, at (2, 0, 0);   3: nothing.
struct ThreeRecords : ::testing::Test {
  double v = sphere_volume(0.1);
  WindowAverage window;

  ThreeRecords() {
    WindowMoments moments(1);
    add(moments, {{1, {0.5, 0.5, 0.5}, {1, 0, 0}, 0.1}});
    add(moments, {{2, {0.5, 0.5, 0.5}, {2, 0, 0}, 0.2}});
    add(moments, {});
    window = average(moments, {});
  }
};

TEST_F(ThreeRecords, MeanSolidityCountsTheEmptyRecord) {
  EXPECT_EQ(window.time.records, 3);
  EXPECT_NEAR(window.mean.solidity[0], (v + 8 * v + 0) / 3, 1e-15);
}

TEST_F(ThreeRecords, NumberOfBallsIsAMeanOverTheRecords) {
  EXPECT_NEAR(window.number[0], 2.0 / 3, 1e-15);
}

TEST_F(ThreeRecords, BallsPerCellIsAMeanOverTheRecordsThatHaveAny) {
  EXPECT_NEAR(window.balls_per_cell, 1, 1e-15);
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

TEST(WindowAverage, OppositeVelocitiesInOneRecordAreTemperatureAndNotSpreadOfTheMean) {
  WindowMoments moments(1);
  add(moments, {{1, {0.3, 0.5, 0.5}, {0, 3, 0}, 0.1}, {2, {0.7, 0.5, 0.5}, {0, -3, 0}, 0.1}});
  const WindowAverage window = average(moments, {});
  EXPECT_NEAR(window.mean.velocity[1], 0, 1e-15);
  EXPECT_NEAR(window.granular_temperature[0], 9.0 / 3, 1e-14);
  EXPECT_NEAR(window.velocity_deviation[1], 0, 1e-15);
}

TEST(WindowAverage, UniformMotionHasNoSpread) {
  WindowMoments moments(1);
  for (int record = 0; record < 50; ++record) add(moments, {{1, {0.4, 0.5, 0.6}, {0.1, 0.2, -0.3}, 0.1}});
  const WindowAverage window = average(moments, {});
  EXPECT_NEAR(window.solidity_deviation[0], 0, 1e-15);
  EXPECT_NEAR(window.velocity_deviation[0], 0, 1e-15);
  EXPECT_NEAR(window.granular_temperature[0], 0, 1e-15);
}

/// Two voxels of 1 m^3 side by side, the first with 0.02 m^3 of balls at velocity 1, the second with 0.4 at
/// velocity 0, of which the walls leave `inside` to the first.
struct TwoVoxels : ::testing::Test {
  CellLimits limits{{1, 1}, {{0, 1}}, std::nullopt};

  WindowAverage average_of(double inside) {
    RecordSums sums;
    sums.cell_volumes = {inside, 1};
    sums.values.assign(2 * RecordSums::columns, 0.0);
    const std::array<double, 2> volume{0.02, 0.4};
    for (std::size_t cell = 0; cell < 2; ++cell) {
      sums.at(cell, RecordSums::volume) = volume[cell];
      sums.at(cell, RecordSums::momentum) = cell == 0 ? volume[cell] : 0;
      sums.at(cell, RecordSums::volume_over_diameter) = volume[cell] / 0.1;
      sums.at(cell, RecordSums::volume_times_diameter) = volume[cell] * 0.1;
    }
    sums.ledger = {0.42, 0.42, 0, 0};
    WindowMoments moments(2);
    moments.add(sums);
    return average(moments, limits);
  }
};

TEST_F(TwoVoxels, CutByAWallDivideByTheirVolumeInside) {
  const WindowAverage window = average_of(0.05);
  EXPECT_NEAR(window.mean.solidity[0], 0.02 / 0.05, 1e-15);
  EXPECT_NEAR(window.mean.inside_fraction[0], 0.05, 1e-15);
  EXPECT_EQ(window.mean.inside_fraction[1], 1);
  EXPECT_EQ(window.ledger.clipped, 0);
}

TEST_F(TwoVoxels, WithinTheWallGiveWhatReachesIntoThemToTheirNeighbours) {
  const WindowAverage window = average_of(0.001);
  EXPECT_EQ(window.mean.solidity[0], 0);
  EXPECT_NEAR(window.mean.solidity[1], 0.42, 1e-15);
  EXPECT_NEAR(window.mean.velocity[3], 0.02 / 0.42, 1e-15);
  EXPECT_NEAR(window.ledger.clipped, 0.02, 1e-15);
  EXPECT_NEAR(window.ledger.deposited, 0.42, 1e-15);
}

TEST_F(TwoVoxels, WithinTheWallAndFarFromAllOthersLoseWhatReachesIntoThem) {
  limits.neighbours.clear();
  const WindowAverage window = average_of(0.001);
  EXPECT_EQ(window.mean.solidity[0], 0);
  EXPECT_NEAR(window.mean.solidity[1], 0.4, 1e-15);
  EXPECT_EQ(window.ledger.clipped, 0);
  EXPECT_NEAR(window.ledger.deposited, 0.4, 1e-15);
  EXPECT_NEAR(window.ledger.outside, 0.02, 1e-15);
}

TEST_F(TwoVoxels, AboveACapGiveTheExcessToTheirNeighbours) {
  limits.solidity_cap = 0.3;
  const WindowAverage window = average_of(1);
  EXPECT_NEAR(window.mean.solidity[0], 0.12, 1e-15);
  EXPECT_NEAR(window.mean.solidity[1], 0.3, 1e-15);
  EXPECT_NEAR(window.mean.velocity[0], 0.02 / 0.12, 1e-15);
  EXPECT_NEAR(window.ledger.clipped, 0.1, 1e-15);
}

TEST_F(TwoVoxels, ACapThatLeavesNoRoomIsRefused) {
  limits.solidity_cap = 0.2;
  EXPECT_THROW(average_of(1), std::runtime_error);
}

TEST(WindowAverage, TailsOfSmoothingNearTheSmallestNumbersAreStoredAsEmptyCells) {
  const BoxGrid two_voxels({0, 0, 0}, {2, 1, 1}, {2, 1, 1});
  RecordSums record;
  record.cell_volumes = {1, 1};
  // A ball of 4 mm and 1 m/s in both; times the diameter, the volume in the second one is 0
  for (const double volume : {0.25, 5e-324})
    for (const double value : {volume, volume, 0.0, 0.0, volume / 0.004, volume * 0.004, volume, volume})
      record.values.push_back(value);
  ASSERT_EQ(record.values.size(), 2 * RecordSums::columns);
  WindowMoments moments(2);
  moments.add(record);
  WindowAverage window = average(moments, {});
  EXPECT_EQ(window.mean.solidity, (std::vector<double>{0.25, 0}));
  EXPECT_NEAR(window.mean.diameter43[0], 0.004, 1e-15);
  for (const double value : {window.mean.diameter[1], window.mean.diameter43[1], window.mean.velocity[3],
                             window.number[1], window.velocity_deviation[3]})
    EXPECT_EQ(value, 0);

  const TemporaryFolder folder;
  window.time.end = 1;
  SolidsHeader header;
  header.timestep = 1e-5;
  header.method = "exact";
  SolidsWriter writer(folder / "solids.h5", two_voxels, header);
  writer.append(window);
  writer.finish();
  EXPECT_EQ(SolidsReader(folder / "solids.h5").read_window(0).solidity, window.mean.solidity);
}

}  // namespace
}  // namespace millfoam::averaging
