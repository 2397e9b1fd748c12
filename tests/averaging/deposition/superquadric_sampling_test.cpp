// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/deposition/superquadric_sampling.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "averaging/deposition/exact_box_deposition.hpp"
#include "averaging/deposition/sampled_box_deposition.hpp"
#include "tests/averaging/deposition/deposition_support.hpp"

namespace millfoam::averaging {
namespace {

/// Turns by an angle about z.
std::array<double, 4> about_z(double angle) {
  return {std::cos(angle / 2), 0, 0, std::sin(angle / 2)};
}

TEST(SuperquadricDeposits, AddUpToTheBodysVolume) {
  ExactBoxDeposition deposition(BoxGrid({-1, -1, -1}, {1, 1, 1}, {7, 8, 9}));
  const Superquadric shape{{0.3, 0.1, 0.2}, {4, 3}, {0.3, -0.5, 0.7, 0.1}};
  for (const Particle& ball : random_balls(100, 0.5, 0.4)) {
    EXPECT_NEAR(sum(deposited(deposition, ball, shape)) / superquadric_volume(shape), 1, 1e-13);
  }
}

TEST(SuperquadricDeposits, OfASphereAreThoseOfItsTemplate) {
  SampledBoxDeposition deposition(BoxGrid({-1, -1, -1}, {1, 1, 1}, {4, 5, 6}), 11);
  for (const Particle& ball : random_balls(100, 1, 0.4)) {
    const std::vector<double> sphere = deposited(deposition, ball);
    const std::vector<double> body = deposited(deposition, ball, {{ball.radius, ball.radius, ball.radius}});
    for (std::size_t v = 0; v < body.size(); ++v) ASSERT_NEAR(body[v], sphere[v], 1e-14);
  }
}

TEST(SuperquadricDeposits, OfATurnedBodyLieWhereItsLongAxisPoints) {
  const BoxGrid grid({-1, -1, -1}, {1, 1, 1}, {3, 3, 3});
  ExactBoxDeposition deposition(grid);
  const Superquadric along_x{{0.9, 0.2, 0.2}, {8, 8}};
  Superquadric along_y = along_x;
  along_y.quaternion = about_z(pi / 2);
  const std::vector<double> x = deposited(deposition, {}, along_x), y = deposited(deposition, {}, along_y);
  for (int v = 0; v < 27; ++v) {
    const VoxelIndex voxel{v % 3, v / 3 % 3, v / 9};
    EXPECT_NEAR(y[grid.offset(voxel)], x[grid.offset({voxel[1], voxel[0], voxel[2]})], 1e-15);
  }
  EXPECT_GT(x[grid.offset({0, 1, 1})], 0.2 * superquadric_volume(along_x));
  EXPECT_EQ(x[grid.offset({1, 0, 1})], 0);
}

TEST(SuperquadricDeposits, OfATurnedBlockAreItsCutsVolumes) {
  // A block of 1.2 x 0.4 x 0.4, nearly sharp, turned by 30 degrees about z and cut by x = 0.2: by its slices
  // along the body's second axis the part beyond is half of it less 0.2/cos(30) of its length.
  const Superquadric block{{0.6, 0.2, 0.2}, {400, 400}, about_z(pi / 6)};
  const BoxGrid grid({0.2, -1, -1}, {2, 1, 1}, {1, 1, 1});
  SampledBoxDeposition deposition(grid, 120);
  const double exact = 0.4 * 0.4 * (0.6 - 0.2 / std::cos(pi / 6));
  EXPECT_NEAR(sum(deposited(deposition, {}, block)), exact, 0.01 * superquadric_volume(block));
}

TEST(SuperquadricDeposits, AcrossAPeriodicFaceComeInOnTheOtherSide) {
  ExactBoxDeposition deposition(BoxGrid({-1, -1, 0}, {1, 1, 4}, {1, 1, 4}, {false, false, true}));
  const Superquadric shape{{0.5, 0.4, 0.3}, {4, 4}};
  const std::vector<double> cells = deposited(deposition, {1, {0, 0, 4}, {}, 0.8}, shape);
  EXPECT_NEAR(cells[0], superquadric_volume(shape) / 2, 1e-15);
  EXPECT_NEAR(cells[3], superquadric_volume(shape) / 2, 1e-15);
}

TEST(SuperquadricDeposits, DoNotDependOnTheQuaternionsLength) {
  ExactBoxDeposition deposition(BoxGrid({-1, -1, -1}, {1, 1, 1}, {5, 5, 5}));
  const Superquadric shape{{0.3, 0.1, 0.2}, {4, 3}, {0.5, 0.5, -0.5, 0.5}};
  Superquadric longer = shape;
  for (double& component : longer.quaternion) component *= 4;
  const Particle ball{1, {0.1, 0.2, 0.3}, {}, 0.4};
  EXPECT_EQ(deposited(deposition, ball, longer), deposited(deposition, ball, shape));
}

}  // namespace
}  // namespace millfoam::averaging
