// SPDX-License-Identifier: GPL-3.0-or-later
/// steps.csv and flow.json: what a flow leaves behind for programs.
#include "openfoam_module/record/flow_record.hpp"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "millfoam_version.hpp"
#include "temporary_folder.hpp"

namespace millfoam::record {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

struct Flow : ::testing::Test {
  TemporaryFolder folder;
  FlowSetup setup;
  fs::path records = folder.path / "postProcessing" / "flow";

  Flow() {
    setup.solver = "slurryFoam";
    setup.asked_end = 0.6;
    setup.angular_velocity = -6.1;
    setup.mill_flow = "0123456789abcdef";
    setup.limits = StepLimits{0.5, 0.4, 3, 0.1, 1e-3};
    Solids solids;
    solids.file = "/case/solids.h5";
    solids.begin = 1;
    solids.end = 1.2;
    solids.windows = 4;
    solids.in_time = "smooth";
    solids.out_of_range = "repeat";
    solids.mill_averages = "fedcba9876543210";
    setup.solids = solids;
    setup.drag = Drag{"Beetstra", "Beetstra et al.", 1, "plastic", false, "weights", 0.1, 0.6, 20, 1000};
  }

  static StepRow row(double time, double delta_t) {
    StepRow result;
    result.time = time;
    result.delta_t = delta_t;
    result.courant = 0.25;
    result.air_courant = 2.5;
    result.slurry = 1e-5;
    result.alpha_min = -1e-12;
    return result;
  }

  Json summary(const std::string& start = "0") const {
    return Json::parse(text_of(records / start / "flow.json"));
  }

  std::vector<std::string> lines(const std::string& start = "0") const {
    std::istringstream text(text_of(records / start / "steps.csv"));
    std::vector<std::string> result;
    for (std::string line; std::getline(text, line);) result.push_back(line);
    return result;
  }
};

TEST_F(Flow, LeavesARowForEachStepThatCanBeReadAtOnce) {
  FlowRecord record(folder.path, "0", setup);
  StepRow step = row(0.001, 0.001);
  step.beyond_law = 0.125;
  record.add(step);
  ASSERT_EQ(lines().size(), 2U);
  EXPECT_THAT(lines()[0],
              ::testing::StartsWith("time_s,deltaT_s,courant,courant_surface,courant_air,voidage_change,"
                                    "pressure_iterations"));
  EXPECT_THAT(lines()[1], ::testing::StartsWith("0.001,0.001,0.25,0,2.5,0,0,0,1e-05,0,-1e-12,"));
  EXPECT_THAT(lines()[1], ::testing::HasSubstr(",nan,0.125,nan,"));
  const auto commas = [](const std::string& line) { return std::count(line.begin(), line.end(), ','); };
  EXPECT_EQ(commas(lines()[1]), commas(lines()[0]));
}

TEST_F(Flow, IsNotCompleteBeforeItsEnd) {
  FlowRecord record(folder.path, "0", setup);
  EXPECT_EQ(summary()["complete"], false);
  record.add(row(0.3, 0.3));
  record.write(false);
  EXPECT_EQ(summary()["complete"], false);
  EXPECT_EQ(summary()["end_s"], 0.3);
  record.write(true);
  EXPECT_EQ(summary()["complete"], true);
  EXPECT_FALSE(fs::exists(records / "0" / "flow.json.part"));
}

TEST_F(Flow, TellsWhatItsStagesTook) {
  FlowRecord record(folder.path, "0", setup);
  record.add(row(0.3, 0.3));
  record.set_stages({{"pressure", 1.5}, {"surface", 0.25}});
  record.set_memory(3e8);
  record.write(true);
  EXPECT_EQ(summary()["stages_s"], (Json{{"pressure", 1.5}, {"surface", 0.25}}));
  EXPECT_EQ(summary()["memory_bytes"], 3e8);
  EXPECT_EQ(summary()["largest"]["courant_air"], 2.5);
}

TEST_F(Flow, TellsWhatItWasRunWith) {
  const FlowRecord record(folder.path, "0", setup);
  const Json found = summary();
  EXPECT_EQ(found["format"], "millfoam-flow");
  EXPECT_EQ(found["program"], std::string("slurryFoam ") + millfoam::version());
  EXPECT_EQ(found["mill"], (Json{{"flow", "0123456789abcdef"}}));
  EXPECT_EQ(found["rotation"]["angular_velocity_rad_s"], -6.1);
  EXPECT_EQ(found["rotation"]["sense"], "clockwise");
  EXPECT_EQ(found["limits"]["maxAlphaCo"], 0.4);
  EXPECT_EQ(found["limits"]["maxAirCo"], 3);
  EXPECT_EQ(found["drag"]["law"], "Beetstra");
  EXPECT_EQ(found["drag"]["reynolds_range"], (Json{20, 1000}));
  EXPECT_EQ(found["solids"]["mill"]["averages"], "fedcba9876543210");
  EXPECT_TRUE(found["slurry_m3"]["first"].is_null());
}

TEST_F(Flow, MeansAreOverTime) {
  FlowRecord record(folder.path, "0", setup);
  StepRow step = row(0.1, 0.1);
  step.beyond_law = 0.4;
  step.volume_correction = -0.01;
  record.add(step);
  step = row(0.4, 0.3);
  step.beyond_law = 0.0;
  step.volume_correction = 0.002;
  record.add(step);
  record.add(row(0.5, 0.1));  // in which nothing is known of balls
  record.write(true);
  const Json found = summary();
  EXPECT_DOUBLE_EQ(found["beyond_law"]["mean"], 0.1);
  EXPECT_DOUBLE_EQ(found["beyond_law"]["largest"], 0.4);
  EXPECT_DOUBLE_EQ(found["volume_correction"]["largest"], -0.01);
  EXPECT_DOUBLE_EQ(found["volume_correction"]["mean"], (-0.001 + 0.0006) / 0.4);
  EXPECT_TRUE(found["beyond_law"]["reynolds_below"].is_null());
}

TEST_F(Flow, ForceOnTheBallsIsTheMeanOfTheTimesAtWhichItWasTaken) {
  FlowRecord record(folder.path, "0", setup);
  for (const double force : {0.1, 0.3}) {
    StepRow step = row(force, 0.1);
    step.force_mean = force;
    step.force_95 = 2 * force;
    record.add(step);
    record.add(row(force + 0.1, 0.1));
  }
  record.write(true);
  EXPECT_DOUBLE_EQ(summary()["force_on_balls"]["mean"], 0.2);
  EXPECT_DOUBLE_EQ(summary()["force_on_balls"]["below_95"], 0.4);
  EXPECT_EQ(summary()["force_on_balls"]["times"], 2);
}

TEST_F(Flow, ContinuityOfTheSolidsIsTheMeanOfTheTimesAtWhichItWasFound) {
  FlowRecord record(folder.path, "0", setup);
  for (const double residual : {0.1, 0.3}) {
    StepRow step = row(residual, 0.1);
    step.continuity_residual = residual;
    step.continuity_speed = 2 * residual;
    step.slip = 3 * residual;
    record.add(step);
    record.add(row(residual + 0.1, 0.1));
  }
  record.write(true);
  EXPECT_DOUBLE_EQ(summary()["solids_continuity"]["residual_per_s"], 0.2);
  EXPECT_DOUBLE_EQ(summary()["solids_continuity"]["speed_m_per_s"], 0.4);
  EXPECT_NEAR(summary()["solids_continuity"]["slip_m_per_s"].get<double>(), 0.6, 1e-15);
  EXPECT_EQ(summary()["solids_continuity"]["times"], 2);
}

TEST_F(Flow, CountsHowOftenASeriesOfBallsBeganAgain) {
  const auto repeated = [&](double time) {
    FlowRecord record(folder.path, "0", setup);
    record.add(row(time, 0.1));
    record.write(true);
    return summary()["solids"]["repeated"].get<int>();
  };
  EXPECT_EQ(repeated(0.1), 0);
  EXPECT_EQ(repeated(0.2), 0);
  EXPECT_EQ(repeated(0.3), 1);
  EXPECT_EQ(repeated(0.4), 1);
  EXPECT_EQ(repeated(0.5), 2);
}

TEST_F(Flow, TellsForHowLongTheLastWindowWasHeld) {
  setup.solids->out_of_range = "hold";
  FlowRecord record(folder.path, "0", setup);
  record.add(row(0.5, 0.1));
  record.write(true);
  EXPECT_EQ(summary()["solids"]["repeated"], 0);
  EXPECT_NEAR(summary()["solids"]["held_s"], 0.3, 1e-12);
}

TEST_F(Flow, KnowsBallsThatMoveAtTheSameTimeAndAUniformBlock) {
  setup.solids->file.clear();
  setup.solids->program = "millDem 1.2.3";
  FlowRecord balls(folder.path, "0", setup);
  balls.write(true);
  const auto found = summary()["solids"];
  EXPECT_TRUE(found["file"].is_null());
  EXPECT_EQ(found["program"], "millDem 1.2.3");
  EXPECT_EQ(found["begin_s"], 1);
  EXPECT_EQ(found["mill"]["averages"], "fedcba9876543210");
  EXPECT_FALSE(found.contains("windows"));
  setup.solids->program.clear();
  FlowRecord block(folder.path, "0", setup);
  block.write(true);
  EXPECT_FALSE(summary()["solids"].contains("program"));
}

TEST_F(Flow, WithoutBallsSaysSo) {
  setup.solids.reset();
  setup.drag.reset();
  setup.limits.reset();
  const FlowRecord record(folder.path, "0", setup);
  for (const char* key : {"solids", "drag", "limits"}) EXPECT_TRUE(summary()[key].is_null()) << key;
}

TEST_F(Flow, ThatGoesOnKeepsWhatIsBeforeItAndRemovesWhatIsComputedAgain) {
  for (const double start : {0.0, 0.1, 0.25}) {
    setup.begin = start;
    FlowRecord record(folder.path, start == 0 ? "0" : std::to_string(start).substr(0, 4), setup);
    record.add(row(start + 0.3, 0.3));
  }
  EXPECT_TRUE(fs::exists(records / "0.25" / "steps.csv"));
  setup.begin = 0.1;
  const FlowRecord record(folder.path, "0.10", setup);
  EXPECT_EQ(lines("0").size(), 2U);
  EXPECT_EQ(lines("0.10").size(), 1U);
  EXPECT_FALSE(fs::exists(records / "0.25"));
}

TEST_F(Flow, IsCompleteAtTheTimeAtWhichItsLastRunEnded) {
  EXPECT_FALSE(is_complete(folder.path, 0.2));
  FlowRecord first(folder.path, "0", setup);
  first.add(row(0.2, 0.2));
  first.write(false);
  EXPECT_FALSE(is_complete(folder.path, 0.2));
  first.write(true);
  EXPECT_TRUE(is_complete(folder.path, 0.2));
  EXPECT_FALSE(is_complete(folder.path, 0.3));
  setup.begin = 0.2;
  FlowRecord second(folder.path, "0.2", setup);
  EXPECT_FALSE(is_complete(folder.path, 0.2));
}

TEST_F(Flow, NamesTheFileThatCannotBeWritten) {
  fs::create_directories(records / "0" / "steps.csv");
  try {
    const FlowRecord record(folder.path, "0", setup);
    FAIL() << "was expected to be refused";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("flow/0/steps.csv: cannot be written"));
  }
}

}  // namespace
}  // namespace millfoam::record
