// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <vector>

#include "meshing/mill/mill.hpp"
#include "meshing/mill_mesh/section_blocks.hpp"

namespace millfoam::meshing {

/// A mill and the size of its cells, m.
struct TestMill {
  Geometry geometry;
  double cell_size = 0;
};

inline TestMill test_mill(double diameter, int count, double height, double width, double cell_size,
                          Ends ends = Ends::plain) {
  return {{diameter, diameter / 5, ends, {count, height, width, width}}, cell_size};
}

/// The same with trapezoidal lifters.
inline TestMill with_top_width(TestMill mill, double top_width) {
  mill.geometry.lifters.top_width = top_width;
  return mill;
}

/// The cross-section by cell size, m.
inline CrossSection make_cross_section(const Geometry& geometry, double cell_size) {
  return make_cross_section(geometry, Resolution{cell_size, 1, std::nullopt});
}

/// The 30 cm mill with a feed opening of 128.7 cm^2 and grates.
inline Geometry mill_with_grates(double sector_share = 0.8) {
  Geometry geometry = {0.3, 0.305, Ends::plain, {20, 0.01, 0.01, 0.01}};
  geometry.inlet = Inlet{std::sqrt(0.01287 / std::acos(-1.0))};
  geometry.grates = Grates{0.09, 0.13, 12, sector_share, 0.3};
  return geometry;
}

/// The same with pulp lifters whose discharge circle all but coincides with the inlet's.
inline Geometry mill_with_pulp_lifters() {
  Geometry geometry = mill_with_grates();
  geometry.pulp_lifters = PulpLifters{0.03, 2, 0.064};
  return geometry;
}

/// The same with the pulp lifters of cases/mills/mill_30cm: `layers` is 3 with 33 in the mill, and 2 with 9.
inline Geometry shipped_mill(int layers) {
  Geometry geometry = mill_with_grates();
  geometry.pulp_lifters = PulpLifters{0.033, layers, 0.0467};
  return geometry;
}

/// The 12 cm and the 30 cm mill, a smooth drum, and mills that are harder to mesh.
inline std::vector<TestMill> ordinary_mills() {
  return {test_mill(0.12, 12, 0.008, 0.006, 0.002),
          test_mill(0.12, 12, 0.008, 0.006, 0.003),
          test_mill(0.12, 12, 0.008, 0.006, 0.004),
          test_mill(0.12, 12, 0.008, 0.006, 0.006),
          test_mill(0.3, 20, 0.01, 0.01, 0.005),
          test_mill(0.3, 20, 0.01, 0.01, 0.01),
          test_mill(0.12, 0, 0, 0, 0.003),
          test_mill(0.12, 0, 0, 0, 0.01),
          with_top_width(test_mill(0.12, 12, 0.008, 0.006, 0.003), 0.004),
          with_top_width(test_mill(0.3, 20, 0.01, 0.015, 0.006), 0.008)};
}

inline std::vector<TestMill> unusual_mills() {
  return {test_mill(0.12, 1, 0.008, 0.006, 0.004),
          test_mill(0.12, 2, 0.008, 0.006, 0.004),
          test_mill(0.12, 3, 0.02, 0.02, 0.004),
          test_mill(0.12, 5, 0.008, 0.006, 0.004),
          test_mill(0.12, 7, 0.008, 0.006, 0.006),
          test_mill(0.12, 11, 0.008, 0.002, 0.006),
          test_mill(0.12, 30, 0.004, 0.004, 0.003),
          test_mill(0.12, 12, 0.03, 0.004, 0.003),
          test_mill(0.12, 12, 0.008, 0.025, 0.003),
          test_mill(0.12, 12, 0.001, 0.006, 0.003),
          with_top_width(test_mill(0.12, 8, 0.01, 0.03, 0.003), 0.012)};
}

/// Both.
inline std::vector<TestMill> all_mills() {
  std::vector<TestMill> mills = ordinary_mills();
  for (const TestMill& mill : unusual_mills()) mills.push_back(mill);
  return mills;
}

/// Area of the mill's section whose shell has a facet over each of `gap` equal angles between two lifters:
/// triangles to the axis between the lifters' feet, under each lifter's top and under its two sides.
inline double faceted_section(const Geometry& geometry, int gap) {
  const double r = geometry.radius(), width = geometry.lifters.width, top_width = geometry.lifters.top_width;
  const double foot = std::sqrt(r * r - width * width / 4), top = r - geometry.lifters.height;
  const double facet = (2 * std::acos(-1.0) / geometry.lifters.count - 2 * std::asin(width / 2 / r)) / gap;
  return geometry.lifters.count *
         (gap * r * r / 2 * std::sin(facet) + (width * top - top_width * foot + top_width * top) / 2);
}

}  // namespace millfoam::meshing
