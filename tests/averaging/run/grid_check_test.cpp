// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/run/grid_check.hpp"

#include <gtest/gtest.h>

#include "averaging/run/average_request.hpp"
#include "tests/averaging/test_support.hpp"

namespace millfoam::averaging {
namespace {

/// Two equal balls of 10 mm, 0.1 m apart along x.
const ParticleRecord balls{0, {{1, {0, 0, 0.05}, {}, 0.005}, {2, {0.1, 0, 0.05}, {}, 0.005}}, {}};

std::string misfit_of(const GridRequest& grid, double largest_outside = 0.5,
                      const ParticleRecord& record = balls) {
  const CellSetup setup = set_up(AverageRequest(grid), {1e-5, 0.0, 0.01}, [](const std::string&) {});
  return misfit(setup, record, 0, "dump0.txt", largest_outside);
}

TEST(GridCheck, PassesABoxAroundTheBallsAndOneAroundHalfOfThem) {
  EXPECT_EQ(misfit_of(BoxGrid({-0.2, -0.2, 0}, {0.2, 0.2, 0.1}, {4, 4, 1})), "");
  EXPECT_EQ(misfit_of(BoxGrid({-0.02, -0.02, 0}, {0.02, 0.02, 0.1}, {2, 2, 1})), "");
}

TEST(GridCheck, ABoxThatMissesTheBallsIsNamedWithBothExtents) {
  const BoxGrid shifted({0.2, -0.2, 0}, {0.6, 0.2, 0.1}, {4, 4, 1});
  expect_named(misfit_of(shifted), {"dump0.txt: 100 % of the balls' volume lies outside", "x 0.2 to 0.6",
                                    "x -0.005 to 0.105, y -0.005 to 0.005, z 0.045 to 0.055 m",
                                    "expected metres", "--tolerance"});
  EXPECT_EQ(misfit_of(shifted, 1), "") << "a part of the balls may be meant";
}

TEST(GridCheck, OnlyTheBallsVolumeOutsideCounts) {
  const BoxGrid around_one({-0.02, -0.02, 0}, {0.02, 0.02, 0.1}, {2, 2, 1});
  EXPECT_EQ(misfit_of(around_one, 0.5), "");
  expect_named(misfit_of(around_one, 0.49), {"50 % of the balls' volume"});
}

TEST(GridCheck, LengthsInMillimetresAreFarTooLarge) {
  expect_named(misfit_of(BoxGrid({-200, -200, 0}, {200, 200, 100}, {4, 4, 1}, {false, false, true})),
               {"fill only", "far too large", "x -200 to 200", "z 0 to 100 m", "expected metres"});
  expect_named(misfit_of(CylinderGrid({0, 200}, {0, 100}, {2, 4, 1})),
               {"far too large", "r 0 to 200, z 0 to 100 m", "expected metres"});
}

TEST(GridCheck, ARecordWithoutBallsSaysNothing) {
  EXPECT_EQ(misfit_of(BoxGrid({1, 1, 1}, {2, 2, 2}, {1, 1, 1}), 0, {0, {}, {}}), "");
}

}  // namespace
}  // namespace millfoam::averaging
