// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/grids/box_grid.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "tests/averaging/test_support.hpp"

namespace millfoam::averaging {
namespace {

TEST(BoxGrid, FieldsRunFastestAlongXAndSlowestAlongZ) {
  const BoxGrid grid({0, 0, 0}, {2, 3, 4}, {2, 3, 4});
  EXPECT_EQ(grid.offset({1, 0, 0}), 1U);
  EXPECT_EQ(grid.offset({0, 1, 0}), 2U);
  EXPECT_EQ(grid.offset({0, 0, 1}), 6U);
  EXPECT_EQ(grid.offset({1, 2, 3}), grid.size() - 1);
}

TEST(BoxGrid, VolumeOfAllVoxelsIsTheBoxs) {
  const BoxGrid grid({-1, 0, 2}, {1, 0.5, 5}, {7, 3, 11});
  EXPECT_NEAR(grid.voxel_volume() * static_cast<double>(grid.size()), 2 * 0.5 * 3, 1e-14);
}

TEST(BoxGrid, ACentreLiesInItsOwnVoxel) {
  const BoxGrid grid({-0.06, -0.06, 0}, {0.06, 0.06, 0.024}, {11, 12, 2});
  EXPECT_EQ(grid.locate(grid.centre({10, 3, 1})).value(), (VoxelIndex{10, 3, 1}));
}

TEST(BoxGrid, AVoxelHoldsItsLowerFaceAndNotItsUpperOne) {
  const BoxGrid grid({0, 0, 0}, {4, 4, 4}, {4, 4, 4});
  EXPECT_EQ(grid.locate({1, 2, 3}).value(), (VoxelIndex{1, 2, 3}));
  EXPECT_FALSE(grid.locate({4, 1, 1}));
  EXPECT_FALSE(grid.locate({1, -1e-12, 1}));
}

TEST(BoxGrid, ThePointJustBelowTheUpperFaceLiesInTheLastVoxel) {
  const BoxGrid grid({0, 0, 0}, {0.3, 1, 1}, {3, 1, 1});
  EXPECT_EQ(grid.locate({std::nextafter(0.3, 0.0), 0.5, 0.5}).value(), (VoxelIndex{2, 0, 0}));
}

TEST(BoxGrid, APeriodicAxisRepeatsTheBox) {
  const BoxGrid grid({0, 0, 0}, {1, 1, 1}, {1, 1, 4}, {false, false, true});
  EXPECT_EQ(grid.locate({0.5, 0.5, 1.1}).value(), (VoxelIndex{0, 0, 0}));
  EXPECT_EQ(grid.locate({0.5, 0.5, -0.1}).value(), (VoxelIndex{0, 0, 3}));
  EXPECT_EQ(grid.locate({0.5, 0.5, -1e-20}).value(), (VoxelIndex{0, 0, 0}));
  EXPECT_FALSE(grid.locate({0.5, 1.1, 0.5}));
}

TEST(BoxGrid, AnImpossibleBoxIsRefusedWithItsAxis) {
  const auto turned = [] { BoxGrid({0, 1, 0}, {1, 0, 1}, {1, 1, 1}); };
  expect_named(message_of<std::invalid_argument>(turned), {"along y", "1", "0"});
  const auto empty = [] { BoxGrid({0, 0, 0}, {1, 1, 1}, {1, 1, 0}); };
  expect_named(message_of<std::invalid_argument>(empty), {"along z", "0", "at least 1"});
}

}  // namespace
}  // namespace millfoam::averaging
