// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/surface/stl_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <string>

#include "tests/averaging/walls/walls_support.hpp"

namespace millfoam::averaging {
namespace {

TEST(StlFile, AWrongWordIsToldWithItsLine) {
  const TemporaryFolder folder;
  std::string text = stl_text(box_surface({0, 0, 0}, {1, 2, 3}));
  text.replace(text.find("endloop"), 7, "endlop!");
  expect_named(refusal({folder.write("wall.stl", text)}), {"wall.stl:7", "endlop!", "'endloop'"});
  expect_named(refusal({folder.write("notes.txt", "mill of 12 lifters\n")}),
               {"notes.txt:1", "'mill'", "'solid'"});
}

TEST(StlFile, KeywordsMayBeInCapitals) {
  const TemporaryFolder folder;
  std::string text = stl_text(box_surface({0, 0, 0}, {1, 2, 3}));
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  EXPECT_NEAR(enclosed_volume(read_surface({folder.write("wall.stl", text)})), 6, 1e-12);
}

TEST(StlFile, ACoordinateThatIsNoFiniteNumberIsToldWithItsPlace) {
  const TemporaryFolder folder;
  const Surface box = box_surface({0, 0, 0}, {1, 2, 3});
  for (const std::string word : {"nan", "1.0.0", "1e999", ""}) {
    std::string text = stl_text(box);
    text.replace(text.find("vertex 0 0 0"), 12, "vertex 0 0 " + word);
    expect_named(refusal({folder.write("wall.stl", text)}), {"wall.stl:4", "'" + word + "'", "finite"});
  }
  std::string binary = binary_stl(box);
  const float infinite = INFINITY;
  std::memcpy(binary.data() + 84 + 50 + 16, &infinite, 4);
  expect_named(refusal({folder.write("wall.stl", binary)}), {"wall.stl", "triangle 2", "finite"});
}

TEST(StlFile, AFileCutAtAnyByteIsRefused) {
  const TemporaryFolder folder;
  const Surface triangle = part_of(box_surface({0, 0, 0}, {1, 2, 3}), 0, 1);
  for (const std::string& text : {stl_text(triangle), binary_stl(triangle)}) {
    // Without the name of its last solid an ASCII file is still whole.
    const std::size_t end = text.rfind("endsolid");
    const std::size_t whole = end == std::string::npos ? text.size() : end + 8;
    EXPECT_EQ(surface::read_stl(folder.write("whole.stl", text.substr(0, whole))).size(), 1U);
    for (std::size_t length = 0; length < whole; ++length) {
      const auto cut = folder.write("cut.stl", text.substr(0, length));
      EXPECT_THROW(surface::read_stl(cut), SurfaceError) << "cut after " << length << " bytes";
    }
  }
}

TEST(StlFile, ABinaryFileThatIsCutIsToldWithTheBytesThatItsTrianglesNeed) {
  const TemporaryFolder folder;
  const std::string whole = binary_stl(box_surface({0, 0, 0}, {1, 2, 3}));
  const auto cut_after = [&](std::size_t bytes) {
    return refusal({folder.write("wall.stl", whole.substr(0, bytes))});
  };
  expect_named(cut_after(200), {"wall.stl: is cut short: there are 200 bytes",
                                "expected 684 for the 12 triangles announced in its header"});
  expect_named(cut_after(50),
               {"is cut short: there are 50 bytes", "expected at least the 84 of a binary STL's header"});
}

TEST(StlFile, OneThatIsNotThereIsNamed) {
  expect_named(refusal({"gone.stl"}), {"gone.stl", "open"});
  EXPECT_THROW(read_surface({}), SurfaceError);
}

}  // namespace
}  // namespace millfoam::averaging
