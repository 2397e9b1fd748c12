// SPDX-License-Identifier: GPL-3.0-or-later
// What LIGGGHTS leaves in dem/ after a run that was killed once and resumed.
#include "dem_driver/results.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iomanip>
#include <sstream>
#include <string>
#include <vector>

#include "dem_driver/deck_outputs.hpp"
#include "dem_driver/segments.hpp"
#include "small_mill.hpp"

namespace millfoam::dem_driver {
namespace {

using tests::message_of;
using tests::TemporaryFolder;

class ResultsTest : public ::testing::Test {
 protected:
  ResultsTest() {
    std::filesystem::create_directories(folder_.dem());
    std::filesystem::create_directories(folder_.dumps());
  }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_.root / name) << text;
  }
  /// A histogram at `step` with `counts` in its first bins.
  static std::string histogram(long step, const std::vector<int>& counts, int beyond, double largest) {
    int sum = 0;
    for (const int count : counts) sum += count;
    std::ostringstream text;
    text << step << ' ' << overlap_bins << ' ' << sum << ' ' << beyond << " 0 " << largest << '\n';
    for (int bin = 0; bin < overlap_bins; ++bin)
      text << bin + 1 << " 0 " << (bin < static_cast<int>(counts.size()) ? counts[bin] : 0) << " 0\n";
    return text.str();
  }

  TemporaryFolder temporary_;
  CaseFolder folder_{temporary_.path()};
};

TEST_F(ResultsTest, TheHistoryIsWithoutWhatTheKilledRunWroteAfterItsLastRestartFile) {
  write("dem/torque.0.txt", "# comment\n10 1\n20 2\n30 99\n");
  write("dem/torque.20.txt", "30 3\n40 4\n");
  write("dem/energy.0.txt", "0 0.5 0\n10 1 -1\n20 2 -2\n30 99 99\n");
  write("dem/energy.20.txt", "20 2 -2\n30 3 -3\n40 4 -4\n");
  const auto history = read_history(folder_);
  ASSERT_EQ(history.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    const auto n = static_cast<double>(i + 1);
    EXPECT_EQ(history[i].step, static_cast<long>(10 * (i + 1)));
    EXPECT_EQ(history[i].torque, n);
    EXPECT_EQ(history[i].kinetic, n);
    EXPECT_EQ(history[i].potential, -n);
  }
}

TEST_F(ResultsTest, AHalfLineAtTheEndOfAKilledRunIsLeftOut) {
  write("dem/torque.0.txt", "10 1\n20 0.12");
  write("dem/energy.0.txt", "0 1 1\n10 1 1\n");
  EXPECT_EQ(read_history(folder_).size(), 1u);
}

TEST_F(ResultsTest, AWordThatIsNoNumberIsRefusedWithFileAndLine) {
  write("dem/torque.0.txt", "10 1\n20 torque\n");
  const std::string message = message_of([&] { read_history(folder_); });
  EXPECT_NE(message.find("torque.0.txt:2"), std::string::npos) << message;
}

TEST_F(ResultsTest, ALineWithANumberTooManyIsRefusedWithFileAndLine) {
  write("dem/torque.0.txt", "10 1 2\n");
  const std::string message = message_of([&] { read_history(folder_); });
  EXPECT_NE(message.find("torque.0.txt:1: 3 numbers, expected 2"), std::string::npos) << message;
}

TEST_F(ResultsTest, ATorqueWithoutItsEnergiesIsRefusedAndSoAreEnergiesWithoutTheirTorque) {
  write("dem/torque.0.txt", "10 1\n20 2\n30 3\n");
  write("dem/energy.0.txt", "0 1 1\n10 1 1\n30 1 1\n");
  EXPECT_EQ(
      message_of([&] { read_history(folder_); }),
      (folder_.dem() / "torque.0.txt").string() + ":2: no row of step 20 in energy.*.txt, expected one");
  write("dem/torque.0.txt", "20 2\n");
  write("dem/energy.0.txt", "0 1 1\n10 1 1\n20 1 1\n");
  EXPECT_EQ(
      message_of([&] { read_history(folder_); }),
      (folder_.dem() / "energy.0.txt").string() + ":2: no row of step 10 in torque.*.txt, expected one");
}

TEST_F(ResultsTest, RecordsThatAreMissingAreCounted) {
  write("dem/torque.0.txt", "10 1\n20 2\n");
  write("dem/energy.0.txt", "0 1 1\n10 1 1\n20 1 1\n");
  const auto mill = tests::small_mill();
  const std::string message = message_of([&] { gather_results(folder_, mill, plan_dem(mill), {}); });
  EXPECT_NE(message.find("dem: 2 records of torque and energy, expected 30"), std::string::npos) << message;
}

TEST_F(ResultsTest, OverlapsOfAllHistogramsAreAddedUp) {
  write("dem/ballOverlaps.0.txt", histogram(10, {60, 30}, 0, 3e-6) + histogram(20, {1000}, 0, 1));
  write("dem/ballOverlaps.10.txt", histogram(20, {0, 5, 4}, 1, 9e-4));
  const auto statistics = read_overlaps(folder_, "ballOverlaps", 0.01);
  EXPECT_EQ(statistics.bin_width, 2e-6);
  EXPECT_EQ(statistics.samples, 100);
  EXPECT_EQ(statistics.largest, 9e-4);
  EXPECT_EQ(statistics.percentile(0.6), 2e-6);
  EXPECT_EQ(statistics.percentile(0.9), 4e-6);
  EXPECT_EQ(statistics.percentile(0.99), 6e-6);
  EXPECT_EQ(statistics.percentile(1), 9e-4);
}

TEST_F(ResultsTest, OverlapsOfTheStepFromWhichARunResumesAreCountedOnce) {
  write("dem/ballOverlaps.0.txt", histogram(0, {1}, 0, 1e-6) + histogram(10, {60, 30}, 0, 3e-6));
  write("dem/ballOverlaps.10.txt", histogram(10, {60, 30}, 0, 3e-6) + histogram(20, {0, 5}, 0, 4e-6));
  EXPECT_EQ(read_overlaps(folder_, "ballOverlaps", 0.01).samples, 96);
}

TEST_F(ResultsTest, ARunWithoutContactsHasNoOverlap) {
  write("dem/wallOverlaps.0.txt", "10 1000 0 0 1e20 -1e20\n");
  EXPECT_EQ(read_overlaps(folder_, "wallOverlaps", 0.01).percentile(0.99), 0);
}

TEST(PrintedResults, SayWhatWasMadeAndWhetherItIsSteady) {
  DemPlan plan = plan_dem(tests::small_mill());
  Results results;
  results.balls = 250;
  results.run.balls = 247;
  results.run.wall_time = 12.5;
  results.run.dumps = 31;
  results.resting_speed = 0.0125;
  results.power = std::vector<double>(30, 0.5);
  for (std::size_t i = 0; i < 30; ++i) results.time.push_back(0.01 * static_cast<double>(i + 1));
  results.power_steadiness = {true, 4, 0.5, 0.002, 0};
  results.kinetic_steadiness = {true, 9, 1e-4, 1e-6, 0};
  results.potential_steadiness = {true, 2, -2e-3, 1e-6, 0};
  results.ball_overlaps = {{0, 99, 1}, 2e-6, 100, 5.5e-6};
  const auto printed = [&] {
    std::ostringstream out;
    print_results(out, plan, results);
    return out.str();
  };
  const auto expect_line = [&](const std::string& line) {
    EXPECT_NE(printed().find(line + '\n'), std::string::npos) << printed();
  };
  const double million = 250e-6 * static_cast<double>(plan.total_steps()) / 12.5;
  std::ostringstream speed;
  speed << std::setprecision(4) << "done: 250 balls, 3 lost, " << plan.total_steps() << " steps of "
        << 1e6 * plan.step.value << " us in 12.5 s (" << million << " million particle-steps per second)";
  expect_line(speed.str());
  expect_line("charge at DEM time 0: rms speed 0.0125 m/s");
  expect_line("power 0.5 +- 0.002 W, kinetic energy 0.0001 J, potential energy -0.002 J");
  expect_line("steady from 0.1 s of DEM time on");
  expect_line("overlap of two balls: 99 % below 4 um, largest 5.5 um, 0.275 % of the smallest diameter");
  expect_line("overlap of balls and walls: no contact was counted");
  expect_line("31 dumps, one every " + std::to_string(plan.step.steps_per_record) + " steps");

  results.potential_steadiness.steady = false;
  results.power_steadiness.standard_error = std::nan("");
  plan.dumps = 0;
  expect_line("power 0.5 W, kinetic energy 0.0001 J, potential energy -0.002 J");
  expect_line("NOT STEADY: power, kinetic or potential energy still change; raise dem.duration");
  expect_line("no dumps (dem.dumps: no), " + std::to_string(plan.records) + " records, one every " +
              std::to_string(plan.step.steps_per_record) + " steps");
}

TEST_F(ResultsTest, OnlyWholeRestartFilesAreFoundInTheOrderOfTheirSteps) {
  for (const char* name : {"restart.900", "restart.1000", "restart.part", "restart.10x", "in.mill"})
    write(std::string("dem/") + name, "x");
  const auto restarts = find_restarts(folder_);
  ASSERT_EQ(restarts.size(), 2u);
  EXPECT_EQ(restarts.back().step, 1000);
  remove_restarts_before(folder_, 1000);
  EXPECT_EQ(find_restarts(folder_).size(), 1u);
}

TEST_F(ResultsTest, DumpsAfterTheRestartFileAreRemovedAndNoOthers) {
  for (const char* name : {"dump.90.txt", "dump.100.txt", "dump.110.txt", "dump.x.txt"})
    write(std::string("dumps/") + name, "x");
  remove_dumps_after(folder_, 100);
  EXPECT_TRUE(std::filesystem::exists(folder_.dumps() / "dump.90.txt"));
  EXPECT_TRUE(std::filesystem::exists(folder_.dumps() / "dump.100.txt"));
  EXPECT_FALSE(std::filesystem::exists(folder_.dumps() / "dump.110.txt"));
  EXPECT_TRUE(std::filesystem::exists(folder_.dumps() / "dump.x.txt"));
}

}  // namespace
}  // namespace millfoam::dem_driver
