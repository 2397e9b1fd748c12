// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/results/mesh_results.hpp"

#include <gtest/gtest.h>

#include "tests/meshing/test_mill.hpp"

namespace millfoam::meshing {
namespace {

/// A case of a mill whose averages begin after 0.1 s, or when the charge is steady.
struct StartOfFlow : ::testing::Test {
  TemporaryFolder folder;
  Mill mill;

  StartOfFlow() {
    mill.flow.balls = true;
    mill.averages.start = 0.1;
    mill.fingerprint.averages = "00000000000000aa";
  }
  void write_solids(const std::string& averages, double time) const {
    folder.write("solids.json",
                 R"({"mill": {"averages": ")" + averages + R"("}, "time0_s": )" + std::to_string(time) + "}");
  }
  FlowBegin start() const { return start_of_flow(mill, folder.path()); }
};

TEST_F(StartOfFlow, is_that_of_the_averages_where_they_are_there) {
  EXPECT_EQ(start().time, 0.1);
  // Of a dry run that continues another one, averages.start counts from its begin
  write_solids(mill.fingerprint.averages, 0.5);
  EXPECT_EQ(start().time, 0.5);
  EXPECT_EQ(start().note, "");
  mill.averages.start = std::nullopt;
  EXPECT_EQ(start().time, 0.5);
  // Averages by options of millAverage have no fingerprint
  write_solids("", 0.75);
  EXPECT_EQ(start().time, 0.75);
}

TEST_F(StartOfFlow, is_not_that_of_the_averages_of_another_mill) {
  write_solids("00000000000000bb", 0.5);
  EXPECT_EQ(start().time, 0.1);
  EXPECT_NE(
      start().note.find("solids.json: the averages are of another mill (averages 00000000000000bb, this "
                        "mill's are 00000000000000aa): the mesh is turned to averages.start"),
      std::string::npos)
      << start().note;
  mill.averages.start = std::nullopt;
  try {
    start();
    FAIL() << "the time is not known";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("solids.json: the averages are of another mill"),
              std::string::npos);
  }
}

TEST_F(StartOfFlow, is_0_while_the_steady_time_is_not_known_and_without_balls) {
  mill.averages.start = std::nullopt;
  EXPECT_EQ(start().time, 0);
  EXPECT_NE(start().note.find("call millMesh again after millAverage"), std::string::npos);
  mill.flow.balls = false;
  write_solids("00000000000000bb", 0.5);
  EXPECT_EQ(start().time, 0);
  EXPECT_EQ(start().note, "");
}

}  // namespace
}  // namespace millfoam::meshing
