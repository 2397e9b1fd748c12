// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/run/record_blocks.hpp"

#include <gtest/gtest.h>

namespace millfoam::averaging {
namespace {

using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;

Pairs cut(const std::vector<WindowPlan>& plans, std::size_t largest) {
  Pairs pairs;
  for (const RecordBlock& block : plan_blocks(plans, largest)) pairs.emplace_back(block.first, block.last);
  return pairs;
}

WindowPlan plan(const Pairs& first_and_count) {
  WindowPlan result;
  for (const auto& [first, count] : first_and_count) result.windows.push_back({0, 0, first, count});
  return result;
}

TEST(RecordBlocks, AreCutWhereAnyWindowBeginsOrEnds) {
  EXPECT_EQ(cut({plan({{0, 4}, {4, 4}}), plan({{2, 6}})}, 100), (Pairs{{0, 2}, {2, 4}, {4, 8}}));
}

TEST(RecordBlocks, AreNoLargerThanAskedAndAboutEqual) {
  EXPECT_EQ(cut({plan({{3, 7}})}, 3), (Pairs{{3, 5}, {5, 7}, {7, 10}}));
}

TEST(RecordBlocks, LeaveOutRecordsThatNoWindowHolds) {
  EXPECT_EQ(cut({plan({{1, 2}, {5, 2}})}, 100), (Pairs{{1, 3}, {5, 7}}));
}

}  // namespace
}  // namespace millfoam::averaging
