// SPDX-License-Identifier: GPL-3.0-or-later
// What the driver does for a run with a fluid, and for one that continues another, without LIGGGHTS.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "dem_driver/continued_run.hpp"
#include "dem_driver/deck.hpp"
#include "dem_driver/fluid_check.hpp"
#include "dem_driver/fluid_ledger.hpp"
#include "dem_driver/fluid_settings.hpp"
#include "dem_driver/liggghts_log.hpp"
#include "dem_driver/results.hpp"
#include "slurry_writer.hpp"
#include "small_mill.hpp"

namespace millfoam::dem_driver {
namespace {

using tests::FlowAtPoint;
using tests::message_of;
using tests::small_mill;
using tests::TemporaryFolder;

struct FluidRun : ::testing::Test {
  TemporaryFolder temporary;
  CaseFolder folder{temporary.path() / "case"};
  std::filesystem::path slurry = temporary.path() / "slurry.h5";

  static std::string deck(const DemPlan& plan) {
    std::ostringstream out;
    write_deck(out, small_mill(), plan, {"shell"}, 1);
    return out.str();
  }
};

/// A flow over the small mill, which is periodic.
tests::SlurryContent flow_of_small_mill(double exchange) {
  const auto flow = [exchange](const Vector& x) {
    FlowAtPoint at;
    at.exchange = x[0] > 0 ? exchange : 0;
    at.diameter = 0.002;
    at.solidity = 0.5;
    return at;
  };
  return {averaging::BoxGrid({-0.02, -0.02, 0}, {0.02, 0.02, 0.012}, {4, 4, 2}, {false, false, true}),
          {flow},
          flow};
}

TEST_F(FluidRun, SettingsAreReadBackFromTheirFileAndFindSlurryFromItsFolder) {
  std::filesystem::create_directories(folder.dem());
  FluidSettings pool;
  pool.kind = FluidKind::buoyancy;
  pool.level = -0.0123456789012345;
  pool.density = 1239;
  write_fluid_order(folder.fluid_order(), small_mill(), {pool, 1.7e-5, 283});
  const FluidOrder order = read_fluid_order(folder.fluid_order());
  EXPECT_EQ(order.fluid.kind, FluidKind::buoyancy);
  EXPECT_EQ(order.fluid.level, pool.level);
  EXPECT_EQ(order.fluid.density, pool.density);
  EXPECT_EQ(order.timestep, 1.7e-5);
  EXPECT_EQ(order.record_steps, 283);

  FluidSettings flow;
  flow.kind = FluidKind::slurry;
  flow.file = slurry;
  flow.time = FluidTime::windows;
  write_fluid_order(folder.fluid_order(), small_mill(), {flow, 1e-5, 1});
  EXPECT_EQ(tests::read_json(folder.fluid_order())["file"], "../../slurry.h5");
  const FluidSettings found = read_fluid_order(folder.fluid_order()).fluid;
  EXPECT_EQ(std::filesystem::weakly_canonical(found.file), std::filesystem::weakly_canonical(slurry));
  EXPECT_EQ(found.time, FluidTime::windows);

  std::ofstream(folder.fluid_order()) << R"({"format": "millfoam-fluid", "kind": "slurry"})";
  EXPECT_NE(message_of([&] { read_fluid_order(folder.fluid_order()); }).find("key 'timestep_s' is missing"),
            std::string::npos);
}

TEST_F(FluidRun, ADryDeckKnowsNoFluidAndAPoolActsFromTheFirstBallOn) {
  EXPECT_EQ(deck(plan_dem(small_mill())).find("luid"), std::string::npos);
  auto mill = small_mill();
  mill.slurry.density = 1200;
  mill.dem.pool_level = 0.002;
  const std::string text = deck(plan_dem(mill));
  const auto at = [&](const std::string& words) { return text.find(words); };
  EXPECT_NE(at("# buoyancy in a pool of 1200 kg/m3 up to y = 0.002 m: needs millLiggghts and fluid.json\n"),
            std::string::npos);
  EXPECT_LT(at("fix fluidAtRest all external"), at("insert/pack"));
  EXPECT_LT(at("unfix fluidAtRest"), at("reset_timestep 0"));
  EXPECT_LT(at("reset_timestep 0"), at("fix fluid all external pf/callback 1 1"));
}

TEST_F(FluidRun, AFlowActsOnTheTurningMillOnly) {
  DemPlan plan = plan_dem(small_mill());
  tests::write_slurry(slurry, flow_of_small_mill(100));
  plan.fluid = require_fluid_of(slurry, FluidTime::mean, small_mill(), plan);
  const std::string text = deck(plan);
  EXPECT_EQ(text.find("fluidAtRest"), std::string::npos);
  EXPECT_LT(text.find("reset_timestep 0"), text.find("fix fluid all external"));
  EXPECT_NE(text.find("slurry.h5 " + plan.fluid.file_id + ", mean"), std::string::npos);
}

TEST_F(FluidRun, ADragThatStopsTheSmallestBallWithinTwentyStepsIsRefused) {
  const DemPlan plan = plan_dem(small_mill());
  const double limit = 0.05 * small_mill().ball.density / plan.step.value;
  const auto complaint = [&](const tests::SlurryContent& content) {
    tests::write_slurry(slurry, content);
    return message_of([&] { require_fluid_of(slurry, FluidTime::mean, small_mill(), plan); });
  };
  EXPECT_EQ(complaint(flow_of_small_mill(0.999 * limit)), "");
  const std::string message = complaint(flow_of_small_mill(2 * limit));
  EXPECT_NE(message.find("the drag at (0.005, -0.015, 0.003) m"), std::string::npos) << message;
  EXPECT_NE(message.find("takes 0.1 of a ball's speed"), std::string::npos) << message;
  EXPECT_NE(message.find("lower dem.rayleigh_fraction (now 0.2) to 0.1 at most"), std::string::npos)
      << message;
  // The factor of a ball of d32 is e + phi + 0.064 e, 1.032
  tests::SlurryContent mixture = flow_of_small_mill(0.999 * limit);
  mixture.polydispersity = true;
  EXPECT_NE(complaint(mixture), "");
}

TEST(SlowDrag, IsThatOfTheSmallestBallAndItsShape) {
  const averaging::BoxGrid two({0, 0, 0}, {2, 1, 1}, {2, 1, 1}, {false, false, false});
  averaging::BallFields fields;
  fields.inside = {1, 1};
  fields.solidity = {0, 0.5};
  fields.diameter = {0, 0.003};
  fields.exchange = {0, 1};
  DragLimits limits{true, 0.002, 2500, 1e-5, 0.2, 1};
  // y = d/d32 = 2/3: e/y + phi + 0.064 e y
  const double mixture = 0.5 / (2.0 / 3) + 0.5 + 0.064 * 0.5 * (2.0 / 3);
  const auto largest = [&](double factor) { return largest_drag_step * 2500 / 1e-5 / factor; };
  const auto complaint = [&](double exchange) {
    fields.exchange[1] = exchange;
    return message_of([&] { require_slow_drag(fields, two, limits, "slurry.h5"); });
  };
  EXPECT_EQ(complaint(0.999 * largest(mixture)), "");
  EXPECT_NE(complaint(1.001 * largest(mixture)).find("slurry.h5: the drag at (1.5, 0.5, 0.5) m"),
            std::string::npos);
  limits.shape_factor = 3;
  EXPECT_EQ(complaint(0.999 * largest(3 * mixture)), "");
  EXPECT_NE(complaint(1.001 * largest(3 * mixture)), "");
  limits.polydispersity = false;
  EXPECT_EQ(complaint(0.999 * largest(3)), "");
  EXPECT_NE(complaint(1.001 * largest(3)), "");
  // Outside of the mill no ball feels it
  fields.inside[1] = 0;
  EXPECT_EQ(complaint(1.001 * largest(3)), "");
}

TEST_F(FluidRun, FlowsOfAnotherMillAndVoxelsThatDoNotFitItAreRefused) {
  auto mill = small_mill();
  mill.fingerprint.flow = "00000000000000aa";
  const auto complaint = [&](const tests::SlurryContent& content) {
    tests::write_slurry(slurry, content);
    return message_of([&] { require_fluid_of(slurry, FluidTime::mean, mill, plan_dem(mill)); });
  };
  tests::SlurryContent content = flow_of_small_mill(1);
  content.mill_flow = mill.fingerprint.flow;
  EXPECT_EQ(complaint(content), "");
  content.mill_flow = "00000000000000bb";
  EXPECT_NE(
      complaint(content).find("is of another mill (flow 00000000000000bb, this mill's is 00000000000000aa)"),
      std::string::npos);
  content.mill_flow.clear();
  content.grid = averaging::BoxGrid({-0.02, -0.02, 0}, {0.02, 0.019, 0.012}, {4, 4, 2}, {false, false, true});
  EXPECT_NE(
      complaint(content).find("voxels reach from (-0.02, -0.02, 0) to (0.02, 0.019, 0.012) m, expected"),
      std::string::npos);
  content.grid = averaging::BoxGrid({-0.02, -0.02, 0}, {0.02, 0.02, 0.024}, {4, 4, 4}, {false, false, true});
  EXPECT_NE(complaint(content).find("expected the period of the mill"), std::string::npos);
  content.grid = averaging::BoxGrid({-0.02, -0.02, 0}, {0.02, 0.02, 0.012}, {4, 4, 2});
  EXPECT_NE(complaint(content).find("the voxels are not periodic along the axis"), std::string::npos);
}

TEST_F(FluidRun, TimeWindowsOfWhichNoneIsInTheRunAreRefused) {
  tests::write_slurry(slurry, flow_of_small_mill(1));  // from 0 to 1 s
  DemPlan plan = plan_dem(small_mill());
  const auto complaint = [&](FluidTime time) {
    return message_of(
        [&] { require_windows_in_run(require_fluid_of(slurry, time, small_mill(), plan), plan); });
  };
  EXPECT_EQ(complaint(FluidTime::windows), "");
  const long later = 4 * plan.turning_steps;  // 1.2 s
  continue_from(later, plan);
  EXPECT_NE(complaint(FluidTime::windows)
                .find("slurry.h5: the time windows are from 0 to 1 s of DEM time, and the run is from 1.2 to "
                      "1.5 s"),
            std::string::npos)
      << complaint(FluidTime::windows);
  EXPECT_EQ(complaint(FluidTime::mean), "");
}

TEST_F(FluidRun, TheLedgerJoinsTheSegmentsOfAResumedRun) {
  std::filesystem::create_directories(folder.dem());
  const auto sums = [](double x) {
    FluidSums all;
    all.values = {x, 2 * x, 3 * x, 4 * x, 5 * x, 6 * x, 7 * x, 8 * x, 9 * x, 10 * x};
    return all;
  };
  {
    FluidLedgerFile first(folder.dem() / "fluid.0.txt");
    first.write(10, sums(10), 10);
    first.write(20, sums(20), 10);
    first.write(30, sums(999), 10);  // lost: the next segment begins at 20
    FluidLedgerFile second(folder.dem() / "fluid.20.txt");
    second.write(30, sums(30), 10);
  }
  const auto rows = read_fluid_ledger(folder);
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[2].step, 30);
  EXPECT_EQ(rows[2].pressure, (Vector{3, 6, 9}));
  EXPECT_EQ(rows[2].drag, (Vector{12, 15, 18}));
  EXPECT_EQ(rows[2].power, 21);
  EXPECT_EQ(rows[2].torque, 24);
  EXPECT_EQ(rows[2].balance, 27);
  EXPECT_EQ(rows[2].without_field, 30);
  std::ofstream(folder.dem() / "fluid.20.txt") << "30 3 6 9 12 15 18 21 24 27\n";
  const FluidRow earlier = read_fluid_ledger(folder).back();
  EXPECT_EQ(earlier.torque, 24);
  EXPECT_EQ(earlier.balance, 0);
  EXPECT_EQ(earlier.without_field, 27);
}

TEST_F(FluidRun, SumsHavePowerAndTorqueOfAllForcesAndCountBallsWithoutField) {
  FluidSums sums;
  sums.add({{2, 3, 7}, {1, 2, 0}, 0.003}, {{3, 1, 0}, {0, -1, 5}, {1, 2, 0}});
  FluidForce none;
  none.known = false;
  sums.add({{}, {1, 1, 1}, 0.003}, none);
  EXPECT_EQ(sums.values, (std::array<double, 10>{3, 1, 0, 0, -1, 5, 8, -8, 1, 1}));
}

TEST_F(FluidRun, APlanThatContinuesBeginsWithTheOthersLastStep) {
  auto mill = small_mill();
  mill.dem.contact_interval = 0.003;
  const DemPlan first = plan_dem(mill);
  DemPlan plan = first;
  continue_from(first.end_step(), plan);
  EXPECT_EQ(plan.begin, first.turning_steps);
  EXPECT_EQ(plan.end_step(), 2 * first.turning_steps);
  EXPECT_EQ(plan.total_steps(), first.turning_steps);
  EXPECT_EQ(plan.dumps, first.dumps);
  EXPECT_NEAR(plan.begin_time(), 0.3, 1e-12);
  // The multiples of the interval from begin to end
  long contacts = 0;
  for (long step = plan.begin; step <= plan.end_step(); ++step)
    if (step % plan.contact_steps == 0) ++contacts;
  EXPECT_EQ(plan.contact_dumps, contacts);
  EXPECT_EQ(plan.begin % plan.restart_steps, 0);

  const std::string text = deck(plan);
  EXPECT_NE(text.find("read_restart restart." + std::to_string(plan.begin)), std::string::npos);
  EXPECT_NE(text.find("run " + std::to_string(plan.end_step()) + " upto every"), std::string::npos);
  EXPECT_EQ(text.find("insert/pack"), std::string::npos);

  LiggghtsLog log(plan, false);
  log.read("millFoam turning");
  log.read("  Step  Atoms  KinEng  overlap");
  log.read(std::to_string(plan.begin + 100) + " 250 1e-3 0");
  EXPECT_EQ(log.steps_done(), 100);
}

}  // namespace
}  // namespace millfoam::dem_driver
