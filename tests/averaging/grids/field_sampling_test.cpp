// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/grids/field_sampling.hpp"

#include <gtest/gtest.h>

namespace millfoam::averaging {
namespace {

SolidsWindow empty_window(const BoxGrid& grid) {
  const std::size_t n = grid.size();
  return {
      std::vector<double>(n), std::vector<double>(3 * n), std::vector<double>(n), std::vector<double>(n), {}};
}

void fill(SolidsWindow& window, std::size_t n, double solidity, const Vector3& velocity, double diameter) {
  window.solidity[n] = solidity;
  for (std::size_t a = 0; a < 3; ++a) window.velocity[3 * n + a] = velocity[a];
  window.diameter[n] = window.diameter43[n] = diameter;
}

double linear_solidity(const Vector3& p) {
  return 0.2 + 0.03 * p[0] - 0.02 * p[1] + 0.01 * p[2];
}
double linear_flux(const Vector3& p) {
  return 0.1 - 0.05 * p[0] + 0.02 * p[1] + 0.04 * p[2];
}

/// phi and phi*u linear in space, d uniform, on voxels of different edges.
struct LinearField : ::testing::Test {
  BoxGrid grid{{-1, -2, 0}, {1, 2, 3}, {4, 5, 3}};
  SolidsWindow window = empty_window(grid);

  LinearField() {
    for (int k = 0; k < 3; ++k) {
      for (int j = 0; j < 5; ++j) {
        for (int i = 0; i < 4; ++i) {
          const Vector3 centre = grid.centre({i, j, k});
          const double phi = linear_solidity(centre);
          fill(window, grid.offset({i, j, k}), phi, {linear_flux(centre) / phi, 0, -1}, 0.005);
        }
      }
    }
  }
};

TEST_F(LinearField, IsReproducedBetweenTheCentres) {
  for (const Vector3& point : {Vector3{0.1, 0.2, 1.7}, Vector3{-0.6, 1.5, 0.6}, Vector3{0.7, -1.55, 2.4}}) {
    const LocalSolids local = sample(grid, window, point, Interpolation::linear);
    EXPECT_TRUE(local.inside);
    EXPECT_NEAR(local.solidity, linear_solidity(point), 1e-14);
    EXPECT_NEAR(local.solidity * local.velocity[0], linear_flux(point), 1e-14);
    EXPECT_NEAR(local.velocity[2], -1, 1e-14);
    EXPECT_NEAR(local.diameter, 0.005, 1e-15);
  }
}

TEST_F(LinearField, IsItsVoxelsWhenReadByCell) {
  const LocalSolids local = sample(grid, window, {0.9, 1.9, 2.9}, Interpolation::cell);
  EXPECT_EQ(local.solidity, window.solidity[grid.offset({3, 4, 2})]);
  EXPECT_EQ(local.velocity[0], window.velocity[3 * grid.offset({3, 4, 2})]);
  EXPECT_EQ(local.diameter43, 0.005);
}

TEST_F(LinearField, StaysConstantInTheOuterHalfVoxels) {
  const double corner = window.solidity[grid.offset({3, 4, 2})];
  EXPECT_DOUBLE_EQ(sample(grid, window, {0.99, 1.99, 2.99}, Interpolation::linear).solidity, corner);
}

TEST_F(LinearField, IsNothingOutsideTheGridAndSaysSo) {
  for (const auto how : {Interpolation::cell, Interpolation::linear}) {
    const LocalSolids local = sample(grid, window, {1.01, 0, 1}, how);
    EXPECT_FALSE(local.inside);
    EXPECT_EQ(local.solidity, 0);
    EXPECT_EQ(local.velocity, (Vector3{0, 0, 0}));
    EXPECT_EQ(local.diameter, 0);
  }
}

TEST(FieldSampling, TowardsAnEmptyVoxelTheVelocityStaysTheParticles) {
  const BoxGrid grid({0, 0, 0}, {2, 1, 1}, {2, 1, 1});
  SolidsWindow window = empty_window(grid);
  fill(window, 0, 0.6, {1, -2, 3}, 0.004);
  const LocalSolids local = sample(grid, window, {1.25, 0.5, 0.5}, Interpolation::linear);
  EXPECT_NEAR(local.solidity, 0.25 * 0.6, 1e-15);
  EXPECT_NEAR(local.velocity[0], 1, 1e-15);
  EXPECT_NEAR(local.velocity[1], -2, 1e-15);
  EXPECT_NEAR(local.diameter, 0.004, 1e-17);
}

TEST(FieldSampling, BetweenTwoSizesTheDiametersAreTheMixtures) {
  const BoxGrid grid({0, 0, 0}, {2, 1, 1}, {2, 1, 1});
  SolidsWindow window = empty_window(grid);
  fill(window, 0, 0.2, {}, 0.002);
  fill(window, 1, 0.4, {}, 0.008);
  const LocalSolids local = sample(grid, window, {1, 0.5, 0.5}, Interpolation::linear);
  // (0.1 + 0.2)/(0.1/0.002 + 0.2/0.008) = 0.3/75 and (0.1*0.002 + 0.2*0.008)/0.3
  EXPECT_NEAR(local.diameter, 0.004, 1e-17);
  EXPECT_NEAR(local.diameter43, 0.006, 1e-17);
}

TEST(FieldSampling, AlongAPeriodicAxisTheLastVoxelIsTheFirstOnesNeighbour) {
  const BoxGrid grid({0, 0, 0}, {1, 1, 4}, {1, 1, 4}, {false, false, true});
  SolidsWindow window = empty_window(grid);
  fill(window, 0, 0.1, {0, 0, 1}, 0.005);
  fill(window, 3, 0.5, {0, 0, 1}, 0.005);
  for (const double z : {0.0, 4.0, -4.0}) {
    EXPECT_NEAR(sample(grid, window, {0.5, 0.5, z}, Interpolation::linear).solidity, 0.3, 1e-15);
  }
  EXPECT_NEAR(sample(grid, window, {0.5, 0.5, 3.75}, Interpolation::linear).solidity, 0.4, 1e-15);
}

TEST(FieldSampling, AVoxelInTheWallIsUnknownAndNotEmpty) {
  const BoxGrid grid({0, 0, 0}, {3, 1, 1}, {3, 1, 1});
  SolidsWindow window = empty_window(grid);
  fill(window, 0, 0.6, {1, 0, 0}, 0.005);
  fill(window, 1, 0.4, {2, 0, 0}, 0.005);
  window.inside_fraction = {1, 0.5, 0};
  EXPECT_NEAR(sample(grid, window, {2.4, 0.5, 0.5}, Interpolation::linear).solidity, 0.4, 1e-15);
  EXPECT_NEAR(sample(grid, window, {1, 0.5, 0.5}, Interpolation::linear).solidity, (0.6 + 0.5 * 0.4) / 1.5,
              1e-15);
  EXPECT_EQ(sample(grid, window, {2.9, 0.5, 0.5}, Interpolation::linear).solidity, 0);
}

TEST(FieldSampling, OnACylinderIsLinearInItsCoordinatesAndGoesRoundTheAngle) {
  const CylinderGrid grid({0.5, 1.5}, {0, 1}, {2, 4, 1});
  SolidsWindow window;
  const std::size_t n = grid.size();
  window = {std::vector<double>(n, 0.1),
            std::vector<double>(3 * n),
            std::vector<double>(n, 0.005),
            std::vector<double>(n, 0.005),
            {}};
  window.solidity[grid.offset({0, 0, 0})] = 0.3;
  window.solidity[grid.offset({0, 3, 0})] = 0.5;
  // Half-way between the last and the first sector is the +x axis.
  EXPECT_NEAR(sample(grid, window, {0.75, 0, 0.5}, Interpolation::linear).solidity, 0.4, 1e-14);
  EXPECT_NEAR(sample(grid, window, {1.0, 0, 0.5}, Interpolation::linear).solidity, 0.25, 1e-14);
  EXPECT_NEAR(sample(grid, window, {0.75, 0, 0.5}, Interpolation::cell).solidity, 0.3, 1e-15);
  EXPECT_FALSE(sample(grid, window, {0.1, 0, 0.5}, Interpolation::cell).inside);
}

}  // namespace
}  // namespace millfoam::averaging
