// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/statistics/window_moments.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace millfoam::averaging {
namespace {

constexpr std::size_t cells = 5;

/// A record of made-up sums; now and then a cell is empty.
RecordSums random_record(std::mt19937& random) {
  std::uniform_real_distribution<double> number(0, 1);
  RecordSums record;
  for (std::size_t c = 0; c < cells; ++c) {
    record.cell_volumes.push_back(1 + number(random));
    const bool empty = number(random) < 0.2;
    for (std::size_t k = 0; k < RecordSums::columns; ++k) record.values.push_back(empty ? 0 : number(random));
  }
  record.ledger = {number(random), number(random), number(random), 0};
  return record;
}

std::vector<RecordSums> random_records(int count) {
  std::mt19937 random(3);
  std::vector<RecordSums> records;
  for (int r = 0; r < count; ++r) records.push_back(random_record(random));
  return records;
}

WindowMoments moments_of(const std::vector<RecordSums>& records, std::size_t first, std::size_t last) {
  WindowMoments moments(cells);
  for (std::size_t r = first; r < last; ++r) moments.add(records[r]);
  return moments;
}

TEST(WindowMoments, SpreadsAreThoseOfTheTwoPassFormulas) {
  const auto records = random_records(40);
  const WindowMoments moments = moments_of(records, 0, 40);
  for (std::size_t c = 0; c < cells; ++c) {
    double mean = 0, squares = 0, volume = 0, momentum = 0, velocity_squares = 0;
    for (const RecordSums& r : records) {
      mean += r.at(c, RecordSums::volume) / r.cell_volumes[c] / 40;
      volume += r.at(c, RecordSums::volume);
      momentum += r.at(c, RecordSums::momentum);
    }
    for (const RecordSums& r : records) {
      const double v = r.at(c, RecordSums::volume);
      squares += std::pow(v / r.cell_volumes[c] - mean, 2) / 40;
      if (v > 0) velocity_squares += v * std::pow(r.at(c, RecordSums::momentum) / v - momentum / volume, 2);
    }
    EXPECT_NEAR(moments.solidity_variance(c), squares, 1e-14);
    EXPECT_NEAR(moments.velocity_variance(c, 0), velocity_squares / volume,
                1e-12 * velocity_squares / volume);
  }
}

TEST(WindowMoments, MergedAreThoseOfAllRecordsTogether) {
  const auto records = random_records(37);
  const WindowMoments whole = moments_of(records, 0, 37);
  WindowMoments merged(cells);
  for (const auto& [first, last] : {std::pair<std::size_t, std::size_t>{0, 1}, {1, 16}, {16, 16}, {16, 37}}) {
    merged.merge(moments_of(records, first, last));
  }
  EXPECT_EQ(merged.records(), 37);
  EXPECT_EQ(merged.occupied(), whole.occupied());
  EXPECT_NEAR(merged.balls(), whole.balls(), 1e-12);
  EXPECT_NEAR(merged.ledger().volume_in, whole.ledger().volume_in, 1e-13);
  for (std::size_t c = 0; c < cells; ++c) {
    EXPECT_NEAR(merged.cell_volume(c), whole.cell_volume(c), 1e-13);
    EXPECT_NEAR(merged.solidity_variance(c), whole.solidity_variance(c), 1e-15);
    for (std::size_t a = 0; a < 3; ++a) {
      EXPECT_NEAR(merged.velocity_variance(c, a) / whole.velocity_variance(c, a), 1, 1e-12);
    }
    for (std::size_t k = 0; k < RecordSums::columns; ++k)
      EXPECT_NEAR(merged.sum(c, k), whole.sum(c, k), 1e-13);
  }
}

TEST(WindowMoments, PackedAndUnpackedAreTheSameToTheLastBit) {
  const WindowMoments moments = moments_of(random_records(7), 0, 7);
  WindowMoments back(cells);
  back.unpack(moments.packed());
  EXPECT_EQ(back.packed(), moments.packed());
  EXPECT_EQ(moments.packed().size(), WindowMoments::packed_size(cells));
  EXPECT_EQ(back.records(), 7);
}

TEST(WindowMoments, ClearedStartAfresh) {
  const auto records = random_records(9);
  WindowMoments moments = moments_of(records, 0, 5);
  moments.clear();
  for (std::size_t r = 5; r < 9; ++r) moments.add(records[r]);
  EXPECT_EQ(moments.packed(), moments_of(records, 5, 9).packed());
}

TEST(WindowMoments, CellsThatOnlyTailsOfSmoothingReachAreNotOccupied) {
  RecordSums record;
  record.cell_volumes.assign(cells, 0.5);
  record.values.assign(cells * RecordSums::columns, 0.0);
  const std::vector<double> solidities{0.3, 2e-6, 1e-7, 1e-40, 0};
  for (std::size_t c = 0; c < cells; ++c) {
    record.at(c, RecordSums::volume) = 0.5 * solidities[c];
    record.at(c, RecordSums::balls) = 10 * solidities[c];
  }
  WindowMoments moments(cells);
  moments.add(record);
  EXPECT_EQ(moments.occupied(), 2);
  EXPECT_DOUBLE_EQ(moments.balls(), 10 * (0.3 + 2e-6 + 1e-7)) << "all balls are counted";
}

}  // namespace
}  // namespace millfoam::averaging
