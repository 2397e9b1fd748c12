// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/run/solids_output.hpp"

#include <gtest/gtest.h>

#include <chrono>

#include "averaging/files/xdmf.hpp"
#include "averaging/run/solids_summary.hpp"
#include "averaging/run/summary_file.hpp"
#include "tests/averaging/test_support.hpp"

namespace millfoam::averaging {
namespace {

namespace fs = std::filesystem;

const BoxGrid grid({0, 0, 0}, {1, 1, 1}, {1, 1, 1}, {false, false, false});

/// Two outputs of a run of which a tenth of the balls' volume is outside the grid.
class AreWritten : public ::testing::Test {
 protected:
  AreWritten() {
    request_.windows = {{0.5, folder_ / "short.h5"}, {1.0, folder_ / "long.h5"}};
    for (const WindowsRequest& windows : request_.windows) write(windows.output, run_.run_id);
  }

  void write(const fs::path& output, const std::string& run_id, const std::string& averages = "") const {
    WindowAverage average;
    average.time = {0, 1, 10, false, false};
    average.ledger = {1.0, 0.9, 0.1, 0};
    average.mean = {{0.5}, {1, 2, 3}, {0.1}, {0.1}, {}};
    for (auto* field : {&average.number, &average.solidity_deviation, &average.granular_temperature})
      *field = {0.0};
    average.velocity_deviation.assign(3, 0.0);
    SolidsHeader header;
    header.timestep = 1e-5;
    header.method = "exact";
    header.program = "test";
    header.run_id = run_id;
    header.mill_averages = averages;
    write_solids(output, grid, header, 1, [&](std::size_t) { return average; });
  }

  /// As a file that an earlier run of the same plan has left.
  void make_old(const fs::path& file) const {
    fs::last_write_time(file, fs::last_write_time(run_.file) - std::chrono::hours(1));
  }

  bool written() const { return are_written(request_, run_); }

  TemporaryFolder folder_;
  RunMetadata run_ = [this] {
    RunMetadata run;
    run.file = folder_.write("run.json", "{}");
    run.run_id = "0123456789abcdef";
    return run;
  }();
  AverageRequest request_{GridRequest(grid)};
};

TEST_F(AreWritten, AllFilesOfARunAre) {
  EXPECT_TRUE(written());
}

TEST_F(AreWritten, WithoutOneOfTheFilesTheyAreNot) {
  for (const char* name : {"short.h5", "short.json", "short.xdmf", "long.h5", "long.json", "long.xdmf"}) {
    fs::remove(folder_ / name);
    EXPECT_FALSE(written()) << name;
    for (const WindowsRequest& windows : request_.windows) write(windows.output, run_.run_id);
    EXPECT_TRUE(written());
  }
}

TEST_F(AreWritten, FilesOfAnEarlierRunAreNot) {
  for (const char* name : {"long.h5", "long.json", "long.xdmf"}) {
    make_old(folder_ / name);
    EXPECT_FALSE(written()) << name;
    write(folder_ / "long.h5", run_.run_id);
    EXPECT_TRUE(written());
  }
}

TEST_F(AreWritten, FilesOfOtherAveragesOfTheMillAreNot) {
  request_.mill_averages = "0a1b";
  EXPECT_FALSE(written());
  for (const WindowsRequest& windows : request_.windows) write(windows.output, run_.run_id, "0a1b");
  EXPECT_TRUE(written());
  // As millAverage --window whole, which is not the mill's
  write(folder_ / "long.h5", run_.run_id);
  EXPECT_FALSE(written());
}

TEST_F(AreWritten, ASummaryOfAnotherRunOrOneThatIsDamagedIsNot) {
  const fs::path summary = folder_ / "long.json";
  fs::copy_file(summary, folder_ / "kept.json");
  write(folder_ / "other.h5", "fedcba9876543210");
  for (const fs::path& other : {folder_ / "other.json", folder_.write("cut.json", "{\"format\": "),
                                folder_.write("none.json", R"({"format": "millfoam-averages"})")}) {
    fs::copy_file(other, summary, fs::copy_options::overwrite_existing);
    EXPECT_FALSE(written()) << other;
  }
  fs::copy_file(folder_ / "kept.json", summary, fs::copy_options::overwrite_existing);
  EXPECT_TRUE(written());
}

TEST_F(AreWritten, TheirLedgersAreReadWithoutTheirFields) {
  const SolidsSummary summary = read_ledgers(folder_ / "long.h5");
  const std::vector<std::string> failures = ledger_failures(summary, 0.05);
  ASSERT_EQ(failures.size(), 1u);
  expect_named(failures[0], {"window 0 from 0 s: 10 %", "outside the grid"});
  EXPECT_EQ(failures, ledger_failures(summarise(folder_ / "long.h5"), 0.05));
}

TEST(LedgerFailures, NameWhatIsMissingOutsideOrMoved) {
  const auto failures = [](const Ledger& ledger, double tolerance) {
    SolidsSummary summary;
    summary.windows.resize(2);
    summary.windows[0].ledger = {2.0, 2.0, 0, 0};
    summary.windows[1].time.begin = 0.25;
    summary.windows[1].ledger = ledger;
    return ledger_failures(summary, tolerance);
  };
  EXPECT_TRUE(failures({2.0, 1.9, 0.1, 0.1}, 0.05).empty());
  EXPECT_EQ(failures({2.0, 1.9, 0.1, 0}, 0.04),
            (std::vector<std::string>{"window 1 from 0.25 s: 5 % of the particle volume is outside the grid, "
                                      "allowed are 4 %"}));
  EXPECT_EQ(failures({2.0, 2.0, 0, 0.1}, 0.04),
            (std::vector<std::string>{"window 1 from 0.25 s: 5 % of the particle volume was moved to "
                                      "neighbours, from within walls or above a cap, allowed are 4 %"}));
  // Nothing may be missing, whatever the tolerance, and nothing may be there twice
  for (const double deposited : {1.9, 2.1})
    EXPECT_EQ(failures({2.0, deposited, 0, 0}, 1),
              (std::vector<std::string>{"window 1 from 0.25 s: 5 % of the particle volume is missing in the "
                                        "ledger, allowed are 1e-08 %"}));
  EXPECT_EQ(failures({2.0, 1.7, 0.1, 0.2}, 0.01).size(), 3U);
}

TEST(OccupiedCells, AreNotThoseThatOnlyTailsOfSmoothingReach) {
  const BoxGrid four({0, 0, 0}, {4, 1, 1}, {4, 1, 1}, {false, false, false});
  const SolidsWindow fields{
      {0.3, 0.1, 1e-7, 0}, std::vector<double>(12), {0.1, 0.1, 0.1, 0}, {0.1, 0.1, 0.1, 0}, {}};
  const WindowSummary summary = summarise(four, {}, {}, 8, fields);
  EXPECT_EQ(summary.occupied_cells, 2u);
  EXPECT_DOUBLE_EQ(summary.occupied_volume, 2);
  EXPECT_DOUBLE_EQ(summary.mean_solidity, 0.2);
  EXPECT_EQ(summary.largest_solidity, 0.3);
}

}  // namespace
}  // namespace millfoam::averaging
