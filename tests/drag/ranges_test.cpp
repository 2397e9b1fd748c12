// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "openfoam_module/drag/drag_laws.hpp"

namespace drag = millfoam::drag;

namespace {

bool law_within(const char* name, double phi, double re) {
  return drag::within(drag::find_law(name).range, phi, re);
}

}  // namespace

TEST(DragRanges, ThoseWithoutLimitsHoldEverywhere) {
  for (const char* name : {"ErgunWenYu", "Benyahia", "DiFelice"})
    for (double phi : {1e-6, 0.3, 0.7})
      for (double re : {0.0, 10.0, 1e6}) EXPECT_TRUE(law_within(name, phi, re)) << name;
}

TEST(DragRanges, BeetstraIsFittedBetweenFourLimits) {
  EXPECT_TRUE(law_within("Beetstra", 0.1, 20));
  EXPECT_TRUE(law_within("Beetstra", 0.6, 1000));
  EXPECT_FALSE(law_within("Beetstra", 0.0999, 100));
  EXPECT_FALSE(law_within("Beetstra", 0.6001, 100));
  EXPECT_FALSE(law_within("Beetstra", 0.5, 19.9));
  EXPECT_FALSE(law_within("Beetstra", 0.5, 1001));
}

TEST(DragRanges, EndsInReynoldsNumber) {
  for (const auto& [name, end] :
       {std::pair{"Hill", 200.0}, std::pair{"Tang", 1000.0}, std::pair{"Tenneti", 300.0},
        std::pair{"KozenyCarman", 2.3}, std::pair{"Darcy", 2.3}}) {
    EXPECT_TRUE(law_within(name, 0.45, end)) << name;
    EXPECT_FALSE(law_within(name, 0.45, 1.001 * end)) << name;
    EXPECT_TRUE(law_within(name, 0.45, 0)) << name;
  }
}

TEST(DragRanges, EndsInSolidity) {
  for (const auto& [name, end] :
       {std::pair{"WenYu", 0.2}, std::pair{"Tang", 0.6}, std::pair{"Tenneti", 0.5}}) {
    EXPECT_TRUE(law_within(name, end, 1)) << name;
    EXPECT_FALSE(law_within(name, 1.001 * end, 1)) << name;
  }
  for (const auto& [name, begin] :
       {std::pair{"Ergun", 0.2}, std::pair{"Fand", 0.55}, std::pair{"KozenyCarman", 0.4},
        std::pair{"Darcy", 0.2}, std::pair{"Hill", 0.0953}, std::pair{"Rong", 0.2}}) {
    EXPECT_TRUE(law_within(name, begin, 1)) << name;
    EXPECT_FALSE(law_within(name, 0.999 * begin, 1)) << name;
  }
}

TEST(DragRanges, GapsOfFandCountAsWithin) {
  for (double re : {3.0, 100.0}) EXPECT_TRUE(law_within("Fand", 0.6, re));
}

TEST(DragRanges, NoSolidsAreWithinEveryRange) {
  for (const drag::Law& law : drag::laws())
    for (double re : {0.0, 1e6}) EXPECT_TRUE(drag::within(law.range, 0, re)) << law.name;
}

TEST(DragRanges, NotANumberIsOutside) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const drag::Law& law : drag::laws()) {
    EXPECT_FALSE(drag::within(law.range, nan, 1)) << law.name;
    EXPECT_FALSE(drag::within(law.range, 0.5, nan)) << law.name;
  }
}

TEST(DragRanges, EveryRangeHoldsSomething) {
  for (const drag::Law& law : drag::laws()) {
    EXPECT_LT(law.range.phi_min, law.range.phi_max) << law.name;
    EXPECT_LT(law.range.re_min, law.range.re_max) << law.name;
  }
}
