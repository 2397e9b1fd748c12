// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/forecast.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <utility>

#include "dem_driver/deck.hpp"
#include "dem_driver/deck_outputs.hpp"
#include "meshing/mill/mill_charge.hpp"
#include "small_mill.hpp"

namespace millfoam::dem_driver {
namespace {

using tests::small_mill;

/// The small mill, twenty times as long and with as many more balls.
meshing::Mill long_mill() {
  auto mill = small_mill();
  mill.geometry.length *= 20;
  mill.charge.start_length *= 20;
  for (auto& size : mill.charge.classes) size.mass *= 20;
  return mill;
}

TEST(Forecast, TheTrialIsAPeriodicSliceOfAboutThreeThousandBalls) {
  auto mill = long_mill();
  mill.geometry.ends = meshing::Ends::plain;
  mill.geometry.grates.emplace();
  const auto trial = trial_mill(mill, 1);
  EXPECT_EQ(trial.geometry.ends, meshing::Ends::periodic);
  EXPECT_FALSE(trial.geometry.grates);
  EXPECT_NEAR(static_cast<double>(plan_charge(trial).balls()), trial_balls, 2);
  EXPECT_NEAR(trial.geometry.length / mill.geometry.length, trial_balls / 5000, 1e-3);
}

TEST(Forecast, TheTrialOfASmallMillIsTheMillItself) {
  const auto trial = trial_mill(small_mill(), 1);
  EXPECT_EQ(trial.geometry.length, small_mill().geometry.length);
  EXPECT_EQ(plan_charge(trial).balls(), 250);
}

TEST(Forecast, TheTrialOfAShortMillWithEndsIsAsLongAsAPeriodicMillMustBe) {
  auto mill = small_mill();
  mill.geometry.ends = meshing::Ends::plain;
  mill.geometry.length = 0.004;
  mill.charge.start_length = 0.0039;
  for (auto& size : mill.charge.classes) size.mass /= 3;
  // Balls of up to 3 mm
  EXPECT_DOUBLE_EQ(trial_mill(mill, 1).geometry.length, 0.006);
}

TEST(Forecast, TheTrialIsLongEnoughToBeSplitAsTheMillIs) {
  const auto mill = long_mill();
  const auto trial = trial_mill(mill, 40);
  EXPECT_EQ(split_ranks(40, mill.geometry.length, 0.003).z, 40);
  EXPECT_EQ(split_ranks(40, trial.geometry.length, 0.003).z, 40);
}

TEST(Forecast, AClassOfOneBallIsInTheTrialToo) {
  auto mill = long_mill();
  mill.charge.classes.push_back({0.004, meshing::ball_mass(mill, 0.004)});
  const auto trial = trial_mill(mill, 1);
  ASSERT_LT(trial.geometry.length, 0.7 * mill.geometry.length);
  EXPECT_EQ(plan_charge(trial).classes.front().count, 1);
  EXPECT_EQ(plan_charge(trial).classes.front().diameter, 0.004);
}

/// 8000 blunt balls of 1 mm in a stirred mill.
meshing::Mill shaped_stirred_mill() {
  auto mill = small_mill();
  mill.geometry.ends = meshing::Ends::plain;
  mill.geometry.length = 0.2;
  mill.geometry.impeller =
      meshing::Impeller{0.008, 0.004, {{0.012, 0.03, 0.004, 0, 2}}, {{0.02, 0.028, 0.002}}};
  mill.charge.start_radius = 0.0195;
  mill.charge.start_core = 0.0045;
  mill.charge.start_bottom = 0.0215;
  mill.charge.start_length = 0.17;
  mill.charge.classes = {
      {0.001, 8000 * meshing::ball_mass(mill, 0.001), meshing::scaled_to({{1.5, 1, 1}, 4}, 0.001)}};
  mill.dem.curvature_limit = 10;
  return mill;
}

TEST(Forecast, TheTrialOfAStirredMillWithShapesIsAnEighthOfItWithTheSameSpeedOfTheTips) {
  const auto mill = shaped_stirred_mill();
  const auto trial = trial_mill(mill, 1);
  EXPECT_EQ(plan_charge(trial).balls(), trial_shaped_balls);
  const auto &whole = *mill.geometry.impeller, &half = *trial.geometry.impeller;
  for (const auto& [one, other] : {std::pair{trial.geometry.diameter, mill.geometry.diameter},
                                   {trial.geometry.length, mill.geometry.length},
                                   {half.shaft_diameter, whole.shaft_diameter},
                                   {half.shaft_end, whole.shaft_end},
                                   {half.pins[0].height, whole.pins[0].height},
                                   {half.pins[0].length, whole.pins[0].length},
                                   {half.pins[0].thickness, whole.pins[0].thickness},
                                   {half.discs[0].height, whole.discs[0].height},
                                   {half.discs[0].diameter, whole.discs[0].diameter},
                                   {half.discs[0].thickness, whole.discs[0].thickness},
                                   {trial.charge.start_bottom, mill.charge.start_bottom}})
    EXPECT_NEAR(one, other / 2, 1e-12);
  EXPECT_NEAR(trial.angular_velocity, 2 * mill.angular_velocity, 1e-12);
  EXPECT_EQ(trial.charge.classes[0].diameter, 0.001);
}

TEST(Forecast, TheTrialOfAStirredMillWithSpheresIsTheMillItself) {
  auto mill = shaped_stirred_mill();
  mill.charge.classes[0].shape.reset();
  const auto trial = trial_mill(mill, 1);
  EXPECT_EQ(trial.geometry.diameter, mill.geometry.diameter);
  EXPECT_EQ(plan_charge(trial).balls(), 8000);
}

TEST(Forecast, TheTrialSliceOfATumblingMillHasFewerBallsOfOtherShapes) {
  auto mill = long_mill();
  for (auto& size : mill.charge.classes) size.shape = meshing::scaled_to({{1.5, 1, 1}, 4}, size.diameter);
  mill.dem.curvature_limit = 10;
  EXPECT_NEAR(static_cast<double>(plan_charge(trial_mill(mill, 1)).balls()), trial_shaped_balls, 2);
}

TEST(Forecast, ATrialThatFailsLeavesTheLogThatItNames) {
  const tests::TemporaryFolder temporary;
  const tests::Variable folder("TMPDIR", temporary.path());
  for (const char* program : {"liggghts", "mpirun"})
    tests::write_script(temporary.path() / program, tests::refusal_of_open_mpi);
  const tests::Variable path("PATH", temporary.path().string() + ":" + std::getenv("PATH"));
  const tests::Variable liggghts("MILLFOAM_LIGGGHTS", (temporary.path() / "liggghts").string());
  auto mill = small_mill();
  mill.resolution = {0.002, 2};
  const std::string message = tests::message_of([&] { measure_cost(mill, 64); });
  EXPECT_NE(message.find("on 64 ranks"), std::string::npos) << message;
  EXPECT_NE(message.find("There are not enough slots"), std::string::npos) << message;
  const auto begin = message.find("log: ") + 5;
  const std::string log = message.substr(begin, message.find(',', begin) - begin);
  EXPECT_TRUE(std::filesystem::is_regular_file(log)) << message;
}

TEST(Forecast, TheTrialHasSoftBallsHoweverHardTheMillsAre) {
  auto mill = long_mill();
  mill.dem.youngs_modulus = 1e10;
  EXPECT_LT(plan_dem(trial_mill(mill, 1)).total_steps(), 30000);
}

TEST(Forecast, WallTimeIsBallsTimesStepsOverTheRateRoundByRound) {
  auto mill = small_mill();
  for (auto& size : mill.charge.classes) size.mass *= 2;
  const DemPlan plan = plan_dem(mill);
  ASSERT_EQ(plan.charge.rounds.size(), 3u);
  const auto balls_of = [&](std::size_t round) {
    double sum = 0;
    for (const auto& insertion : plan.charge.rounds[round]) sum += static_cast<double>(insertion.count);
    return sum;
  };
  const double work = (2 * balls_of(0) + balls_of(1)) * static_cast<double>(plan.round_steps) +
                      500.0 * static_cast<double>(plan.settle_steps + plan.turning_steps);
  const Forecast result = forecast(plan, {1e5, 80, 5e7}, 2);
  EXPECT_NEAR(result.wall_time / (work / 1e5), 1, 1e-12);
  EXPECT_EQ(result.steps, plan.total_steps());
  EXPECT_NEAR(result.memory, 2 * 5e7 + 500 * 2000.0, 1);
}

TEST(Forecast, DiskIsThatOfTheDumpsAndWhatStandsBesideThem) {
  const DemPlan plan = plan_dem(small_mill());
  const double dumps = 250.0 * 80 * 31;
  const double disk = forecast(plan, {1e5, 80, 5e7}, 1).disk;
  EXPECT_GT(disk, dumps);
  EXPECT_LT(disk, dumps + 250 * 1000 + 3 * 2 * overlap_bins * 20);
}

TEST(Forecast, ContactsAddToTheDiskAndTheTrialWritesThemAsOftenAsTheMill) {
  auto mill = small_mill();
  mill.dem.contact_interval = 50.0 * plan_dem(mill).step.value;
  const DemPlan plan = plan_dem(mill);
  const double without = forecast(plan, {1e5, 80, 5e7, 0}, 1).disk;
  const double with = forecast(plan, {1e5, 80, 5e7, 300}, 1).disk;
  EXPECT_NEAR((with - without) / (250.0 * 300 * static_cast<double>(plan.contact_dumps)), 1, 1e-12);
  EXPECT_EQ(plan_dem(trial_mill(mill, 1)).contact_steps, 50);
  mill.dem.contact_interval = plan_dem(mill).step.value;
  EXPECT_EQ(plan_dem(trial_mill(mill, 1)).contact_dumps, 201);
  EXPECT_EQ(plan_dem(trial_mill(small_mill(), 1)).contact_steps, 0);
}

TEST(Forecast, ItIsPrintedInHoursAndMinutesOrInSeconds) {
  Forecast result;
  result.wall_time = 2 * 3600 + 5 * 60;
  std::ostringstream hours;
  print_forecast(hours, result, {2e6, 80, 5e7}, 2);
  EXPECT_NE(hours.str().find("wall time  2 h 05 min"), std::string::npos) << hours.str();
  result.wall_time = 42;
  std::ostringstream seconds;
  print_forecast(seconds, result, {2e6, 80, 5e7}, 2);
  EXPECT_NE(seconds.str().find("wall time  42 s"), std::string::npos) << seconds.str();
}

}  // namespace
}  // namespace millfoam::dem_driver
