// SPDX-License-Identifier: GPL-3.0-or-later
// A script replaces LIGGGHTS here, because LIGGGHTS cannot be made to fail in a given way.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "dem_driver/folder_preparation.hpp"
#include "dem_driver/liggghts_run.hpp"
#include "dem_driver/output_check.hpp"
#include "dem_driver/segments.hpp"
#include "small_mill.hpp"

namespace millfoam::dem_driver {
namespace {

using tests::message_of;
using tests::small_mill;
using tests::TemporaryFolder;
using tests::Variable;

/// A case with a program of its own in the place of millLiggghts.
class FailingRun : public ::testing::Test {
 protected:
  /// What run_liggghts complains about when LIGGGHTS does `script`.
  std::string complaint(const std::string& script, int ranks = 1) {
    tests::write_script(temporary_.path() / "liggghts", script);
    const Variable path("PATH", temporary_.path().string() + ":" + std::getenv("PATH"));
    const Variable program("MILLFOAM_LIGGGHTS", (temporary_.path() / "liggghts").string());
    prepare_folders(folder_);
    tests::write_rows(folder_, plan_, plan_.end_step());
    std::ostringstream progress;
    return message_of([&] { run_liggghts(folder_, plan_, ranks, {progress, false}); });
  }

  bool complains(const std::string& script, const std::string& words) {
    const std::string message = complaint(script);
    const bool names_log = message.find(folder_.log().string()) != std::string::npos;
    EXPECT_TRUE(names_log) << message;
    EXPECT_NE(message.find(words), std::string::npos) << message;
    return names_log && message.find(words) != std::string::npos;
  }

  DemPlan plan_ = plan_dem(small_mill());
  TemporaryFolder temporary_;
  CaseFolder folder_{temporary_.path() / "case"};
};

const std::string inserted =
    "echo 'millFoam inserted 150 of 0.003 total 150'\necho 'millFoam inserted 100 of 0.002 total 250'\n";

TEST_F(FailingRun, AnExitCodeIsReportedWithTheLogsLastLines) {
  EXPECT_TRUE(complains("echo some hint\nexit 7", "exit code 7"));
  EXPECT_TRUE(complains("echo some hint\nexit 7", "  some hint"));
}

TEST_F(FailingRun, AnErrorLineIsReportedEvenWithExitCodeZero) {
  EXPECT_TRUE(complains("echo 'ERROR: Cannot open mesh file'\necho 'millFoam finished'",
                        "LIGGGHTS stopped: ERROR: Cannot open mesh file"));
}

TEST_F(FailingRun, LostBallsAreCountedAndTheStepsNamed) {
  EXPECT_TRUE(complains(
      inserted + "echo millFoam turning\necho '  Step  Atoms  KinEng  overlap'\necho '0 250 1e-3 0'\n"
                 "echo '400 250 1e-3 0'\necho '800 247 1e-3 0'\nsleep 60",
      "lost 3 of 250 balls between steps 400 and 800 of the turning mill"));
}

TEST_F(FailingRun, FewerBallsThanAskedAreReportedWithTheirDiameter) {
  EXPECT_TRUE(
      complains("echo 'millFoam inserted 150 of 0.003 total 150'\n"
                "echo 'millFoam inserted 100 of 0.002 total 241'\nsleep 60",
                "inserted 91 of 100 balls of diameter 0.002"));
}

TEST_F(FailingRun, MoreBallsThanAskedAreReportedToo) {
  EXPECT_TRUE(complains("echo 'millFoam inserted 151 of 0.003 total 152'", "inserted 152 of 151 balls"));
}

TEST_F(FailingRun, AnEnergyThatIsNotFiniteStopsTheRun) {
  EXPECT_TRUE(complains(inserted + "echo '  Step  Atoms  KinEng  overlap'\necho '10 250 nan 0'\nsleep 60",
                        "kinetic energy is not finite at step 10"));
}

TEST_F(FailingRun, AnEarlyEndIsNoSuccess) {
  EXPECT_TRUE(complains(inserted, "before the deck's last line"));
}

/// Commands that write the dump of a step with as many lines of balls as there is room for.
std::string dump(long step) {
  const std::string name = "../dumps/dump." + std::to_string(step) + ".txt";
  return "{ printf 'ITEM: TIMESTEP\\n" + std::to_string(step) +
         "\\nITEM: NUMBER OF ATOMS\\n250\\nBOX\\n0 1\\n0 1\\n0 1\\nITEM: ATOMS id\\n'; seq 250; } > " + name +
         '\n';
}

const std::string turning = inserted + "echo millFoam turning\necho '  Step  Atoms  KinEng  overlap'\n";

TEST_F(FailingRun, ADumpThatHadNoRoomStopsTheRunAtOnce) {
  // A file of more than one block of 512 bytes is cut there, as a full disk would.
  const std::string message =
      complaint(turning + dump(0) + "echo '0 250 1e-3 0'\ntrap '' XFSZ\nulimit -f 1\n" +
                dump(plan_.step.steps_per_record) + "echo '" + std::to_string(plan_.step.steps_per_record) +
                " 250 1e-3 0'\nsleep 60");
  const auto file = folder_.dumps() / ("dump." + std::to_string(plan_.step.steps_per_record) + ".txt");
  EXPECT_EQ(message.find(file.string() + ": 512 bytes with "), 0u) << message;
  EXPECT_NE(message.find("complete lines, expected 259; "), std::string::npos) << message;
  EXPECT_NE(message.find(" free"), std::string::npos) << message;
  EXPECT_NE(message.find("--resume starts from the beginning: there is no complete restart file"),
            std::string::npos)
      << message;
}

TEST_F(FailingRun, ACutFirstRestartFileCannotBeResumedFrom) {
  const std::string message = complaint(turning + ": > restart.100\necho 'millFoam restart 100'\nsleep 60");
  EXPECT_NE(message.find("It cannot be resumed: no restart file of it is usable"), std::string::npos)
      << message;
}

TEST_F(FailingRun, TheLastGoodRestartFileIsKeptWhenTheNextHadNoRoom) {
  tests::write_restart(temporary_.path() / "good", {250});
  const std::string good = "cp ../../good restart.100\necho 'millFoam restart 100'\n";
  const std::string message =
      complaint(turning + good + ": > restart.200\necho 'millFoam restart 200'\nsleep 60");
  EXPECT_EQ(message.find((folder_.dem() / "restart.200").string() + ": 0 bytes, expected a restart file"), 0u)
      << message;
  EXPECT_NE(message.find("--resume continues from step 100"), std::string::npos) << message;
  EXPECT_TRUE(std::filesystem::exists(folder_.dem() / "restart.100"));
  EXPECT_EQ(last_good_restart(folder_, plan_), 100);
}

TEST_F(FailingRun, ALostLineOfEnergiesStopsTheRunAtTheNextRestartFileAndTheOneBeforeIsKept) {
  tests::write_restart(temporary_.path() / "good", {250});
  const std::string record = std::to_string(plan_.step.steps_per_record);
  const std::string twice = std::to_string(2 * plan_.step.steps_per_record);
  const std::string message =
      complaint(turning + "cp ../../good restart." + record + "\necho 'millFoam restart " + record +
                "'\nsleep 1\nsed -i '/^" + twice + " /d' energy.0.txt\ncp ../../good restart." + twice +
                "\necho 'millFoam restart " + twice + "'\nsleep 60");
  EXPECT_EQ(message.find((folder_.dem() / "energy.0.txt").string() + ": "), 0u) << message;
  EXPECT_NE(message.find("bytes without a whole line of step " + twice + ", expected one; "),
            std::string::npos)
      << message;
  EXPECT_NE(message.find("--resume continues from step " + record), std::string::npos) << message;
  EXPECT_EQ(last_good_restart(folder_, plan_), plan_.step.steps_per_record);
}

TEST_F(FailingRun, WithAFlowTheRestartFileBeforeTheLastIsKeptToo) {
  tests::write_restart(temporary_.path() / "good", {250});
  std::string script = turning + "echo " + std::to_string(plan_.step.steps_per_record) +
                       " 0 0 0 0 0 0 0 0 0 0 > fluid.0.txt\n";
  for (const std::string step : {"100", "200", "300"})
    script += "cp ../../good restart." + step + "\necho 'millFoam restart " + step + "'\n";
  const auto kept = [&] {
    complaint(script);
    std::vector<long> steps;
    for (const NumberedFile& restart : find_restarts(folder_)) steps.push_back(restart.step);
    return steps;
  };
  EXPECT_EQ(kept(), (std::vector<long>{300}));
  plan_.fluid.kind = FluidKind::flow;
  EXPECT_EQ(kept(), (std::vector<long>{200, 300}));
}

TEST_F(FailingRun, MissingDumpsAreCounted) {
  const std::string message = complaint(inserted + "echo millFoam finished\necho x > ../dumps/dump.0.txt");
  EXPECT_NE(message.find("1 dumps, expected 31"), std::string::npos) << message;
}

TEST_F(FailingRun, TooManyRanksAreRefusedWithTheBeginningOfWhatMpirunSays) {
  tests::write_script(temporary_.path() / "mpirun", tests::refusal_of_open_mpi);
  const std::string message = complaint("exit 3", 64);
  EXPECT_EQ(message.find("mpirun refused to run LIGGGHTS on 64 ranks (exit code 1)"), 0u) << message;
  EXPECT_NE(message.find("  There are not enough slots"), std::string::npos) << message;
  EXPECT_NE(message.find("Either request fewer slots"), std::string::npos) << message;
  EXPECT_EQ(message.find("---"), std::string::npos) << message;
}

TEST_F(FailingRun, OnManyRanksAFailureOfLiggghtsIsNotMpiruns) {
  tests::write_script(temporary_.path() / "mpirun", "echo 'LIGGGHTS (Version 3.8.0)'\nexit 7");
  EXPECT_EQ(complaint("exit 3", 2).find("LIGGGHTS stopped with exit code 7"), 0u);
}

TEST_F(FailingRun, WithoutAProgramOfThatNameOnPathThePackageIsNamed) {
  prepare_folders(folder_);
  const Variable path("PATH", "/no/such/folder");
  const Variable program("MILLFOAM_LIGGGHTS", "liggghts");
  std::ostringstream progress;
  const std::string message = message_of([&] {
    run_liggghts(folder_, plan_dem(small_mill()), 1, {progress, false});
  });
  EXPECT_NE(message.find("liggghts is not on PATH"), std::string::npos) << message;
}

TEST_F(FailingRun, WithoutMillLiggghtsNextToTheProgramItsPlaceIsNamed) {
  prepare_folders(folder_);
  const Variable program("MILLFOAM_LIGGGHTS", "");
  std::ostringstream progress;
  const std::string message = message_of([&] {
    run_liggghts(folder_, plan_dem(small_mill()), 1, {progress, false});
  });
  EXPECT_NE(message.find("millLiggghts: no such program, expected it next to millDem"), std::string::npos)
      << message;
}

}  // namespace
}  // namespace millfoam::dem_driver
