// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/walls/surface.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "averaging/walls/stl_file.hpp"
#include "tests/averaging/mesh_support.hpp"
#include "tests/averaging/walls/walls_support.hpp"

namespace millfoam::averaging {
namespace {

using Eigen::Vector3d;

/// Only some of a surface's triangles.
Surface part_of(const Surface& surface, std::size_t first, std::size_t end) {
  Surface part;
  part.points = surface.points;
  part.triangles.assign(surface.triangles.begin() + static_cast<std::ptrdiff_t>(first),
                        surface.triangles.begin() + static_cast<std::ptrdiff_t>(end));
  return part;
}

std::string binary_stl(const Surface& surface) {
  std::string bytes = "solid that is binary";
  bytes.resize(80);
  const auto put = [&](const auto& value) {
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    bytes.append(raw, sizeof value);
  };
  put(static_cast<std::uint32_t>(surface.triangles.size()));
  for (const auto& triangle : surface.triangles) {
    bytes.append(12, '\0');
    for (const int corner : triangle) {
      for (const double x : surface.points[static_cast<std::size_t>(corner)]) put(static_cast<float>(x));
    }
    bytes.append(2, '\0');
  }
  return bytes;
}

std::string refusal(const std::vector<std::filesystem::path>& files) {
  return message_of<SurfaceError>([&] { read_surface(files); });
}

TEST(Surface, PartsInSeveralFilesAndSolidsMakeOne) {
  const TemporaryFolder folder;
  const Surface box = box_surface({0, 0, 0}, {1, 2, 3});
  const auto first = folder.write("a.stl", stl_text(part_of(box, 0, 5)));
  const auto second = folder.write(
      "b.stl", stl_text(part_of(box, 5, 9)) + "\n" + stl_text(part_of(box, 9, 12), "of two words"));
  const Surface surface = read_surface({first, second});
  EXPECT_EQ(surface.points.size(), 8U);
  EXPECT_EQ(surface.triangles.size(), 12U);
  EXPECT_EQ(surface.caps, 0U);
  EXPECT_NEAR(enclosed_volume(surface), 6, 1e-14);
}

TEST(Surface, BinaryGivesTheSameAsAscii) {
  const TemporaryFolder folder;
  const Surface ball = ball_surface({0.5, 0.25, 4}, 0.5, 20);
  const Surface ascii = read_surface({folder.write("a.stl", stl_text(ball))});
  const Surface binary = read_surface({folder.write("b.stl", binary_stl(ball))});
  EXPECT_EQ(binary.triangles, ascii.triangles);
  EXPECT_NEAR(enclosed_volume(binary), enclosed_volume(ball), 1e-6);  // single precision
}

TEST(Surface, WindowsLineEndsAndPlusSignsAreRead) {
  const TemporaryFolder folder;
  std::string windows;
  for (const char c : stl_text(box_surface({1, 1, 1}, {2, 2, 2})))
    windows += c == '\n' ? "\r\n" : std::string(1, c);
  const std::size_t vertex = windows.find("vertex 1");
  windows.replace(vertex, 8, "vertex +1");
  windows.resize(windows.size() - 2);
  EXPECT_NEAR(enclosed_volume(read_surface({folder.write("a.stl", windows)})), 1, 1e-14);
}

TEST(Surface, PointsThatDifferByRoundOffAreOne) {
  const TemporaryFolder folder;
  const Surface ball = ball_surface({0, 0, 0}, 1, 16);
  std::ostringstream rounded;  // to six digits, after a change that may alter the last one
  rounded << "solid x\n";
  int count = 0;
  for (const auto& triangle : ball.triangles) {
    rounded << "facet normal 0 0 0\nouter loop\n";
    for (const int corner : triangle) {
      const Vector3d p = ball.points[static_cast<std::size_t>(corner)] * (1 + (++count % 3 - 1) * 4e-7);
      rounded << "vertex " << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
    }
    rounded << "endloop\nendfacet\n";
  }
  rounded << "endsolid\n";
  const Surface surface = read_surface({folder.write("a.stl", rounded.str())});
  EXPECT_EQ(surface.points.size(), ball.points.size());
  EXPECT_NEAR(enclosed_volume(surface), enclosed_volume(ball), 1e-5);
}

TEST(Surface, ASliceIsClosedAtItsEnds) {
  const TemporaryFolder folder;
  // A drum with one lifter: not convex, and no point of it sees all of its outline.
  const std::vector<Eigen::Vector2d> outline{{1, -1},      {1, 1},    {0.1, 1}, {0.1, -0.5},
                                             {-0.1, -0.5}, {-0.1, 1}, {-1, 1},  {-1, -1}};
  const Surface open = prism(outline, 0, 0.5, false);
  const Surface surface = read_surface({folder.write("slice.stl", stl_text(open))});
  EXPECT_EQ(surface.caps, 16U);
  EXPECT_NEAR(enclosed_volume(surface), (4 - 0.2 * 1.5) * 0.5, 1e-14);
}

TEST(Surface, OneThatLooksInwardsIsTurned) {
  const TemporaryFolder folder;
  Surface box = box_surface({0, 0, 0}, {1, 2, 3});
  for (auto& triangle : box.triangles) std::swap(triangle[0], triangle[1]);
  EXPECT_NEAR(enclosed_volume(read_surface({folder.write("a.stl", stl_text(box))})), 6, 1e-14);
}

TEST(Surface, AHoleIsRefusedWithItsEdgeAndTheFiles) {
  const TemporaryFolder folder;
  const Surface ball = ball_surface({0, 0, 0}, 1, 8);
  const auto file = folder.write("ball.stl", stl_text(part_of(ball, 0, ball.triangles.size() - 1)));
  expect_named(refusal({file}), {"ball.stl", "not a closed surface", "3 such edges", "no neighbour"});
}

TEST(Surface, ATriangleTurnedRoundIsRefused) {
  const TemporaryFolder folder;
  Surface box = box_surface({0, 0, 0}, {1, 2, 3});
  std::swap(box.triangles[0][0], box.triangles[0][1]);
  expect_named(refusal({folder.write("box.stl", stl_text(box))}), {"box.stl", "do not agree"});
}

TEST(Surface, OfAMeshHoldsTheVolumeOfItsCells) {
  const TestMesh mesh = warped(box_mesh({0, 0, 0}, {1, 1, 2}, {3, 4, 5}), 0.05);
  const MeshGeometry geometry(mesh.topology, mesh.points);
  double volume = 0;
  for (const double cell : geometry.volumes()) volume += cell;
  EXPECT_NEAR(enclosed_volume(boundary_surface(geometry)) / volume, 1, 1e-13);
}

TEST(StlFile, AWrongWordIsToldWithItsLine) {
  const TemporaryFolder folder;
  std::string text = stl_text(box_surface({0, 0, 0}, {1, 2, 3}));
  text.replace(text.find("endloop"), 7, "endlop!");
  expect_named(refusal({folder.write("wall.stl", text)}), {"wall.stl:7", "endlop!", "'endloop'"});
  expect_named(refusal({folder.write("notes.txt", "mill of 12 lifters\n")}),
               {"notes.txt:1", "mill of", "'solid'"});
}

TEST(StlFile, ACoordinateThatIsNoFiniteNumberIsToldWithItsPlace) {
  const TemporaryFolder folder;
  const Surface box = box_surface({0, 0, 0}, {1, 2, 3});
  for (const std::string word : {"nan", "1.0.0", "1e999", ""}) {
    std::string text = stl_text(box);
    text.replace(text.find("vertex 0 0 0"), 12, "vertex 0 0 " + word);
    expect_named(refusal({folder.write("wall.stl", text)}), {"wall.stl:4", "vertex 0 0 " + word, "finite"});
  }
  std::string binary = binary_stl(box);
  const float infinite = INFINITY;
  std::memcpy(binary.data() + 84 + 50 + 16, &infinite, 4);
  expect_named(refusal({folder.write("wall.stl", binary)}), {"wall.stl", "byte 150", "finite"});
}

TEST(StlFile, AFileCutAtAnyByteIsRefused) {
  const TemporaryFolder folder;
  const Surface triangle = part_of(box_surface({0, 0, 0}, {1, 2, 3}), 0, 1);
  for (const std::string& text : {stl_text(triangle), binary_stl(triangle)}) {
    // Without the name of its last solid an ASCII file is still whole.
    const std::size_t end = text.rfind("endsolid");
    const std::size_t whole = end == std::string::npos ? text.size() : end + 8;
    EXPECT_EQ(read_stl(folder.write("whole.stl", text.substr(0, whole))).size(), 1U);
    for (std::size_t length = 0; length < whole; ++length) {
      const auto cut = folder.write("cut.stl", text.substr(0, length));
      EXPECT_THROW(read_stl(cut), SurfaceError) << "cut after " << length << " bytes";
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
               {"is cut short: there are 50 bytes", "expected 84 for the header of a binary STL"});
}

TEST(StlFile, OneThatIsNotThereIsNamed) {
  expect_named(refusal({"gone.stl"}), {"gone.stl", "open"});
  EXPECT_THROW(read_surface({}), SurfaceError);
}

}  // namespace
}  // namespace millfoam::averaging
