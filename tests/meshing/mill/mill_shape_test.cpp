// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/mill/mill_shape.hpp"

#include <gtest/gtest.h>

#include "tests/meshing/test_geometry.hpp"

namespace millfoam::meshing {
namespace {

TEST(AnalyticVolume, of_a_smooth_drum_is_a_cylinders) {
  const Geometry drum = test_mill(0.12, 0, 0, 0, 0.003).geometry;
  EXPECT_NEAR(analytic_volume(drum), std::acos(-1.0) * 0.06 * 0.06 * 0.024, 1e-18);
}

TEST(AnalyticSection, with_lifters_is_what_counting_points_gives) {
  const Geometry mill = test_mill(0.12, 12, 0.008, 0.006, 0.003).geometry;
  const int n = 2000;
  long inside = 0;  // of the shell, in the rectangle 0.052 < x < 0.06, |y| < 0.003
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const double x = 0.052 + 0.008 * (i + 0.5) / n, y = 0.006 * ((j + 0.5) / n - 0.5);
      if (x * x + y * y < 0.06 * 0.06) ++inside;
    }
  }
  const double lifter = 0.008 * 0.006 * static_cast<double>(inside) / (1.0 * n * n);
  EXPECT_NEAR(analytic_section(mill), std::acos(-1.0) * 0.06 * 0.06 - 12 * lifter, 1e-8);
}

TEST(LifterSection, is_its_rectangle_and_the_circular_segment_under_it) {
  const Geometry mill = test_mill(0.12, 12, 0.008, 0.006, 0.003).geometry;
  const double angle = 2 * std::asin(0.003 / 0.06);
  const double foot = 0.06 * std::cos(angle / 2);
  const double segment = 0.06 * 0.06 / 2 * (angle - std::sin(angle));
  EXPECT_NEAR(lifter_section(mill), 0.006 * (foot - 0.052) + segment, 1e-17);
}

TEST(LifterSection, of_a_trapezoid_is_what_adding_up_strips_across_gives) {
  const Geometry mill = with_top_width(test_mill(0.12, 12, 0.008, 0.01, 0.003), 0.004).geometry;
  const double foot = std::sqrt(0.06 * 0.06 - 0.005 * 0.005);
  const int n = 200000;
  double area =
      0;  // strips at equal distances y from the lifter's centre line, from its top or side to the shell
  for (int i = 0; i < n; ++i) {
    const double y = 0.005 * (i + 0.5) / n;
    const double inner = y < 0.002 ? 0.052 : 0.052 + (foot - 0.052) * (y - 0.002) / 0.003;
    area += 2 * 0.005 / n * (std::sqrt(0.06 * 0.06 - y * y) - inner);
  }
  EXPECT_NEAR(lifter_section(mill) / area, 1, 1e-9);
}

TEST(FlowVolume, is_the_mills_and_that_behind_the_grates) {
  const Geometry mill = mill_with_pulp_lifters();
  EXPECT_NEAR(flow_volume(mill), analytic_section(mill) * 0.335, 1e-16);
  EXPECT_NEAR(analytic_volume(mill), analytic_section(mill) * 0.305, 1e-16);
}

}  // namespace
}  // namespace millfoam::meshing
