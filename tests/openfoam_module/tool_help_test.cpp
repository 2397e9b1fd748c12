// SPDX-License-Identifier: GPL-3.0-or-later
/// --help and --version of tools that are built on OpenFOAM, and the sense of a rotation in words.
#include "openfoam_module/record/tool_help.hpp"

#include <gmock/gmock.h>

#include <sstream>

#include "averaging/values/sense_of_rotation.hpp"
#include "millfoam_version.hpp"
#include "openfoam_module/record/rotation.hpp"

namespace millfoam::record {
namespace {

const ToolHelp help{
    "slurryStart", "Sets slurry", {"[-case DIR]"}, {"system/slurryStartDict  how"}, {"0/alpha.slurry"}};

/// What the tool prints about itself; "-" if it starts its work.
std::string printed(std::vector<const char*> words) {
  words.insert(words.begin(), "/somewhere/slurryStart");
  std::ostringstream out;
  return printed_help_or_version(static_cast<int>(words.size()), words.data(), help, out) ? out.str()
                                                                                          : "-" + out.str();
}

TEST(ToolHelp, SaysWhatTheToolReadsAndWrites) {
  EXPECT_THAT(printed({"--help"}),
              ::testing::HasSubstr("Sets slurry.\n\nUsage: slurryStart [-case DIR]\n\nReads:\n"
                                   "  system/slurryStartDict  how\n\nWrites:\n  0/alpha.slurry\n"));
}

TEST(ToolHelp, IsFoundAmongOtherOptions) {
  EXPECT_THAT(printed({"-case", "x", "--help"}), ::testing::HasSubstr("Reads:"));
}

TEST(ToolHelp, TellsTheVersionOfTheProgram) {
  EXPECT_EQ(printed({"--version"}), std::string("slurryStart ") + millfoam::version() + "\n");
}

TEST(ToolHelp, LeavesEverythingElseToOpenFoam) {
  EXPECT_EQ(printed({}), "-");
  EXPECT_EQ(printed({"-help"}), "-");
  EXPECT_EQ(printed({"-case", "x"}), "-");
}

TEST(Rotation, PositiveIsAnticlockwiseWithXToTheRightAndYUp) {
  EXPECT_STREQ(averaging::sense_of_rotation(2.0), "anticlockwise");
  EXPECT_EQ(described_rotation(-6.1), "clockwise, seen with x to the right and y up");
  EXPECT_EQ(described_rotation(0), "does not turn");
  EXPECT_STREQ(averaging::sense_of_rotation(0), "none");
}

}  // namespace
}  // namespace millfoam::record
