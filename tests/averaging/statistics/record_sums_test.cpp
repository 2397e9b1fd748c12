// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/statistics/record_sums.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

#include "averaging/deposition/exact_box_deposition.hpp"
#include "tests/averaging/test_support.hpp"

namespace millfoam::averaging {
namespace {

TEST(RecordSums, HoldWhatAParticleBringsToItsCell) {
  ExactBoxDeposition deposition(BoxGrid({0, 0, 0}, {1, 1, 1}, {1, 1, 1}));
  const double v = sphere_volume(0.1);
  RecordSums sums;
  sum_record(deposition, {7, {{1, {0.5, 0.5, 0.5}, {1, 2, -3}, 0.1}}, {}}, 0, sums);
  EXPECT_NEAR(sums.at(0, RecordSums::volume) / v, 1, 1e-14);
  EXPECT_NEAR(sums.at(0, RecordSums::momentum + 2) / (-3 * v), 1, 1e-14);
  EXPECT_NEAR(sums.at(0, RecordSums::volume_over_diameter) / (v / 0.2), 1, 1e-14);
  EXPECT_NEAR(sums.at(0, RecordSums::volume_times_diameter) / (v * 0.2), 1, 1e-14);
  EXPECT_NEAR(sums.at(0, RecordSums::volume_times_speed2) / (14 * v), 1, 1e-14);
  EXPECT_NEAR(sums.at(0, RecordSums::balls), 1, 1e-14);
  EXPECT_EQ(sums.cell_volumes[0], 1);
}

TEST(RecordSums, LedgerAndCellsHoldAllOfTheVolume) {
  ExactBoxDeposition deposition(BoxGrid({-1, -1, -1}, {1, 1, 1}, {9, 8, 7}));
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-1.4, 1.4), radius(0.01, 0.5);
  ParticleRecord record;
  double volume = 0;
  for (int p = 0; p < 500; ++p) {
    record.particles.push_back({p, {place(random), place(random), place(random)}, {}, radius(random)});
    volume += sphere_volume(record.particles.back().radius);
  }
  RecordSums sums;
  sum_record(deposition, record, 0, sums);
  double in_cells = 0;
  for (std::size_t c = 0; c < sums.cells(); ++c) in_cells += sums.at(c, RecordSums::volume);
  EXPECT_GT(sums.ledger.outside, 0.1 * volume);
  EXPECT_NEAR(sums.ledger.volume_in / volume, 1, 1e-12);
  EXPECT_NEAR(in_cells / sums.ledger.deposited, 1, 1e-12);
  EXPECT_NEAR((sums.ledger.deposited + sums.ledger.outside) / volume, 1, 1e-12);
}

TEST(RecordSums, OfASuperquadricUseTheSphereOfItsVolume) {
  ExactBoxDeposition deposition(BoxGrid({-1, -1, -1}, {1, 1, 1}, {1, 1, 1}));
  ParticleRecord record{0, {{1, {0, 0, 0}, {}, 0.4}}, {Superquadric{{0.1, 0.2, 0.4}}}};
  RecordSums sums;
  sum_record(deposition, record, 0, sums);
  const double v = 4.0 / 3.0 * pi * 0.1 * 0.2 * 0.4;
  EXPECT_NEAR(sums.ledger.volume_in / v, 1, 1e-12);
  EXPECT_NEAR(sums.at(0, RecordSums::volume_times_diameter) / (v * 0.4), 1, 1e-12);
}

}  // namespace
}  // namespace millfoam::averaging
