// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/deposition/sampled_cylinder_deposition.hpp"

#include <gtest/gtest.h>

#include "tests/averaging/deposition/deposition_support.hpp"

namespace millfoam::averaging {
namespace {

TEST(SampledCylinderDeposition, AgreesWithLocatingEveryPointOfTheTemplate) {
  const CylinderGrid grid({0.2, 1}, {-0.5, 0.5}, {3, 7, 5}, true);
  const SphereTemplate points(10);
  SampledCylinderDeposition deposition(grid, 10);
  for (const Particle& ball : random_balls(200, 0.9, 0.4)) {
    const std::vector<double> visited = by_visiting(grid, points, ball);
    const std::vector<double> cells = deposited(deposition, ball);
    for (std::size_t v = 0; v < visited.size(); ++v) ASSERT_NEAR(cells[v], visited[v], 1e-13);
  }
}

TEST(SampledCylinderDeposition, OnTheAxisGivesEqualPartsToEqualSectors) {
  SampledCylinderDeposition deposition(CylinderGrid({0, 1}, {-1, 1}, {1, 4, 2}), 12);
  for (const double volume : deposited(deposition, {1, {0, 0, 0}, {}, 0.5})) {
    EXPECT_NEAR(volume, sphere_volume(0.5) / 8, 1e-15);
  }
}

}  // namespace
}  // namespace millfoam::averaging
