// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/wall_check.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <fstream>
#include <limits>

#include "small_mill.hpp"

namespace millfoam::dem_driver {
namespace {

using tests::message_of;
using tests::TemporaryFolder;

const std::string one_facet =
    "  facet normal 0 0 1\n    outer loop\n      vertex 0 0 0\n      vertex 0.01 0 0\n"
    "      vertex 0.01 0.02 0\n    endloop\n  endfacet\n";
const std::string text = "solid shell\n" + one_facet + one_facet + "endsolid shell\n";

/// Two triangles.
std::string binary(std::string header = "exported walls", float coordinate = 0.01F) {
  header.resize(80);
  const auto put = [&](const auto& value) {
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    header.append(raw, sizeof value);
  };
  put(std::uint32_t{2});
  for (int triangle = 0; triangle < 2; ++triangle) {
    for (const float x : {0.F, 0.F, 1.F, 0.F, 0.F, 0.F, coordinate, 0.F, 0.F, 0.01F, 0.02F, 0.F}) put(x);
    put(std::uint16_t{0});
  }
  return header;
}

class WallCheck : public ::testing::Test {
 protected:
  /// What is wrong with a file of these bytes, from its name on; empty when nothing is.
  std::string complaint(const std::string& bytes) {
    std::ofstream(file_, std::ios::binary) << bytes;
    const std::string message = message_of([&] { read_wall(file_); });
    return message.empty() ? message : message.substr(message.find("shell.stl"));
  }

  TemporaryFolder temporary_;
  std::filesystem::path file_ = temporary_.path() / "shell.stl";
};

TEST_F(WallCheck, AWholeFileIsTaken) {
  EXPECT_EQ(complaint(text), "");
  EXPECT_EQ(complaint("\n" + text + text), "");
  EXPECT_EQ(complaint(binary()), "");
}

TEST_F(WallCheck, ATextCutAtAnyByteIsRefused) {
  const std::size_t whole = text.rfind(" shell");  // the name at the end may be missing
  for (std::size_t length = 0; length < whole; ++length) {
    const std::string message = complaint(text.substr(0, length));
    EXPECT_NE(message.find("expected"), std::string::npos) << "cut after " << length << ": " << message;
  }
}

TEST_F(WallCheck, ATextThatIsCutIsToldWithItsLastLine) {
  EXPECT_EQ(
      complaint(text.substr(0, text.find("vertex 0.01 0.02") + 11)),
      "shell.stl:6: is cut short: it ends with 'vertex 0.01', expected 'endsolid' at the end of a text STL");
}

TEST_F(WallCheck, ABinaryFileCutAtAnyByteIsRefused) {
  for (std::size_t length = 0; length < binary().size(); ++length)
    EXPECT_NE(complaint(binary().substr(0, length)).find("expected"), std::string::npos) << length;
}

TEST_F(WallCheck, ABinaryFileThatIsCutIsToldWithTheBytesThatItsTrianglesNeed) {
  const std::string expected =
      "shell.stl: is cut short: there are 150 bytes, expected 184 for the 2 triangles announced in its "
      "header";
  EXPECT_EQ(complaint(binary().substr(0, 150)), expected);
  EXPECT_EQ(complaint(binary("solid of CAD").substr(0, 150)), expected);
  EXPECT_EQ(complaint(binary().substr(0, 30)),
            "shell.stl: is cut short: there are 30 bytes, expected at least the 84 of a binary STL's header");
  EXPECT_EQ(complaint(binary() + "more").substr(0, 49), "shell.stl: is too long: there are 188 bytes, expe");
}

TEST_F(WallCheck, ACoordinateThatIsNotFiniteIsRefused) {
  std::string infinite = text;
  infinite.replace(infinite.find("0.02"), 4, "inf");
  EXPECT_EQ(complaint(infinite), "shell.stl:6: 'inf': expected three coordinates, finite numbers");
  EXPECT_NE(complaint(binary("walls", std::numeric_limits<float>::quiet_NaN())).find("not finite"),
            std::string::npos);
}

TEST_F(WallCheck, AFileWithoutATriangleIsRefused) {
  EXPECT_EQ(complaint("solid shell\nendsolid shell\n"), "shell.stl: has no triangles");
  std::string none = binary().substr(0, 84);
  none[80] = 0;
  EXPECT_EQ(complaint(none), "shell.stl: has no triangles");
}

TEST_F(WallCheck, AFileThatIsNoStlIsToldWithItsFirstWord) {
  EXPECT_EQ(complaint("mill of 12 lifters\n"),
            "shell.stl: begins with 'mill', expected the word 'solid' of a text STL, or a binary STL");
}

TEST_F(WallCheck, WhatLiggghtsWouldTakeForAnotherFormIsRefused) {
  EXPECT_NE(complaint(binary("solid of CAD")).find("begins with 'solid', expected another header"),
            std::string::npos);
  std::string capitals = text;
  capitals.replace(capitals.rfind("endfacet"), 8, "ENDFACET");
  EXPECT_NE(complaint(capitals).find("2 triangles and 1 lines 'endfacet'"), std::string::npos);
  EXPECT_NE(complaint(text + std::string(20, '\0')).find("has a zero at byte"), std::string::npos);
}

TEST_F(WallCheck, AFolderInThePlaceOfTheFileIsRefused) {
  std::filesystem::create_directory(file_);
  EXPECT_NE(message_of([&] { read_wall(file_); }).find("shell.stl: cannot be read"), std::string::npos);
}

}  // namespace
}  // namespace millfoam::dem_driver
