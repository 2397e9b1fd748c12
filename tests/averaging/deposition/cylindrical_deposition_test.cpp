// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/deposition/cylindrical_deposition.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "averaging/deposition/exact_cylinder_deposition.hpp"
#include "averaging/grids/cylindrical.hpp"
#include "averaging/statistics/record_sums.hpp"
#include "tests/averaging/deposition/deposition_support.hpp"

namespace millfoam::averaging {
namespace {

/// Rings of 0.1 m and sectors of 30 degrees, which turn at -4 rad/s.
struct Turning : ::testing::Test {
  CylinderGrid grid{{0, 1}, {-1, 1}, {10, 12, 20}};
  CylindricalDeposition turning{std::make_unique<ExactCylinderDeposition>(grid), -4};
  CylindricalDeposition at_rest{std::make_unique<ExactCylinderDeposition>(grid), 0};

  std::vector<double> deposited_at(double time, const Particle& ball) {
    turning.begin_record(time);
    return deposited(turning, ball);
  }
};

void expect_near(const std::vector<double>& found, const std::vector<double>& expected, double tolerance) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t c = 0; c < found.size(); ++c) EXPECT_NEAR(found[c], expected[c], tolerance) << c;
}

TEST_F(Turning, ABallThatTurnsWithTheCylinderStaysInItsVoxels) {
  for (const Particle& ball : random_balls(20, 0.5, 0.15)) {
    const std::vector<double> first = deposited_at(0, ball);
    for (const double time : {0.1, 0.7, 12.0}) {
      Particle later = ball;
      later.position = turned(ball.position, -4 * time);
      expect_near(deposited_at(time, later), first, 1e-12 * sphere_volume(ball.radius));
    }
  }
}

TEST_F(Turning, ABallAtRestGoesRoundTheOtherWay) {
  const Particle ball{1, {0.75, 0.01, 0.05}, {}, 1e-3};
  // A twelfth of a turn
  const std::vector<double> cells = deposited_at(2 * pi / 12 / 4, ball);
  EXPECT_NEAR(cells[grid.offset({7, 1, 10})] / sphere_volume(1e-3), 1, 1e-12);
}

TEST_F(Turning, ASuperquadricTurnsAsABody) {
  // A long brick along x, at the grid's time 0; its points are the same at all times
  const Superquadric brick{{0.2, 0.02, 0.02}, {8, 8}, {1, 0, 0, 0}};
  const Particle place{1, {0.5, 0, 0}, {}, 0.21};
  turning.begin_record(0);
  const std::vector<double> first = deposited(turning, place, brick);
  const double time = 0.3, angle = -4 * time;
  const Superquadric later_brick{
      brick.half_axes, brick.blockiness, {std::cos(angle / 2), 0, 0, std::sin(angle / 2)}};
  Particle later = place;
  later.position = turned(place.position, angle);
  turning.begin_record(time);
  const std::vector<double> found = deposited(turning, later, later_brick);
  expect_near(found, first, 1e-12 * sum(first));
  // And it does not where its body does not turn
  const std::vector<double> other = deposited(turning, later, brick);
  double difference = 0;
  for (std::size_t c = 0; c < first.size(); ++c) difference += std::abs(other[c] - first[c]);
  EXPECT_GT(difference, 0.1 * sum(first));
}

/// Velocity of the whole record, in one voxel.
Vector3 mean_velocity(CylindricalDeposition& deposition, const ParticleRecord& record, double time) {
  RecordSums sums;
  sum_record(deposition, record, time, sums);
  double volume = 0;
  Vector3 momentum{};
  for (std::size_t c = 0; c < sums.cells(); ++c) {
    volume += sums.at(c, RecordSums::volume);
    for (std::size_t a = 0; a < 3; ++a) momentum[a] += sums.at(c, RecordSums::momentum + a);
  }
  EXPECT_NEAR(volume / sums.ledger.deposited, 1, 1e-13);
  EXPECT_NEAR((sums.ledger.deposited + sums.ledger.outside) / sums.ledger.volume_in, 1, 1e-13);
  return {momentum[0] / volume, momentum[1] / volume, momentum[2] / volume};
}

TEST_F(Turning, AnOrbitingBallHasItsSpeedAlongTheta) {
  for (const double time : {0.0, 0.9}) {
    for (const double theta : {0.2, 2.0, 5.5}) {
      const double r = 0.6, omega = 2.5;
      const Particle ball{1,
                          {r * std::cos(theta), r * std::sin(theta), 0.3},
                          {-omega * r * std::sin(theta), omega * r * std::cos(theta), -0.2},
                          0.05};
      const Vector3 found = mean_velocity(turning, {0, {ball}, {}}, time);
      EXPECT_NEAR(found[0], 0, 1e-14);
      EXPECT_NEAR(found[1], omega * r, 1e-14);
      EXPECT_NEAR(found[2], -0.2, 1e-14);
    }
  }
}

TEST_F(Turning, AUniformVelocityHasTheComponentsOfEachPlace) {
  for (const double theta : {0.0, 0.7, 3.0}) {
    const Particle ball{1, {0.4 * std::cos(theta), 0.4 * std::sin(theta), 0}, {2, 0, 1}, 0.05};
    const Vector3 found = mean_velocity(at_rest, {0, {ball}, {}}, 1.7);
    EXPECT_NEAR(found[0], 2 * std::cos(theta), 1e-14);
    EXPECT_NEAR(found[1], -2 * std::sin(theta), 1e-14);
    EXPECT_NEAR(found[2], 1, 1e-14);
  }
}

TEST_F(Turning, ACopyIsOfTheSameRecord) {
  turning.begin_record(0.4);
  const std::unique_ptr<Deposition> copy = turning.clone();
  const Particle ball = random_balls(1, 0.5, 0.1)[0];
  EXPECT_EQ(deposited(*copy, ball), deposited(turning, ball));
}

}  // namespace
}  // namespace millfoam::averaging
