// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/dumps/dump_header.hpp"

#include <gtest/gtest.h>

#include "averaging/dumps/dump_series.hpp"
#include "tests/averaging/dumps/dump_support.hpp"

namespace millfoam::averaging {
namespace {

TEST(DumpHeader, AHeaderAloneIsRefused) {
  const std::string text = dump_text(1, random_balls(2, 1));
  const std::size_t columns = text.find("ITEM: ATOMS");
  expect_named(refusal_of_dump(text.substr(0, columns)), {"dump7.txt:9", "ends here", "truncated"});
  expect_named(refusal_of_dump(text.substr(0, text.find('\n', columns) + 1)),
               {"dump7.txt:10", "particle 1 of 2", "truncated"});
}

TEST(DumpHeader, CountsThatCannotBeAreRefused) {
  std::string text = dump_text(1, random_balls(2, 1));
  const std::size_t place = text.find("ATOMS\n2") + 6;
  for (const std::string count :
       {"-1", "9000000000000000000", "90000000000000000000", "2.0", "1e9", "", "two", "3"}) {
    std::string broken = text;
    expect_named(refusal_of_dump(broken.replace(place, 1, count)), {"dump7.txt:"});
  }
}

TEST(DumpHeader, FlagsOfTheBoxSayAlongWhichAxesItRepeats) {
  const TemporaryFolder folder;
  std::string text = dump_text(1, random_balls(2, 1));
  const auto box_of = [&](const std::string& flags) {
    std::string other = text;
    other.replace(other.find(" mm mm pp"), 9, flags);
    return *read_dump_header(folder.write("dump.txt", other)).box;
  };
  const auto periodic_of = [&](const std::string& flags) { return box_of(flags).periodic(); };
  EXPECT_EQ(periodic_of(" ff mm pp"), (std::array<bool, 3>{false, false, true}));
  EXPECT_EQ(periodic_of(" xy xz yz pp ff pp"), (std::array<bool, 3>{true, false, true}));
  EXPECT_EQ(periodic_of(""), (std::array<bool, 3>{}));
  EXPECT_EQ(box_of(" xy xz yz pp ff fs").flags, (std::array<std::string, 3>{"pp", "ff", "fs"}));
  EXPECT_EQ(box_of(" xy xz yz").flags, (std::array<std::string, 3>{}));
  EXPECT_EQ(box_of("").flags, (std::array<std::string, 3>{})) << "none is not the same as others than pp";
}

TEST(DumpHeader, AnItemThatIsThereTwiceIsRefused) {
  std::string text = dump_text(1, random_balls(2, 1));
  expect_named(refusal_of_dump("ITEM: TIMESTEP\n4\n" + text), {"dump7.txt:3", "'ITEM: TIMESTEP'", "twice"});
  expect_named(
      refusal_of_dump(text.substr(0, text.find("ITEM: BOX")) + text.substr(text.find("ITEM: NUMBER"))),
      {"dump7.txt:5", "'ITEM: NUMBER OF ATOMS'", "twice"});
}

}  // namespace
}  // namespace millfoam::averaging
