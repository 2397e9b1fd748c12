// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/progress.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <sstream>
#include <string>
#include <thread>

namespace millfoam::dem_driver {
namespace {

/// The time left of a line `… , M:SS left`, s.
int seconds_left(const std::string& line) {
  const auto colon = line.rfind(':');
  const auto begin = line.rfind(' ', colon) + 1;
  return 60 * std::stoi(line.substr(begin, colon - begin)) + std::stoi(line.substr(colon + 1, 2));
}

TEST(Progress, WhatAResumedRunHadDoneBeforeMakesItNoFaster) {
  std::ostringstream out;
  Progress progress(out, false, 100);
  progress.show(50, "begun again");
  EXPECT_EQ(out.str(), "50 %, begun again\n");
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  out.str("");
  progress.show(60, "on its way");
  EXPECT_GE(seconds_left(out.str()), 1) << out.str();
}

TEST(Progress, ALineIsForTenPercentUnlessOnATerminal) {
  std::ostringstream out, terminal;
  Progress lines(out, false, 1000), bar(terminal, true, 1000);
  for (int step = 0; step <= 200; ++step) {
    lines.show(step, "x");
    bar.show(step, "x");
  }
  bar.end();
  const auto count = [](const std::string& text, char what) {
    return std::count(text.begin(), text.end(), what);
  };
  EXPECT_EQ(count(out.str(), '\n'), 3);
  EXPECT_EQ(count(terminal.str(), '\r'), 21);
  EXPECT_EQ(count(terminal.str(), '\n'), 1);
}

}  // namespace
}  // namespace millfoam::dem_driver
