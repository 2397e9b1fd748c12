// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/record_rows.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "dem_driver/deck_outputs.hpp"
#include "small_mill.hpp"

namespace millfoam::dem_driver {
namespace {

using tests::TemporaryFolder;

class RecordRows : public ::testing::Test {
 protected:
  RecordRows() {
    std::filesystem::create_directories(folder_.dem());
    plan_.step.steps_per_record = 10;
    plan_.restart_steps = 20;
  }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_.dem() / name, std::ios::binary) << text;
  }
  /// A histogram at `step` of so many bins.
  static std::string histogram(long step, int bins) {
    std::string text = std::to_string(step) + " 1000 5 0 0 1e-6\n";
    for (int bin = 1; bin <= bins; ++bin) text += std::to_string(bin) + " 1e-7 0 0\n";
    return text;
  }
  std::string complaint(long step) const { return rows_complaint(folder_, plan_, step); }

  TemporaryFolder temporary_;
  CaseFolder folder_{temporary_.path()};
  DemPlan plan_;
};

TEST_F(RecordRows, EverySegmentHasTheRowsUpToTheBeginOfTheNextOne) {
  write("torque.0.txt", "# head\n10 1\n20 2\n30 9 9 9\n");
  write("torque.20.txt", "30 3\n40 4\n");
  write("energy.0.txt", "# head\n0 1 1\n10 1 1\n20 2 2\n");
  write("energy.20.txt", "20 2 2\n30 3 3\n40 4 4\n5");
  EXPECT_EQ(complaint(40), "");
  EXPECT_EQ(complaint(50), (folder_.dem() / "torque.20.txt").string() +
                               ": 10 bytes without a whole line of step 50, expected one");
  write("torque.20.txt", "30 340 4\n50 5\n");
  EXPECT_EQ(complaint(20), "");
  EXPECT_EQ(complaint(40), (folder_.dem() / "torque.20.txt").string() +
                               ": 14 bytes: line 1 is '30 340 4', expected 2 numbers of step 30");
}

TEST_F(RecordRows, TheFirstSegmentIsThatOfTheRunsBegin) {
  write("torque.20.txt", "30 3\n");
  write("energy.20.txt", "20 2 2\n30 3 3\n");
  EXPECT_NE(complaint(30).find("torque.0.txt: no such file"), std::string::npos);
  plan_.begin = 20;
  EXPECT_EQ(complaint(30), "");
}

TEST_F(RecordRows, PartTorquesAndTheFluidAreRowsOfTheRecordsToo) {
  write("torque.0.txt", "10 1\n");
  write("energy.0.txt", "0 1 1\n10 1 1\n");
  write("partTorques.0.txt", "10 1 2 3\n");
  EXPECT_NE(complaint(10).find("partTorques.0.txt: 9 bytes: line 1 is"), std::string::npos);
  write("partTorques.0.txt", "10 1 2 3 4\n");
  EXPECT_EQ(complaint(10), "");
  plan_.fluid.kind = FluidKind::flow;
  write("fluid.0.txt", "10 0 0 0\n");
  EXPECT_NE(complaint(10).find("fluid.0.txt"), std::string::npos);
  write("fluid.0.txt", "10 1 2 3 4 5 6 7 8 9 10\n");
  EXPECT_EQ(complaint(10), "");
}

TEST_F(RecordRows, HistogramsAreWholeOrNotThere) {
  write("torque.0.txt", "10 1\n20 2\n");
  write("energy.0.txt", "0 1 1\n10 1 1\n20 2 2\n");
  write("wallOverlaps.0.txt", histogram(20, overlap_bins) + histogram(40, 17));
  EXPECT_EQ(complaint(20), "");
  write("ballOverlaps.0.txt", histogram(10, overlap_bins) + histogram(20, 400) + histogram(40, 3));
  EXPECT_EQ(complaint(10), "");
  EXPECT_NE(complaint(20).find("ballOverlaps.0.txt: "), std::string::npos);
  EXPECT_NE(complaint(20).find("expected bin 401 of the bins of step 20"), std::string::npos);
  write("ballOverlaps.0.txt", histogram(10, overlap_bins) + histogram(20, 400));
  EXPECT_NE(complaint(20).find(" with 400 bins of step 20, expected 1000"), std::string::npos);
}

TEST_F(RecordRows, AGrowingSegmentIsReadFromItsLastWholeRowOn) {
  RowCheck check(folder_, {"torque", {2}}, 0, 10);
  EXPECT_EQ(check.complaint(0), "");
  write("torque.0.txt", "# head\n10 1\n20 2\n3");
  EXPECT_EQ(check.complaint(20), "");
  EXPECT_EQ(check.whole_bytes(), 17u);
  // What was read is not read again
  write("torque.0.txt", "-------\n----\n----30 3\n40 x\n");
  std::filesystem::resize_file(check.file(), 17);
  std::ofstream(check.file(), std::ios::app) << "30 3\n40 x\n";
  EXPECT_EQ(check.complaint(30), "");
  EXPECT_EQ(check.complaint(40), "27 bytes: line 5 is '40 x', expected 2 numbers of step 40");
}

}  // namespace
}  // namespace millfoam::dem_driver
