// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/deposition/sampled_box_deposition.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "tests/averaging/deposition/deposition_support.hpp"

namespace millfoam::averaging {
namespace {

TEST(SampledBoxDeposition, GivesTheSpheresVolumeWhereNothingSticksOut) {
  SampledBoxDeposition deposition(BoxGrid({-1, -1, -1}, {1, 1, 1}, {9, 8, 7}));
  for (const Particle& ball : random_balls(2000, 0.6, 0.4)) {
    EXPECT_NEAR(sum(deposited(deposition, ball)) / sphere_volume(ball.radius), 1, 1e-14);
  }
}

TEST(SampledBoxDeposition, ASphereWhollyInOneVoxelGivesItExactlyItsVolume) {
  const BoxGrid grid({0, 0, 0}, {3, 3, 3}, {3, 3, 3});
  SampledBoxDeposition deposition(grid);
  const std::vector<double> cells = deposited(deposition, {1, {1.45, 1.5, 1.6}, {}, 0.39});
  EXPECT_NEAR(cells[grid.offset({1, 1, 1})] / sphere_volume(0.39), 1, 1e-15);
  EXPECT_EQ(cells[grid.offset({1, 1, 1})], sum(cells));
}

TEST(SampledBoxDeposition, AgreesWithVisitingEveryPointOfTheTemplate) {
  const BoxGrid grid({-1, -1, -1}, {1, 1, 1}, {5, 6, 7}, {true, false, true});
  const SphereTemplate points(10);
  SampledBoxDeposition deposition(grid, 10);
  for (const Particle& ball : random_balls(200, 1.2, 0.6)) {
    const std::vector<double> visited = by_visiting(grid, points, ball);
    const std::vector<double> cells = deposited(deposition, ball);
    for (std::size_t v = 0; v < visited.size(); ++v) ASSERT_NEAR(cells[v], visited[v], 1e-13);
  }
}

TEST(SampledBoxDeposition, ASphereOnACornerGivesAnEighthToEachNeighbour) {
  SampledBoxDeposition deposition(BoxGrid({0, 0, 0}, {2, 2, 2}, {2, 2, 2}));
  for (const double volume : deposited(deposition, {1, {1, 1, 1}, {}, 0.7})) {
    EXPECT_NEAR(volume, sphere_volume(0.7) / 8, 1e-14);
  }
}

TEST(SampledBoxDeposition, ASphereAcrossAPeriodicFaceComesInOnTheOtherSide) {
  SampledBoxDeposition deposition(BoxGrid({0, 0, 0}, {1, 1, 4}, {1, 1, 4}, {false, false, true}));
  for (const double z : {0.0, 4.0, -8.0}) {
    const std::vector<double> cells = deposited(deposition, {1, {0.5, 0.5, z}, {}, 0.4});
    EXPECT_NEAR(cells[0], sphere_volume(0.4) / 2, 1e-14);
    EXPECT_NEAR(cells[3], sphere_volume(0.4) / 2, 1e-14);
  }
}

TEST(SampledBoxDeposition, AnEverRepeatingSphereLargerThanThePeriodLosesNothing) {
  SampledBoxDeposition deposition(BoxGrid({-3, -3, 0}, {3, 3, 0.5}, {6, 6, 3}, {false, false, true}));
  const std::vector<double> cells = deposited(deposition, {1, {0, 0, 0.1}, {}, 1.7});
  EXPECT_NEAR(sum(cells) / sphere_volume(1.7), 1, 1e-13);
}

/// Volume that a simple cubic lattice of touching balls, shifted along the diagonal, gives to the cells of
/// the periodic unit cube that it fills.
std::vector<double> cubic_lattice(const BoxGrid& grid, int per_edge, double shift) {
  SampledBoxDeposition deposition(grid);
  std::vector<double> cells(grid.size());
  const double a = 1.0 / per_edge;
  for (int n = 0; n < per_edge * per_edge * per_edge; ++n) {
    const Vector3 place{a * (n % per_edge) + shift, a * (n / per_edge % per_edge) + shift,
                        a * (n / per_edge / per_edge) + shift};
    const std::vector<double> of_ball = deposited(deposition, {n + 1, place, {}, a / 2});
    for (std::size_t v = 0; v < cells.size(); ++v) cells[v] += of_ball[v];
  }
  return cells;
}

TEST(SampledBoxDeposition, TheSolidityOfALatticeOverItsOwnCellsIsExact) {
  const BoxGrid grid({0, 0, 0}, {1, 1, 1}, {4, 4, 4}, {true, true, true});
  for (const double volume : cubic_lattice(grid, 4, 0.0371)) {
    EXPECT_NEAR(volume / grid.voxel_volume(), pi / 6, 1e-12);
  }
}

TEST(SampledBoxDeposition, TheSolidityOfSlabsThroughALatticeIsRightToTheTemplatesKnownError) {
  // Slabs of half a lattice cell, displaced by s radii from the balls' centres: a slab holds the segment of
  // the balls between heights s and 1 (of the next ones nothing, of these from s on) and below s - 1 the
  // rest.
  constexpr int per_edge = 4;
  const double radius = 0.5 / per_edge;
  const BoxGrid grid({0, 0, 0}, {1, 1, 1}, {per_edge, per_edge, 2 * per_edge}, {true, true, true});
  for (const double s : {0.0, 0.13, 0.31, 0.5, 0.77}) {
    const auto below = [](double h) { return (2 + 3 * h - h * h * h) / 4; };
    const double upper = 1 - below(s), lower_of_next = below(s - 1);
    const double exact = (upper + lower_of_next) * pi / 6 * 2;
    const double solidity = cubic_lattice(grid, per_edge, -s * radius)[0] / grid.voxel_volume();
    EXPECT_NEAR(solidity, exact, 2 * 0.063 * pi / 6 * 2) << "s = " << s;
  }
}

TEST(SampledBoxDeposition, TheErrorFallsAsOneOverTheTemplatesPoints) {
  const double h = 0.4;  // the plane's height above the centre, in radii
  for (const int n : {8, 24, 120}) {
    SampledBoxDeposition deposition(BoxGrid({0, 0, 0}, {1, 1, 1}, {1, 1, 2}), n);
    const std::vector<double> cells = deposited(deposition, {1, {0.5, 0.5, 0.5 - h * 0.2}, {}, 0.2});
    EXPECT_NEAR(cells[0] / sphere_volume(0.2), (2 + 3 * h - h * h * h) / 4, 0.75 / n);
  }
}

TEST(SampledBoxDeposition, ATemplateOfOnePointIsRefused) {
  const BoxGrid grid({0, 0, 0}, {1, 1, 1}, {1, 1, 1});
  expect_named(message_of<std::invalid_argument>([&] { SampledBoxDeposition(grid, 1); }),
               {"template", "1", "2"});
}

}  // namespace
}  // namespace millfoam::averaging
