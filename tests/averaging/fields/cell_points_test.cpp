// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/fields/cell_points.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "tests/averaging/mesh_support.hpp"
#include "tests/averaging/test_support.hpp"

namespace millfoam::averaging {
namespace {

double sum(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

MeshGeometry geometry(const TestMesh& mesh) {
  return MeshGeometry(mesh.topology, mesh.points);
}

VoxelSums deposited(const MeshGeometry& mesh, int divisions, const BoxGrid& grid,
                    const Eigen::Isometry3d& place, const std::vector<double>& values) {
  VoxelSums sums(grid.size(), 1);
  CellPoints(mesh, divisions).deposit(grid, place, values, sums);
  return sums;
}

Eigen::Isometry3d turned(double angle) {
  return Eigen::Isometry3d(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()));
}

TEST(CellPoints, WhatIsInTheCellsIsInTheVoxelsOrOutside) {
  const MeshGeometry mesh = geometry(drum_mesh(1, 0.5, 4, 3, 2));
  std::vector<double> values;
  for (std::size_t c = 0; c < mesh.cells(); ++c) values.push_back(std::sin(static_cast<double>(c)));
  const double volume = sum(mesh.volumes());
  const double total = std::inner_product(values.begin(), values.end(), mesh.volumes().begin(), 0.0);
  const VoxelSums all = deposited(mesh, 2, BoxGrid({-1, -1, 0}, {1, 1, 0.5}, {7, 7, 2}), turned(0.3), values);
  EXPECT_NEAR(all.outside / volume, 0, 1e-12);
  EXPECT_NEAR(sum(all.volume) / volume, 1, 1e-12);
  EXPECT_NEAR(sum(all.values) / total, 1, 1e-12);
  const VoxelSums part = deposited(mesh, 2, BoxGrid({0, -1, 0}, {1, 1, 0.5}, {7, 7, 2}), turned(0.3), values);
  EXPECT_GT(part.outside, 0.4 * volume);
  EXPECT_NEAR((sum(part.volume) + part.outside) / volume, 1, 1e-12);
}

TEST(CellPoints, AUniformFieldStaysUniform) {
  const MeshGeometry mesh = geometry(drum_mesh(1, 0.5, 4, 3, 2));
  const std::vector<double> values(mesh.cells(), 3.5);
  const VoxelSums sums = deposited(mesh, 1, BoxGrid({-1, -1, 0}, {1, 1, 0.5}, {6, 6, 1}), turned(1), values);
  for (std::size_t v = 0; v < sums.volume.size(); ++v)
    EXPECT_NEAR(sums.values[v], 3.5 * sums.volume[v], 1e-14);
}

TEST(CellPoints, OfCellsThatAreTheVoxelsEachGetsItsOwn) {
  const BoxGrid grid({0, 0, 0}, {2, 1, 1}, {4, 3, 2});
  const MeshGeometry mesh = geometry(box_mesh({0, 0, 0}, {2, 1, 1}, {4, 3, 2}));
  std::vector<double> values(grid.size());
  std::iota(values.begin(), values.end(), 1.0);
  const VoxelSums sums = deposited(mesh, 3, grid, Eigen::Isometry3d::Identity(), values);
  for (std::size_t v = 0; v < grid.size(); ++v) {
    EXPECT_NEAR(sums.volume[v] / grid.voxel_volume(), 1, 1e-12);
    EXPECT_NEAR(sums.values[v] / sums.volume[v], values[v], 1e-12);
  }
}

TEST(CellPoints, AQuarterTurnOnAMatchingGridOnlyRenamesTheVoxels) {
  const BoxGrid grid({-1, -1, 0}, {1, 1, 1}, {4, 4, 1});
  const MeshGeometry mesh = geometry(box_mesh({-1, -1, 0}, {1, 1, 1}, {4, 4, 1}));
  std::vector<double> values(grid.size());
  std::iota(values.begin(), values.end(), 1.0);
  const VoxelSums sums = deposited(mesh, 2, grid, turned(std::acos(0.0)), values);
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 4; ++i) {
      // What was at (i, j) goes to (3 - j, i).
      EXPECT_NEAR(sums.values[grid.offset({3 - j, i, 0})] / grid.voxel_volume(),
                  values[grid.offset({i, j, 0})], 1e-12);
    }
  }
}

TEST(CellPoints, FinerOnesMeetTheVoxelsFacesBetter) {
  // Two cells of value 0 and 1 on three voxels: the middle one takes half of each.
  const MeshGeometry mesh = geometry(box_mesh({0, 0, 0}, {1, 1, 1}, {2, 2, 2}));
  const BoxGrid grid({0, 0, 0}, {1, 1, 1}, {3, 1, 1});
  const auto error = [&](int divisions) {
    const VoxelSums sums = deposited(mesh, divisions, grid, turned(0), std::vector<double>(8, 1.0));
    return std::abs(sums.volume[0] - 1.0 / 3);
  };
  EXPECT_LT(error(8), 0.3 * error(2));
}

TEST(CellPoints, ALinearFieldIsMetBetterByFinerMeshes) {
  const BoxGrid grid({-0.5, -0.5, 0}, {0.5, 0.5, 0.5}, {4, 4, 2});
  const auto error = [&](int n) {
    const MeshGeometry mesh = geometry(drum_mesh(1, 0.5, n, 3 * n / 4, n / 2));
    std::vector<double> values;
    for (const Eigen::Vector3d& centre : mesh.centres()) {
      values.push_back((turned(0.3) * centre).dot(Eigen::Vector3d(1, 2, 3)));
    }
    const VoxelSums sums = deposited(mesh, 4, grid, turned(0.3), values);
    double most = 0;
    for (int k = 0; k < 2; ++k) {
      for (int j = 0; j < 4; ++j) {
        for (int i = 0; i < 4; ++i) {
          const std::size_t v = grid.offset({i, j, k});
          const Vector3 middle = grid.centre({i, j, k});
          const double expected = middle[0] + 2 * middle[1] + 3 * middle[2];
          most = std::max(most, std::abs(sums.values[v] / sums.volume[v] - expected));
        }
      }
    }
    return most;
  };
  const double coarse = error(4), fine = error(16);
  EXPECT_LT(coarse, 0.2);       // half a cell of 0.2 times the gradient
  EXPECT_LT(fine, coarse / 4);  // of first order at least
}

TEST(CellPoints, AlongAPeriodicAxisTheMeshIsWrappedIntoTheGrid) {
  const MeshGeometry mesh = geometry(box_mesh({0, 0, 0}, {1, 1, 1}, {1, 1, 4}));
  const BoxGrid grid({0, 0, 0}, {1, 1, 1}, {1, 1, 4}, {false, false, true});
  const Eigen::Isometry3d moved(Eigen::Translation3d(0, 0, -2.25));
  const VoxelSums sums = deposited(mesh, 1, grid, moved, {1, 2, 3, 4});
  EXPECT_EQ(sums.outside, 0);
  const std::vector<double> expected{2, 3, 4, 1};  // a quarter down
  for (std::size_t v = 0; v < 4; ++v) EXPECT_NEAR(sums.values[v], expected[v] / 4, 1e-14);
}

TEST(CellPoints, WarpedAndHollowCellsKeepTheirVolume) {
  const TestMesh mesh = warped(honeycomb_mesh(4, 4, 3, 0.1), 0.01);
  const MeshGeometry shape = geometry(mesh);
  const BoxGrid grid({-1, -1, -1}, {2, 2, 2}, {31, 29, 30});
  const VoxelSums sums = deposited(shape, 3, grid, turned(0.5), std::vector<double>(shape.cells(), 1.0));
  EXPECT_EQ(sums.outside, 0);
  EXPECT_NEAR(sum(sums.volume) / sum(shape.volumes()), 1, 1e-12);
}

TEST(CellPoints, SeveralComponentsAndCallsAddUp) {
  const MeshGeometry mesh = geometry(box_mesh({0, 0, 0}, {1, 1, 1}, {2, 1, 1}));
  const BoxGrid grid({0, 0, 0}, {1, 1, 1}, {2, 1, 1});
  const CellPoints points(mesh, 1);
  VoxelSums sums(grid.size(), 2);
  points.deposit(grid, turned(0), {1, 10, 2, 20}, sums);
  points.deposit(grid, turned(0), {3, 30, 4, 40}, sums);
  const std::vector<double> expected{2, 20, 3, 30};
  for (std::size_t v = 0; v < 4; ++v) EXPECT_NEAR(sums.values[v], expected[v], 1e-14);
  EXPECT_NEAR(sums.volume[0], 1, 1e-14);
}

TEST(CellPoints, DivisionsThatCannotBeAreRefused) {
  const MeshGeometry mesh = geometry(box_mesh({0, 0, 0}, {1, 1, 1}, {1, 1, 1}));
  expect_named(message_of<std::invalid_argument>([&] { CellPoints(mesh, 0); }), {"by 0", "1 to 10"});
}

}  // namespace
}  // namespace millfoam::averaging
