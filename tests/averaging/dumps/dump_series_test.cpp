// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/dumps/dump_series.hpp"

#include <gtest/gtest.h>

#include "tests/averaging/test_support.hpp"

namespace millfoam::averaging {
namespace {

TEST(DumpSeries, IsInOrderOfTimeAndNotOfNames) {
  const TemporaryFolder folder;
  for (const long long step : {800, 1000, 200}) {
    folder.write("dump" + std::to_string(step) + ".txt", dump_text(step, {}));
  }
  const std::vector<DumpFile> dumps = find_dumps((folder / "dump*.txt").string());
  ASSERT_EQ(dumps.size(), 3U);
  EXPECT_EQ(dumps[0].path.filename(), "dump200.txt");
  EXPECT_EQ(dumps[1].step, 800);
  EXPECT_EQ(dumps[2].path.filename(), "dump1000.txt");
}

TEST(DumpSeries, APatternThatMatchesNothingIsRefusedByItsName) {
  const TemporaryFolder folder;
  const std::string pattern = (folder / "dump*.liggghts").string();
  expect_named(message_of<DumpError>([&] { find_dumps(pattern); }), {"no dump", pattern});
}

TEST(DumpSeries, TwoDumpsOfOneTimeAreRefusedByTheirNames) {
  const TemporaryFolder folder;
  folder.write("a1.txt", dump_text(400, {}));
  folder.write("a2.txt", dump_text(600, {}));
  folder.write("b2.txt", dump_text(600, {}));
  const auto doubled = [&] { find_dumps((folder / "*.txt").string()); };
  expect_named(message_of<DumpError>(doubled), {"a2.txt", "b2.txt", "600"});
}

TEST(RunNotes, GiveTheTimestepAndTheInterval) {
  const TemporaryFolder folder;
  folder.write("run.txt", "timestep 2e-06\r\nangular_velocity -6.395\ninterval 1000\n");
  const auto notes = read_run_notes(folder / "");
  ASSERT_TRUE(notes);
  EXPECT_EQ(notes->timestep, 2e-6);
  EXPECT_EQ(notes->interval, 1000);
  EXPECT_EQ(agreed_timestep({}, notes), 2e-6);
  EXPECT_EQ(agreed_timestep(2e-6, notes), 2e-6);
}

TEST(RunNotes, ATimestepThatContradictsThemIsRefusedWithBothValues) {
  const TemporaryFolder folder;
  folder.write("run.txt", "timestep 2e-06\n");
  const auto other = [&] { agreed_timestep(1e-5, read_run_notes(folder / "")); };
  expect_named(message_of<DumpError>(other), {"1e-05", "2e-06", "run.txt"});
}

TEST(RunNotes, WithoutThemTheTimestepMustBeGiven) {
  const TemporaryFolder folder;
  EXPECT_FALSE(read_run_notes(folder / ""));
  EXPECT_EQ(agreed_timestep(1e-6, std::nullopt), 1e-6);
  expect_named(message_of<DumpError>([] { agreed_timestep(std::nullopt, std::nullopt); }),
               {"--dt", "run.txt"});
  expect_named(message_of<DumpError>([] { agreed_timestep(-1e-6, std::nullopt); }), {"-1e-06", "positive"});
}

TEST(RunNotes, AValueThatCannotBeIsRefusedWithItsLine) {
  const TemporaryFolder folder;
  folder.write("run.txt", "interval 1000\ntimestep zero\n");
  expect_named(message_of<DumpError>([&] { read_run_notes(folder / ""); }),
               {"run.txt:2", "timestep", "'zero'"});
}

TEST(RunNotes, MayLackTheLastLineEnd) {
  const TemporaryFolder folder;
  const auto notes =
      read_run_notes(folder.write("run.txt", "timestep 1e-3\nangular_velocity -6.4").parent_path());
  ASSERT_TRUE(notes.has_value());
  EXPECT_EQ(notes->angular_velocity, -6.4);
}

TEST(RunNotes, AnAngularVelocityThatContradictsTheOptionIsRefused) {
  const TemporaryFolder folder;
  const auto notes = read_run_notes(folder.write("run.txt", "angular_velocity -6.4\n").parent_path());
  EXPECT_EQ(agreed_angular_velocity(std::nullopt, notes), -6.4);
  EXPECT_EQ(agreed_angular_velocity(-6.4, notes), -6.4);
  EXPECT_EQ(agreed_angular_velocity(3.0, std::nullopt), 3.0);
  EXPECT_EQ(agreed_angular_velocity(std::nullopt, std::nullopt), std::nullopt);
  expect_named(message_of<DumpError>([&] { agreed_angular_velocity(3.0, notes); }), {"--speed", "3", "-6.4"});
}

}  // namespace
}  // namespace millfoam::averaging
