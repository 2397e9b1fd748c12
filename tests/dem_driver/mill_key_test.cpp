// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/mill_key.hpp"

#include <gtest/gtest.h>

namespace millfoam::dem_driver {
namespace {

TEST(MillKey, AnErrorHasTheFormOfThoseOfTheMill) {
  const KeyError error("dem.seed", "7", "less");
  EXPECT_STREQ(error.what(), "key 'dem.seed' = 7: expected less");
  EXPECT_EQ(error.key(), "dem.seed");
}

}  // namespace
}  // namespace millfoam::dem_driver
