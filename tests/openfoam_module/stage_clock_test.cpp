// SPDX-License-Identifier: GPL-3.0-or-later
#include "openfoam_module/record/stage_clock.hpp"

#include <gtest/gtest.h>

#include <thread>

namespace millfoam::record {
namespace {

void wait() {
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
}

TEST(StageClock, has_no_times_before_a_stage_begins) {
  EXPECT_TRUE(StageClock().times().empty());
}

TEST(StageClock, adds_up_the_runs_of_a_stage) {
  const auto begin = std::chrono::steady_clock::now();
  StageClock clock;
  clock.begin("mesh");
  wait();
  clock.begin("surface");
  clock.begin("mesh");
  wait();
  const StageClock::Times times = clock.times();
  const double all = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();

  ASSERT_EQ(times.size(), 2U);
  EXPECT_EQ(times[0].first, "mesh");
  EXPECT_EQ(times[1].first, "surface");
  // What runs counts too, and what has ended does not
  EXPECT_GE(times[0].second, 0.04);
  EXPECT_LE(times[0].second + times[1].second, all);
}

}  // namespace
}  // namespace millfoam::record
