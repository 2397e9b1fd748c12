// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/grids/cylinder_grid.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include "tests/averaging/test_support.hpp"

namespace millfoam::averaging {
namespace {

TEST(CylinderGrid, FieldsRunFastestAlongRAndSlowestAlongZ) {
  const CylinderGrid grid({0, 1}, {0, 1}, {2, 3, 4});
  EXPECT_EQ(grid.offset({1, 0, 0}), 1U);
  EXPECT_EQ(grid.offset({0, 1, 0}), 2U);
  EXPECT_EQ(grid.offset({0, 0, 1}), 6U);
  EXPECT_EQ(grid.offset({1, 2, 3}), grid.size() - 1);
}

TEST(CylinderGrid, VolumesAddUpToTheShells) {
  const CylinderGrid grid({0.5, 2}, {-1, 3}, {7, 5, 3});
  double sum = 0;
  for (int n = 0; n < 7 * 5 * 3; ++n) sum += grid.voxel_volume({n % 7, n / 7 % 5, n / 35});
  EXPECT_NEAR(sum, pi * (4 - 0.25) * 4, 1e-13);
}

TEST(CylinderGrid, ACentreLiesInItsOwnVoxel) {
  const CylinderGrid grid({0.1, 0.4}, {0, 0.2}, {3, 40, 2});
  for (int n = 0; n < 3 * 40 * 2; ++n) {
    const VoxelIndex voxel{n % 3, n / 3 % 40, n / 120};
    EXPECT_EQ(grid.locate(grid.centre(voxel)).value(), voxel);
  }
}

TEST(CylinderGrid, ThetaGoesFromXTowardsY) {
  const CylinderGrid grid({0, 2}, {0, 1}, {1, 4, 1});
  EXPECT_EQ(grid.locate({1, 0, 0}).value()[1], 0);
  EXPECT_EQ(grid.locate({1, 0.1, 0}).value()[1], 0);
  EXPECT_EQ(grid.locate({-0.1, 1, 0}).value()[1], 1);
  EXPECT_EQ(grid.locate({-1, -0.1, 0}).value()[1], 2);
  EXPECT_EQ(grid.locate({1, -0.1, 0}).value()[1], 3);
  EXPECT_EQ(grid.locate({1, -1e-300, 0}).value()[1], 3);
}

TEST(CylinderGrid, AVoxelHoldsItsLowerFacesAndNotItsUpperOnes) {
  const CylinderGrid grid({1, 3}, {0, 2}, {2, 1, 2});
  EXPECT_EQ(grid.locate({2, 0, 1}).value(), (VoxelIndex{1, 0, 1}));
  EXPECT_TRUE(grid.locate({1, 0, 0}));
  EXPECT_FALSE(grid.locate({3, 0, 1}));
  EXPECT_FALSE(grid.locate({0.99, 0, 1}));
  EXPECT_FALSE(grid.locate({2, 0, 2}));
}

TEST(CylinderGrid, EveryPointOfItLiesInAVoxelAroundIt) {
  const CylinderGrid grid({0.3, 1}, {0, 2}, {4, 9, 5});
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-1.1, 1.1);
  for (int n = 0; n < 20000; ++n) {
    const Vector3 point{place(random), place(random), 1 + place(random)};
    const double radius = std::hypot(point[0], point[1]);
    const auto voxel = grid.locate(point);
    ASSERT_EQ(voxel.has_value(), radius >= 0.3 && radius < 1 && point[2] >= 0 && point[2] < 2);
    if (!voxel) continue;
    const Vector3 centre = grid.centre(*voxel);
    EXPECT_LE(std::abs(radius - std::hypot(centre[0], centre[1])), grid.spacing()[0] / 2 + 1e-15);
    EXPECT_LE(std::abs(std::atan2(centre[0] * point[1] - centre[1] * point[0],
                                  centre[0] * point[0] + centre[1] * point[1])),
              grid.spacing()[1] / 2 + 1e-15);
    EXPECT_LE(std::abs(point[2] - centre[2]), grid.spacing()[2] / 2 + 1e-15);
  }
}

TEST(CylinderGrid, APeriodicOneRepeatsAlongZ) {
  const CylinderGrid grid({0, 1}, {1, 3}, {1, 1, 4}, true);
  EXPECT_EQ(grid.locate({0.5, 0, 3.1}).value(), (VoxelIndex{0, 0, 0}));
  EXPECT_EQ(grid.locate({0.5, 0, 0.9}).value(), (VoxelIndex{0, 0, 3}));
  EXPECT_EQ(grid.locate({0.5, 0, std::nextafter(1.0, 0.0)}).value(), (VoxelIndex{0, 0, 0}));  // rounds to 3
}

TEST(CylinderGrid, AnImpossibleOneIsRefusedWithWhatIsWrong) {
  const auto message = [](const std::array<double, 2>& radii, const std::array<double, 2>& ends,
                          const VoxelIndex& shape) {
    return message_of<std::invalid_argument>([&] { CylinderGrid(radii, ends, shape); });
  };
  expect_named(message({-1, 2}, {0, 1}, {1, 1, 1}), {"radii", "-1", "2"});
  expect_named(message({1, 1}, {0, 1}, {1, 1, 1}), {"radii", "1"});
  expect_named(message({0, 1}, {2, 1}, {1, 1, 1}), {"ends", "2", "1"});
  expect_named(message({0, 1}, {0, std::numeric_limits<double>::infinity()}, {1, 1, 1}), {"ends", "inf"});
  expect_named(message({0, 1}, {0, 1}, {1, 0, 1}), {"theta", "0", "at least 1"});
}

}  // namespace
}  // namespace millfoam::averaging
