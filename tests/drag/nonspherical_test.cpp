// SPDX-License-Identifier: GPL-3.0-or-later
#include "openfoam_module/drag/nonspherical.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "openfoam_module/drag/drag_laws.hpp"

namespace drag = millfoam::drag;

TEST(Nonspherical, ALoneSlowSphereFeelsStokesDrag) {
  EXPECT_NEAR(drag::hoelzer_sommerfeld(0, 0, {1, 1}), 1, 1e-14);
}

TEST(Nonspherical, ALoneSphereHasHoelzerAndSommerfeldsDragCoefficient) {
  for (double re : {0.1, 10.0, 1e3, 1e5}) {
    const double drag_coefficient = 24 / re + 3 / std::sqrt(re) + 0.42;
    EXPECT_NEAR(drag::hoelzer_sommerfeld(0, re, {1, 1}) / (drag_coefficient * re / 24), 1, 1e-13) << re;
  }
}

TEST(Nonspherical, ValuesComputedApart) {
  // By a few lines of another language, to 12 digits
  EXPECT_NEAR(drag::hoelzer_sommerfeld(0, 100, {0.806, 0.806}) / 6.43637213808, 1, 1e-10);
  EXPECT_NEAR(drag::hoelzer_sommerfeld(0.45, 100, {0.806, 0.9}) / 70.8804108574, 1, 1e-10);
}

TEST(Nonspherical, CoefficientHasTheShapesFactor) {
  const drag::Fluid slurry{1239, 0.0014};
  const double d = 0.005, phi = 0.45, v = 0.2;
  const double factor = drag::hoelzer_sommerfeld(phi, drag::reynolds(phi, v, d, slurry), {0.9, 0.8});
  const double expected = 18 * 0.0014 * phi * (1 - phi) * (1 - phi) * factor / (d * d);
  EXPECT_NEAR(drag::exchange_coefficient(drag::Shape{0.9, 0.8}, phi, v, d, slurry) / expected, 1, 1e-12);
  EXPECT_EQ(drag::exchange_coefficient(drag::Shape{0.9, 0.8}, 0, v, d, slurry), 0);
  const double spheres = drag::exchange_coefficient(drag::hoelzer_sommerfeld_law(), phi, v, d, slurry);
  EXPECT_DOUBLE_EQ(drag::exchange_coefficient(drag::Shape{1, 1}, phi, v, d, slurry), spheres);
  EXPECT_LT(spheres, expected);
}

TEST(Nonspherical, OneShapesDragOverTheMeanIsThatOfTheLaw) {
  const drag::Shape round{1, 1}, blunt{0.8, 0.85};
  const std::vector<drag::ShapeShare> bed{{0.25, round}, {0.75, blunt}};
  for (const double phi : {0.0, 0.3, 0.6})
    for (const double re : {0.0, 1.0, 150.0, 1e4}) {
      const double of_round = drag::hoelzer_sommerfeld(phi, re, round);
      const double of_blunt = drag::hoelzer_sommerfeld(phi, re, blunt);
      const double mean = 0.25 * of_round + 0.75 * of_blunt;
      EXPECT_NEAR(drag::drag_over_mean(re, round, bed), of_round / mean, 1e-13) << re;
      EXPECT_NEAR(drag::drag_over_mean(re, blunt, bed), of_blunt / mean, 1e-13) << re;
    }
  EXPECT_EQ(drag::drag_over_mean(100, blunt, {{1, blunt}}), 1);
}

TEST(Nonspherical, SpheresInABedFeelAtMost23PerCentLessThanDiFelices) {
  double smallest = 1;
  for (double re = 1e-4; re < 1e4; re *= 1.05)
    for (double phi : {0.0, 0.3, 0.6}) {
      const double ratio = drag::hoelzer_sommerfeld(phi, re, {1, 1}) / drag::di_felice(phi, re);
      EXPECT_LT(ratio, 1.042) << re;
      smallest = std::min(smallest, ratio);
    }
  EXPECT_NEAR(smallest, 0.773, 0.0005);
}
