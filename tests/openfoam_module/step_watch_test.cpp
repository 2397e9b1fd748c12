// SPDX-License-Identifier: GPL-3.0-or-later
#include "openfoam_module/record/step_watch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace millfoam::record {
namespace {

TEST(StepWatch, has_the_median_of_all_steps) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> share(1, 2);
  StepWatch watch;
  std::vector<double> steps;
  EXPECT_EQ(watch.median(), 0);
  for (int i = 0; i < 1000; ++i) {
    steps.push_back(1e-3 * share(random));
    EXPECT_EQ(watch.add(steps.back()), StepLength::usual);
    std::vector<double> sorted(steps);
    std::sort(sorted.begin(), sorted.end());
    ASSERT_EQ(watch.median(), sorted[sorted.size() / 2]) << "after " << steps.size() << " steps";
  }
}

TEST(StepWatch, names_the_first_of_several_short_steps) {
  StepWatch watch;
  for (const double usual : {1e-3, 1e-3, 1.2e-3}) EXPECT_EQ(watch.add(usual), StepLength::usual);
  EXPECT_EQ(watch.add(1.01e-3 / 20), StepLength::usual);
  EXPECT_EQ(watch.add(0.99e-3 / 20), StepLength::begins_short);
  EXPECT_EQ(watch.add(0.99e-3 / 20), StepLength::stays_short);
  EXPECT_EQ(watch.add(1e-3), StepLength::usual);
  EXPECT_EQ(watch.add(0.99e-3 / 20), StepLength::begins_short);
}

TEST(StepWatch, knows_a_step_of_a_flow_that_diverges) {
  StepWatch watch;
  EXPECT_EQ(watch.add(1e-3), StepLength::usual);
  EXPECT_EQ(watch.add(1.01e-9), StepLength::begins_short);
  EXPECT_EQ(watch.add(1e-3), StepLength::usual);
  EXPECT_EQ(watch.add(0.99e-9), StepLength::diverged);
  EXPECT_EQ(watch.add(0), StepLength::diverged);
  EXPECT_EQ(watch.add(std::nan("")), StepLength::diverged);
  // They do not count
  EXPECT_EQ(watch.median(), 1e-3);
  EXPECT_EQ(StepWatch().add(0), StepLength::diverged);
}

}  // namespace
}  // namespace millfoam::record
