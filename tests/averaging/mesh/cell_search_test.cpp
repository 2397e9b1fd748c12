// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/mesh/cell_search.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "averaging/mesh/cell_locator.hpp"
#include "averaging/mesh/cell_tree.hpp"
#include "tests/averaging/mesh_support.hpp"
#include "tests/averaging/test_support.hpp"

namespace millfoam::averaging {
namespace {

using Eigen::Vector3d;

/// One mesh with both ways to find its cells.
struct Searches {
  std::shared_ptr<const MeshGeometry> geometry;
  CellLocator locator;
  CellTree tree;

  explicit Searches(const TestMesh& mesh)
      : geometry(std::make_shared<const MeshGeometry>(mesh.topology, mesh.points)),
        locator(geometry),
        tree(*geometry) {}

  /// The cell that both find.
  int locate(const Vector3d& point, int hint = -1) const {
    const int cell = locator.locate(point, hint);
    EXPECT_EQ(tree.locate(point, hint), cell) << point.transpose();
    return cell;
  }
};

/// How often a ray from the point crosses the facets of a cell: odd inside. It knows nothing of planes with
/// room between them, grids or solid angles.
bool is_inside_by_ray(const MeshGeometry& geometry, int cell, const Vector3d& point) {
  const Vector3d along(0.36, 0.48, 0.8);
  int crossings = 0;
  const auto [begin, end] = geometry.facets_of(cell);
  for (const int* f = begin; f != end; ++f) {
    const Facet& facet = geometry.facets()[static_cast<std::size_t>(*f)];
    for (int i = 2; i < facet.corner_count; ++i) {
      const auto corner = [&](int c) -> Vector3d {
        return geometry.points()[static_cast<std::size_t>(facet.corners[static_cast<std::size_t>(c)])] -
               point;
      };
      const Vector3d a = corner(0), b = corner(i - 1), c = corner(i);
      const bool left = along.dot(a.cross(b)) > 0;
      if (left != (along.dot(b.cross(c)) > 0) || left != (along.dot(c.cross(a)) > 0)) continue;
      const Vector3d normal = (b - a).cross(c - a);
      if (normal.dot(a) / normal.dot(along) > 0) ++crossings;
    }
  }
  return crossings % 2 == 1;
}

Vector3d random_point(std::mt19937& random, const Eigen::AlignedBox3d& box) {
  std::uniform_real_distribution<double> part(-0.05, 1.05);
  const Vector3d parts(part(random), part(random), part(random));
  return box.min() + parts.cwiseProduct(box.sizes());
}

/// Cells joined in threes, many of them not convex.
TestMesh joined_drum() {
  const TestMesh mesh = drum_mesh(0.06, 0.024, 4, 2, 3);
  std::vector<int> into;
  for (std::size_t c = 0; c < mesh.topology.cells; ++c) into.push_back(static_cast<int>(c / 3));
  return warped(joined(mesh, into), 0.0005);
}

struct NamedMesh {
  const char* name;
  TestMesh mesh;
};

class CellSearchOn : public ::testing::TestWithParam<NamedMesh> {};

TEST_P(CellSearchOn, RandomPointsFindsTheCellThatRaysFind) {
  const Searches searches(GetParam().mesh);
  std::mt19937 random(5);
  int inside = 0, hint = -1;
  for (int i = 0; i < 4000; ++i) {
    const Vector3d point = random_point(random, searches.geometry->box());
    std::vector<int> found;
    for (int cell = 0; cell < static_cast<int>(searches.geometry->cells()); ++cell) {
      const auto& box = searches.geometry->boxes()[static_cast<std::size_t>(cell)];
      if (box.contains(point) && is_inside_by_ray(*searches.geometry, cell, point)) found.push_back(cell);
    }
    ASSERT_LE(found.size(), 1U);
    const int cell = searches.locate(point);
    ASSERT_EQ(cell, found.empty() ? -1 : found[0]) << point.transpose();
    ASSERT_EQ(searches.locate(point, hint), cell);
    if (cell >= 0) hint = cell;
    inside += cell >= 0 ? 1 : 0;
  }
  EXPECT_GT(inside, 1000);
}

/// Points on faces, edges and corners, with the cells that they touch.
TEST_P(CellSearchOn, PointsOnFacesEdgesAndCornersFindsACellThatTouchesThem) {
  const Searches searches(GetParam().mesh);
  const MeshGeometry& geometry = *searches.geometry;
  const double room = 1e-9 * geometry.box().diagonal().norm();
  std::mt19937 random(6);
  std::uniform_real_distribution<double> part(0, 1);
  for (const Facet& facet : geometry.facets()) {
    const auto corner = [&](std::size_t c) -> const Vector3d& {
      return geometry.points()[static_cast<std::size_t>(facet.corners[c])];
    };
    const double u = part(random), v = (1 - u) * part(random);
    const Vector3d on_face = corner(0) + u * (corner(1) - corner(0)) + v * (corner(2) - corner(0));
    const Vector3d on_edge = corner(0) + u * (corner(1) - corner(0));
    for (const Vector3d& point : {on_face, on_edge, corner(0), corner(1)}) {
      const int cell = searches.locate(point);
      ASSERT_GE(cell, 0) << point.transpose();
      const auto& box = geometry.boxes()[static_cast<std::size_t>(cell)];
      EXPECT_LT(box.exteriorDistance(point), room);
    }
    const int on = searches.locate(on_face);
    EXPECT_TRUE(on == facet.owner || on == facet.neighbour);
  }
}

TEST_P(CellSearchOn, TheCentresOfItsStarShapedCellsFindsThem) {
  const Searches searches(GetParam().mesh);
  const MeshGeometry& geometry = *searches.geometry;
  for (int cell = 0; cell < static_cast<int>(geometry.cells()); ++cell) {
    const Vector3d& centre = geometry.centres()[static_cast<std::size_t>(cell)];
    if (!is_inside_by_ray(geometry, cell, centre)) continue;
    EXPECT_EQ(searches.locate(centre), cell);
  }
}

TEST_P(CellSearchOn, BoxesListsAllCellsThatMeetThem) {
  const Searches searches(GetParam().mesh);
  std::mt19937 random(7);
  std::vector<int> listed;
  for (int i = 0; i < 200; ++i) {
    Eigen::AlignedBox3d box(random_point(random, searches.geometry->box()));
    box.extend(box.min() + 0.1 * searches.geometry->box().sizes());
    std::set<int> holding;
    for (int n = 0; n < 50; ++n) {
      const int cell = searches.locate(box.sample());
      if (cell >= 0) holding.insert(cell);
    }
    for (const CellSearch* search : {static_cast<const CellSearch*>(&searches.locator),
                                     static_cast<const CellSearch*>(&searches.tree)}) {
      search->candidates(box, listed);
      const std::set<int> found(listed.begin(), listed.end());
      EXPECT_TRUE(std::includes(found.begin(), found.end(), holding.begin(), holding.end()));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Meshes, CellSearchOn,
    ::testing::Values(NamedMesh{"Boxes", box_mesh({-1, 2, 0}, {1, 3, 0.5}, {5, 4, 3})},
                      NamedMesh{"Drum", drum_mesh(0.06, 0.024, 4, 2, 3)},
                      NamedMesh{"WarpedDrum", warped(drum_mesh(0.06, 0.024, 4, 2, 3), 0.0012)},
                      NamedMesh{"WarpedHexagons", warped(honeycomb_mesh(4, 3, 3, 0.1), 0.008)},
                      NamedMesh{"JoinedCells", joined_drum()},
                      NamedMesh{"FarFromTheOrigin", box_mesh({1000, 0, 0}, {1001, 1, 1}, {4, 4, 4})}),
    [](const auto& test) { return test.param.name; });

TEST(CellSearch, GivesCommonPointsOfBoxesToTheLowestCell) {
  const std::array<int, 3> n{4, 3, 2};
  const Searches searches(box_mesh({0, 0, 0}, {4, 3, 2}, n));
  for (int k = 0; k <= 2 * n[2]; ++k) {
    for (int j = 0; j <= 2 * n[1]; ++j) {
      for (int i = 0; i <= 2 * n[0]; ++i) {
        const auto lowest = [](int twice) { return std::max(0, (twice - 1) / 2); };
        EXPECT_EQ(searches.locate({i / 2.0, j / 2.0, k / 2.0}),
                  (lowest(k) * n[1] + lowest(j)) * n[0] + lowest(i));
      }
    }
  }
}

TEST(CellSearch, FindsNothingOutsideOrForWhatIsNotANumber) {
  const Searches searches(drum_mesh(0.06, 0.024, 4, 2, 3));
  const double none = std::numeric_limits<double>::quiet_NaN(), far = std::numeric_limits<double>::infinity();
  for (const Vector3d& point :
       {Vector3d(0.0599, 0.01, 0.01), Vector3d(0, 0, -1e-6), Vector3d(0, 0, 0.0240001), Vector3d(1e300, 0, 0),
        Vector3d(none, 0, 0), Vector3d(0, far, 0.01)}) {
    EXPECT_EQ(searches.locate(point), -1) << point.transpose();
  }
}

TEST(CellLocator, SettlesCrowdedCornersOfAGradedMesh) {
  TestMesh mesh = box_mesh({0, 0, 0}, {1, 1, 1}, {12, 12, 12});
  for (Vector3d& point : mesh.points) point = point.array().pow(4);
  const Searches searches(mesh);
  for (int cell = 0; cell < 1728; ++cell) {
    EXPECT_EQ(searches.locate(searches.geometry->centres()[static_cast<std::size_t>(cell)]), cell);
  }
}

TEST(CellTree, IsFittedToSmallMovesAndBuiltAnewForLargeOnes) {
  const TestMesh mesh = box_mesh({-1, -1, 0}, {1, 1, 0.1}, {48, 48, 1});
  MeshGeometry geometry(mesh.topology, mesh.points);
  CellTree tree(geometry);
  // A vortex: the sheet is wound up.
  const auto wound = [&](double turn) {
    MeshPoints points = mesh.points;
    for (Vector3d& p : points) p = Eigen::AngleAxisd(turn * p.head<2>().norm(), Vector3d::UnitZ()) * p;
    return points;
  };
  const auto finds_its_cells = [&] {
    for (int cell = 0; cell < 48 * 48; ++cell) {
      if (tree.locate(geometry.centres()[static_cast<std::size_t>(cell)]) != cell) return false;
    }
    return true;
  };
  geometry.move(wound(0.05));
  tree.update();
  EXPECT_TRUE(finds_its_cells());
  EXPECT_EQ(tree.builds(), 1);
  geometry.move(wound(3));
  tree.update();
  EXPECT_TRUE(finds_its_cells());
  EXPECT_GT(tree.builds(), 1);
}

}  // namespace
}  // namespace millfoam::averaging
