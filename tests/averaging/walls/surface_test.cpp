// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/walls/surface.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/averaging/mesh_support.hpp"
#include "tests/averaging/walls/walls_support.hpp"

namespace millfoam::averaging {
namespace {

using Eigen::Vector3d;

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

}  // namespace
}  // namespace millfoam::averaging
