// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/dumps/dump_series.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

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

TEST(DumpSeries, KnowsTheNumbersOfBallsWhereTheyCanBeRead) {
  const TemporaryFolder folder;
  folder.write("dump1.txt", dump_text(1, {{1, {0, 0, 0}, {}, 0.1}, {2, {1, 0, 0}, {}, 0.1}}));
  folder.write("dump2.txt", "ITEM: TIMESTEP\n2\nITEM: NUMBER OF ATOMS\n");
  folder.write("dump3.txt", "ITEM: TIMESTEP\n3\n");
  const std::vector<DumpFile> dumps = find_dumps((folder / "dump*.txt").string());
  ASSERT_EQ(dumps.size(), 3U);
  EXPECT_EQ(dumps[0].count, 2);
  EXPECT_FALSE(dumps[1].count || dumps[2].count);
}

TEST(DumpSeries, AlternativesInBracesAreOneSeries) {
  const TemporaryFolder folder;
  for (const char* name : {"dump.0.txt", "dump.200.txt.gz", "dump.400.txt.part"})
    folder.write(name, dump_text(std::atoi(name + 5), {}));
  const std::vector<DumpFile> dumps = find_dumps((folder / "dump.*.txt{,.gz}").string());
  ASSERT_EQ(dumps.size(), 2U);
  EXPECT_EQ(dumps[1].path.filename(), "dump.200.txt.gz");
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

}  // namespace
}  // namespace millfoam::averaging
