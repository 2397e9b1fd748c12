// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/grids/neighbours.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "tests/averaging/test_support.hpp"

namespace millfoam::averaging {
namespace {

using Pairs = std::vector<std::array<int, 2>>;

Pairs sorted(Pairs pairs) {
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

TEST(Neighbours, OfABoxAreVoxelsOneStepApart) {
  const Pairs pairs = neighbours(BoxGrid({0, 0, 0}, {1, 1, 1}, {3, 2, 1}));
  EXPECT_EQ(sorted(pairs), (Pairs{{0, 1}, {0, 3}, {1, 2}, {1, 4}, {2, 5}, {3, 4}, {4, 5}}));
}

TEST(Neighbours, AreAsManyAsInnerFaces) {
  const Pairs pairs = neighbours(BoxGrid({0, 0, 0}, {1, 1, 1}, {4, 5, 6}));
  EXPECT_EQ(pairs.size(), 3U * 5 * 6 + 4U * 4 * 6 + 4U * 5 * 5);
}

TEST(Neighbours, AlongAPeriodicAxisJoinTheLastToTheFirst) {
  const auto along_z = [](int nz) {
    return sorted(neighbours(BoxGrid({0, 0, 0}, {1, 1, 1}, {1, 1, nz}, {false, false, true})));
  };
  EXPECT_EQ(along_z(4), (Pairs{{0, 1}, {0, 3}, {1, 2}, {2, 3}}));
  EXPECT_EQ(along_z(2), (Pairs{{0, 1}}));  // two faces in common, one pair
  EXPECT_TRUE(along_z(1).empty());
}

TEST(Neighbours, OfACylinderCloseTheRing) {
  const Pairs pairs = neighbours(CylinderGrid({0, 1}, {0, 1}, {2, 3, 1}));
  EXPECT_EQ(sorted(pairs), (Pairs{{0, 1}, {0, 2}, {0, 4}, {1, 3}, {1, 5}, {2, 3}, {2, 4}, {3, 5}, {4, 5}}));
}

TEST(Neighbours, OfAPeriodicCylinderJoinItsEnds) {
  const Pairs open = neighbours(CylinderGrid({0, 1}, {0, 1}, {2, 4, 5}));
  const Pairs closed = neighbours(CylinderGrid({0, 1}, {0, 1}, {2, 4, 5}, true));
  EXPECT_EQ(closed.size(), open.size() + 2 * 4);
  EXPECT_NE(std::find(closed.begin(), closed.end(), std::array<int, 2>{0, 2 * 4 * 4}), closed.end());
}

TEST(Neighbours, OfAGridWithMoreCellsThanAnIntAreRefused) {
  const BoxGrid grid({0, 0, 0}, {1, 1, 1}, {2000, 2000, 2000});
  expect_named(message_of<std::invalid_argument>([&] { neighbours(grid); }), {"8000000000", "2147483647"});
}

}  // namespace
}  // namespace millfoam::averaging
