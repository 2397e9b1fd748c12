// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/run/average_run.hpp"

#include <gtest/gtest.h>

#include "averaging/statistics/time_windows.hpp"
#include "tests/averaging/test_support.hpp"

namespace millfoam::averaging {
namespace {

/// Dumps every 100 steps of 1e-4 s, from 0 on: a ball of 0.1 m that moves at 1 m/s along x from (0.2, 0.5,
/// 0.5) in the box [0, 2) x [0, 1) x [0, 1) of two voxels, and a ball far outside.
struct AverageRun : ::testing::Test {
  TemporaryFolder folder;
  std::vector<std::string> notes;
  AverageRequest request{(folder / "dump*.txt").string(),
                         1e-4,
                         BoxGrid({0, 0, 0}, {2, 1, 1}, {2, 1, 1}),
                         0.05,
                         {},
                         {},
                         12,
                         folder / "solids.h5"};

  AverageRun() {
    for (int r = 0; r <= 150; ++r) {
      const double x = 0.2 + 0.01 * r;
      folder.write("dump" + std::to_string(100 * r) + ".txt",
                   dump_text(100 * r, {{1, {x, 0.5, 0.5}, {1, 0, 0}, 0.1}, {2, {0, 5, 0}, {}, 0.05}}));
    }
  }

  AverageSummary run() {
    return average_run(
        request, {[](std::size_t, std::size_t) {}, [this](const std::string& s) { notes.push_back(s); }});
  }
};

TEST_F(AverageRun, WritesWindowsWithTheVolumeWhereTheBallIs) {
  const AverageSummary summary = run();
  const SolidsReader solids(request.output);
  ASSERT_EQ(solids.windows().size(), 30U);
  EXPECT_EQ(summary.dumps, 150U);
  EXPECT_EQ(solids.windows()[3].records, 5);
  EXPECT_NEAR(solids.windows()[3].begin, 0.15, 1e-15);
  const SolidsWindow first = solids.read_window(0), last = solids.read_window(29);
  EXPECT_NEAR(first.solidity[0] / sphere_volume(0.1), 1, 1e-13);
  EXPECT_EQ(first.solidity[1], 0);
  EXPECT_NEAR(last.solidity[1] / sphere_volume(0.1), 1, 1e-13);
  EXPECT_NEAR(last.velocity[3], 1, 1e-14);
  EXPECT_NEAR(last.diameter[1], 0.2, 1e-15);
  ASSERT_EQ(notes.size(), 1U);
  expect_named(notes[0], {"1.5 s", "not used"});
}

TEST_F(AverageRun, ReportsWhereTheVolumeWent) {
  const AverageSummary summary = run();
  const double inside = sphere_volume(0.1), outside = sphere_volume(0.05);
  for (const Ledger& ledger : summary.ledgers) {
    EXPECT_NEAR(ledger.volume_in / (inside + outside), 1, 1e-12);
    EXPECT_NEAR(ledger.deposited / inside, 1, 1e-12);
    EXPECT_NEAR(ledger.outside / outside, 1, 1e-12);
  }
  expect_named(report(summary), {"volume_in", "deposited", "88.8889", "outside", "11.1111", "clipped",
                                 "150 records in 30 windows", "8 to 64 balls"});
}

TEST_F(AverageRun, OverTheWholeRunIsOneWindowToBeHeld) {
  request.window.reset();
  request.start = 0.5;
  run();
  const SolidsReader solids(request.output);
  EXPECT_TRUE(solids.whole_run());
  ASSERT_EQ(solids.windows().size(), 1U);
  EXPECT_EQ(solids.windows()[0].records, 101);
  EXPECT_NEAR(solids.time0(), 0.5, 1e-15);
  const SolidsWindow whole = solids.read_window(0);
  EXPECT_NEAR((whole.solidity[0] + whole.solidity[1]) / sphere_volume(0.1), 1, 1e-12);
}

TEST_F(AverageRun, TakesTheTimestepFromTheNotesBesideTheDumps) {
  folder.write("run.txt", "timestep 1e-4\ninterval 100\nangular_velocity -6.4\n");
  request.timestep.reset();
  run();
  EXPECT_EQ(SolidsReader(request.output).timestep(), 1e-4);
  request.timestep = 2e-4;
  expect_named(message_of<DumpError>([&] { run(); }), {"0.0002", "0.0001", "run.txt"});
}

TEST_F(AverageRun, ABrokenDumpLeavesNoSolidsFile) {
  folder.write("dump9000.txt", dump_text(9000, {{1, {0, 0, 0}, {0, 0, 0}, 0.1}}).substr(0, 150));
  expect_named(message_of<DumpError>([&] { run(); }), {"dump9000.txt:10", "truncated"});
  EXPECT_FALSE(std::filesystem::exists(request.output));
}

TEST_F(AverageRun, RefusesTheNameThatTheFileForParaViewNeeds) {
  request.output = folder / "solids.xdmf";
  expect_named(message_of<SolidsFileError>([&] { run(); }), {"solids.xdmf", "solids.h5"});
}

TEST_F(AverageRun, WarnsOfVoxelsSmallerThanTheBalls) {
  request.grid = BoxGrid({0, 0, 0}, {2, 1, 1}, {50, 25, 25});
  const AverageSummary summary = run();
  EXPECT_GT(summary.largest_solidity, 0.74);
  expect_named(report(summary), {"largest solidity"});
}

}  // namespace
}  // namespace millfoam::averaging
