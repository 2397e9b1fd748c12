// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/output_check.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "dem_driver/liggghts_log.hpp"
#include "dem_driver/segments.hpp"
#include "small_mill.hpp"

namespace millfoam::dem_driver {
namespace {

using tests::message_of;
using tests::small_mill;
using tests::TemporaryFolder;

std::string dump_of(int entries) {
  std::string text = "ITEM: TIMESTEP\n100\nITEM: NUMBER OF ATOMS\n" + std::to_string(entries) +
                     "\nITEM: BOX BOUNDS ff ff pp\n-0.02 0.02\n-0.02 0.02\n0 0.012\nITEM: ATOMS id type x y "
                     "z vx vy vz radius\n";
  for (int i = 0; i < entries; ++i)
    text += std::to_string(i + 1) + " 1 0.01 0.002 0.003 0.1 0.2 0.3 0.0015\n";
  return text;
}

class OutputCheckTest : public ::testing::Test {
 protected:
  OutputCheckTest() {
    for (const auto& path : {folder_.dem(), folder_.dumps(), folder_.contacts()})
      std::filesystem::create_directories(path);
  }
  static void write(const std::filesystem::path& file, const std::string& text) {
    std::ofstream(file, std::ios::binary) << text;
  }
  std::filesystem::path dump(long record) const {
    return folder_.dumps() / ("dump." + std::to_string(record * plan_.step.steps_per_record) + ".txt");
  }
  std::filesystem::path restart(long part) const {
    return folder_.dem() / ("restart." + std::to_string(part * plan_.restart_steps));
  }
  /// Whole dumps, torques and energies of all records of so many parts.
  void write_parts(long parts) const {
    tests::write_rows(folder_, plan_, parts * plan_.restart_steps);
    for (long record = 0; record <= parts * plan_.restart_steps / plan_.step.steps_per_record; ++record)
      write(dump(record), dump_of(250));
  }

  TemporaryFolder temporary_;
  CaseFolder folder_{temporary_.path()};
  DemPlan plan_ = plan_dem(small_mill());
  std::filesystem::path file_ = temporary_.path() / "file";
};

TEST_F(OutputCheckTest, AWholeDumpIsTakenAndOneOfOtherBallsIsNot) {
  write(file_, dump_of(7));
  EXPECT_EQ(dump_complaint(file_, 7), "");
  EXPECT_EQ(dump_complaint(file_, any_number), "");
  EXPECT_EQ(dump_complaint(file_, 8), "7 entries, expected 8");
  write(file_, dump_of(0));
  EXPECT_EQ(dump_complaint(file_, any_number), "");
}

TEST_F(OutputCheckTest, ADumpCutAtAnyByteIsTold) {
  const std::string whole = dump_of(3);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    write(file_, whole.substr(0, size));
    EXPECT_NE(dump_complaint(file_, any_number), "") << size;
  }
}

TEST_F(OutputCheckTest, ADumpThatLacksALineInItsMiddleIsTold) {
  std::string text = dump_of(5);
  text.erase(text.find("3 1 "), text.find("4 1 ") - text.find("3 1 "));
  write(file_, text);
  EXPECT_NE(dump_complaint(file_, 5).find("with 13 complete lines, expected 14"), std::string::npos);
}

TEST_F(OutputCheckTest, ARestartFileOfSeveralRanksIsTakenWithAllItsBallsOnly) {
  tests::write_restart(file_, {5, 0, 3});
  EXPECT_EQ(restart_complaint(file_, 8), "");
  EXPECT_NE(restart_complaint(file_, 9), "");
  tests::write_restart(file_, {0, 8});
  EXPECT_EQ(restart_complaint(file_, 8), "");
}

TEST_F(OutputCheckTest, ARestartFileCutAtAnyByteIsTold) {
  tests::write_restart(file_, {6, 4});
  for (auto size = std::filesystem::file_size(file_); size > 0; --size) {
    std::filesystem::resize_file(file_, size - 1);
    EXPECT_NE(restart_complaint(file_, 10), "") << size - 1;
  }
}

TEST_F(OutputCheckTest, TheLastGoodRestartFileIsTheOneBeforeACutOne) {
  write_parts(2);
  for (const long part : {1, 2}) tests::write_restart(restart(part), {250});
  EXPECT_EQ(last_good_restart(folder_, plan_), 2 * plan_.restart_steps);
  write(restart(2), "");
  EXPECT_EQ(last_good_restart(folder_, plan_), plan_.restart_steps);
  write(restart(1), "");
  EXPECT_EQ(last_good_restart(folder_, plan_), std::nullopt);
}

TEST_F(OutputCheckTest, ARestartFileAfterADumpThatIsCutIsNotGood) {
  plan_.contact_steps = plan_.step.steps_per_record;
  write_parts(2);
  for (const long part : {1, 2}) tests::write_restart(restart(part), {250});
  const auto contacts = folder_.contacts() / ("walls." + std::to_string(2 * plan_.restart_steps) + ".txt");
  write(contacts, dump_of(12));
  EXPECT_EQ(last_good_restart(folder_, plan_), 2 * plan_.restart_steps);
  write(contacts, "");
  EXPECT_EQ(last_good_restart(folder_, plan_), plan_.restart_steps);
  write(dump(1), "");
  EXPECT_EQ(last_good_restart(folder_, plan_), std::nullopt);
}

TEST_F(OutputCheckTest, EveryDumpUpToTheStepIsCheckedOnceAndNoLaterOne) {
  write_parts(1);
  write(dump(2), "");
  OutputCheck check(folder_, plan_, 0);
  const long record = plan_.step.steps_per_record;
  EXPECT_EQ(message_of([&] { check.dumps_until(2 * record - 1); }), "");
  EXPECT_EQ(message_of([&] { check.dumps_until(2 * record); }).find(dump(2).string() + ": 0 bytes"), 0u);
  OutputCheck resumed(folder_, plan_, 3 * record);
  EXPECT_EQ(message_of([&] { resumed.dumps_until(5 * record); }), "");
}

TEST_F(OutputCheckTest, DumpsOfContactsAreCheckedAtTheirOwnSteps) {
  plan_.contact_steps = 40;
  for (const std::string kind : contact_kinds)
    for (const int step : {80, 120})
      write(folder_.contacts() / (kind + '.' + std::to_string(step) + ".txt"), dump_of(2));
  write(folder_.contacts() / "balls.120.txt", "");
  OutputCheck check(folder_, plan_, 50);
  EXPECT_EQ(message_of([&] { check.dumps_until(119); }), "");
  EXPECT_NE(message_of([&] { check.dumps_until(120); }).find("balls.120.txt: 0 bytes"), std::string::npos);
}

}  // namespace
}  // namespace millfoam::dem_driver
