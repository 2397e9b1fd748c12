// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/fields/cell_samples.hpp"

#include <gtest/gtest.h>

#include <set>

#include "averaging/grids/field_sampling.hpp"
#include "averaging/values/solids_window.hpp"
#include "tests/averaging/mesh_support.hpp"
#include "tests/averaging/test_support.hpp"

namespace millfoam::averaging {
namespace {

MeshGeometry shape_of(const TestMesh& mesh) {
  return MeshGeometry(mesh.topology, mesh.points);
}

Eigen::Isometry3d turned_by(double angle) {
  return Eigen::Isometry3d(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()));
}

TEST(CellSamples, CellsOfAVoxelsSizeHaveTheirCentroid) {
  const MeshGeometry mesh = shape_of(box_mesh({0, 0, 0}, {2, 1, 1}, {4, 2, 3}));
  const CellSamples samples(mesh, BoxGrid({0, 0, 0}, {2, 1, 1}, {4, 2, 3}));
  ASSERT_EQ(samples.size(), mesh.cells());
  for (std::size_t cell = 0; cell < mesh.cells(); ++cell)
    samples.for_points(cell, turned_by(0), [&](const Vector3& point, double share) {
      EXPECT_EQ(share, 1);
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_DOUBLE_EQ(point[k], mesh.centres()[cell][static_cast<Eigen::Index>(k)]);
    });
}

TEST(CellSamples, ThePointsOfACellHaveItsVolumeAndCentroid) {
  const MeshGeometry mesh = shape_of(warped(honeycomb_mesh(4, 4, 3, 0.1), 0.01));
  const CellSamples samples(mesh, BoxGrid({-1, -1, -1}, {2, 2, 2}, {90, 90, 90}));
  EXPECT_GT(samples.size(), 10 * mesh.cells());
  const Eigen::Isometry3d place = turned_by(0.7);
  for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
    double shares = 0;
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    samples.for_points(cell, place, [&](const Vector3& point, double share) {
      shares += share;
      mean += share * Eigen::Vector3d(point[0], point[1], point[2]);
    });
    EXPECT_NEAR(shares, 1, 1e-12);
    EXPECT_NEAR((mean - place * mesh.centres()[cell]).norm(), 0, 1e-12);
  }
}

/// Voxels that have a twentieth of a voxel or more in the trilinear interpolation at a point of a cell.
std::set<std::size_t> voxels_met(const MeshGeometry& mesh, const BoxGrid& grid, double angle) {
  SolidsWindow window;
  window.solidity.assign(grid.size(), 0.5);
  const CellSamples samples(mesh, grid);
  std::set<std::size_t> met;
  for (std::size_t cell = 0; cell < mesh.cells(); ++cell)
    samples.for_points(cell, turned_by(angle), [&](const Vector3& point, double) {
      for (const SolidsShare& one : solids_shares(grid, window, point))
        if (one.solidity > 0.05 * 0.5) met.insert(one.voxel);
    });
  return met;
}

TEST(CellSamples, NoVoxelInAThickerCellIsPassedOver) {
  // 2 to 25 voxels along a cell, at offsets that change from cell to cell
  const MeshGeometry mesh = shape_of(box_mesh({-1, -1, 0}, {1, 1, 1}, {4, 4, 3}));
  for (const int along : {7, 8, 13, 21, 34, 75}) {
    const BoxGrid grid({-1, -1, 0}, {1, 1, 1}, {4, 4, along});
    EXPECT_EQ(voxels_met(mesh, grid, 0).size(), grid.size()) << along;
  }
}

TEST(CellSamples, NoVoxelInAWiderCellIsPassedOverAtAnyAngle) {
  const MeshGeometry mesh = shape_of(box_mesh({-1, -1, 0}, {1, 1, 1}, {3, 3, 1}));
  const BoxGrid grid({-0.5, -0.5, 0}, {0.5, 0.5, 1}, {5, 5, 1});
  for (const double angle : {0.0, 0.3, 0.785, 1.2})
    EXPECT_EQ(voxels_met(mesh, grid, angle).size(), grid.size()) << angle;
}

TEST(CellSamples, OnlyTheLargerCellsOfAMeshAreDivided) {
  const MeshGeometry mesh = shape_of(box_mesh({0, 0, 0}, {1, 1, 1}, {1, 1, 4}));
  // Voxels as wide as the mesh, and thicker than a cell
  EXPECT_EQ(CellSamples(mesh, BoxGrid({0, 0, 0}, {1, 1, 1}, {1, 1, 3})).size(), mesh.cells());
  EXPECT_GT(CellSamples(mesh, BoxGrid({0, 0, 0}, {1, 1, 1}, {1, 1, 5})).size(), 10 * mesh.cells());
}

TEST(CellSamples, CellsAreDividedByTheirOwnLength) {
  // Layers of 1, 1 and 8 voxels
  TestMesh mesh = box_mesh({0, 0, 0}, {1, 1, 3}, {1, 1, 3});
  for (auto& point : mesh.points)
    if (point[2] > 2.5) point[2] = 10;
  const CellSamples samples(shape_of(mesh), BoxGrid({0, 0, 0}, {1, 1, 10}, {1, 1, 10}));
  std::vector<int> points(3, 0);
  for (std::size_t cell = 0; cell < 3; ++cell)
    samples.for_points(cell, turned_by(0), [&](const Vector3&, double) { ++points[cell]; });
  EXPECT_EQ(points[0], 1);
  EXPECT_EQ(points[1], 1);
  EXPECT_GT(points[2], 8);
}

TEST(CellSamples, ACellLongerThan25VoxelsIsRefused) {
  const MeshGeometry mesh = shape_of(box_mesh({0, 0, 0}, {1, 1, 1}, {1, 1, 1}));
  EXPECT_NO_THROW(CellSamples(mesh, BoxGrid({0, 0, 0}, {1, 1, 1}, {1, 1, 25})));
  try {
    CellSamples(mesh, BoxGrid({0, 0, 0}, {1, 1, 1}, {1, 1, 40}));
    FAIL() << "40 voxels were taken";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("40 voxels of the balls' averages long; expected at most 25"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace millfoam::averaging
