// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/deposition/box_deposition.hpp"

#include <gtest/gtest.h>

#include "averaging/deposition/exact_box_deposition.hpp"
#include "averaging/deposition/sampled_box_deposition.hpp"
#include "tests/averaging/deposition/deposition_support.hpp"

namespace millfoam::averaging {
namespace {

TEST(BoxDeposition, CellsHaveTheVoxelsVolume) {
  const BoxGrid grid({0, 0, 0}, {1, 2, 3}, {2, 2, 2});
  EXPECT_EQ(ExactBoxDeposition(grid).volumes(), std::vector<double>(8, 0.75));
  EXPECT_EQ(SampledBoxDeposition(grid).volumes(), std::vector<double>(8, 0.75));
}

TEST(BoxDeposition, ACloneDepositsAlike) {
  ExactBoxDeposition exact(BoxGrid({-1, -1, -1}, {1, 1, 1}, {4, 4, 4}));
  SampledBoxDeposition sampling(BoxGrid({-1, -1, -1}, {1, 1, 1}, {4, 4, 4}), 7);
  const Particle ball{1, {0.1, -0.2, 0.3}, {}, 0.6};
  EXPECT_EQ(deposited(*exact.clone(), ball), deposited(exact, ball));
  EXPECT_EQ(deposited(*sampling.clone(), ball), deposited(sampling, ball));
}

}  // namespace
}  // namespace millfoam::averaging
