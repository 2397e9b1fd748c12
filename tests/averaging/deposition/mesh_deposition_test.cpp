// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/deposition/mesh_deposition.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "averaging/deposition/exact_mesh_deposition.hpp"
#include "averaging/deposition/sampled_mesh_deposition.hpp"
#include "tests/averaging/deposition/mesh_deposition_support.hpp"

namespace millfoam::averaging {
namespace {

using Eigen::Vector3d;

template <typename Method>
class MeshDepositionBy : public ::testing::Test {};
using Both = ::testing::Types<ExactMeshDeposition, SampledMeshDeposition>;
TYPED_TEST_SUITE(MeshDepositionBy, Both);

TYPED_TEST(MeshDepositionBy, AveragesInTheTurnedFrameAsTheTurnedBallsInTheFixedOne) {
  const std::vector<std::string> motion{"rotation speed -7 origin 0.01 0 0",
                                        "translation velocity 0.1 0.2 0"};
  const double time = 0.31, reference = 0.12;
  TypeParam moving = turning<TypeParam>(warped_drum(), motion, reference, time);
  TypeParam fixed = at_rest<TypeParam>(warped_drum());
  // Written out: back along the path, back about the origin, then forward to the reference time.
  const auto into_mesh = [&](Vector3d p) -> Vector3d {
    const Vector3d origin(0.01, 0, 0), velocity(0.1, 0.2, 0);
    p -= time * velocity + origin;
    const double angle = 7 * (time - reference), c = std::cos(angle), s = std::sin(angle);
    return Vector3d(c * p.x() - s * p.y(), s * p.x() + c * p.y(), p.z()) + origin + reference * velocity;
  };
  const Eigen::Isometry3d lab = parse_motion(motion)->place(time);
  for (Particle ball : balls_in_drum(200, 0.0005, 0.008)) {
    const Vector3d place = lab * Vector3d(ball.position[0], ball.position[1], ball.position[2]);
    ball.position = {place.x(), place.y(), place.z()};
    const Vector3d turned = into_mesh(place);
    const std::vector<double> in_fixed = deposited(fixed, ball_at(turned, ball.radius));
    // A point of a template may change sides where it lies within rounding of a face: none does here.
    expect_same(deposited(moving, ball), in_fixed, 1e-12 * sphere_volume(ball.radius));
  }
}

TYPED_TEST(MeshDepositionBy, IsTheSameAfterAFullTurn) {
  TypeParam deposition = turning<TypeParam>(warped_drum(), {"rotation speed " + std::to_string(8)}, 0, 0.1);
  const std::vector<Particle> balls = balls_in_drum(200, 0.0005, 0.008);
  std::vector<std::vector<double>> before;
  for (const Particle& ball : balls) before.push_back(deposited(deposition, ball));
  deposition.begin_record(0.1 + 2 * pi / 8);
  for (std::size_t b = 0; b < balls.size(); ++b) {
    expect_same(deposited(deposition, balls[b]), before[b], 1e-12 * sphere_volume(balls[b].radius));
  }
}

TYPED_TEST(MeshDepositionBy, KeepsVolumeOfBallsOverPeriodicEnds) {
  TypeParam deposition = at_rest<TypeParam>(drum(), 12, drum_length);
  for (Particle ball : balls_in_drum(200, 0.0005, 0.011)) {
    const std::vector<double> before = deposited(deposition, ball);
    EXPECT_NEAR(sum(before) / sphere_volume(ball.radius), 1, 1e-12);
    ball.position[2] += drum_length / 2;
    EXPECT_NEAR(sum(deposited(deposition, ball)) / sphere_volume(ball.radius), 1, 1e-12);
    ball.position[2] += drum_length / 2;
    expect_same(deposited(deposition, ball), before, 1e-12 * sphere_volume(ball.radius));
  }
}

TYPED_TEST(MeshDepositionBy, ClonesDepositAlike) {
  TypeParam deposition = turning<TypeParam>(drum(), {"rotation speed 3"}, 0, 0.2);
  const auto other = deposition.clone();
  other->begin_record(0.2);
  for (const Particle& ball : balls_in_drum(20, 0.0005, 0.008)) {
    EXPECT_EQ(deposited(*other, ball), deposited(deposition, ball));
  }
}

TYPED_TEST(MeshDepositionBy, APeriodThatIsNotTheMeshsExtentIsRefused) {
  expect_named(message_of<std::invalid_argument>([&] { at_rest<TypeParam>(drum(), 12, 0.03); }),
               {"0.024", "0.03", "period"});
}

TYPED_TEST(MeshDepositionBy, SamplesSuperquadricsInTheMeshsFrame) {
  TypeParam deposition = turning<TypeParam>(drum(), {"rotation speed 3"}, 0, 0.2);
  const Superquadric shape{{0.004, 0.002, 0.003}, {4, 4}, {0.9, 0.1, 0.3, 0.2}};
  const Particle ball = ball_at({0.02, 0.01, 0.012}, 0.006);
  const std::vector<double> cells = deposited(deposition, ball, shape);
  EXPECT_NEAR(sum(cells) / superquadric_volume(shape), 1, 1e-12);
  EXPECT_GT(std::count_if(cells.begin(), cells.end(), [](double v) { return v > 0; }), 2);
}

TEST_F(DeformingDrum, DepositsAsAMeshThatStaysWhereItIsThen) {
  ExactMeshDeposition exact(std::make_unique<DeformingMesh>(series));
  SampledMeshDeposition sampling(std::make_unique<DeformingMesh>(series));
  for (const double part : {0.07, 0.02, 0.1}) {
    const double time = 2 + 10 * part;
    exact.begin_record(time);
    sampling.begin_record(time);
    const TestMesh then{mesh.topology, series->points_at(time)};
    ExactMeshDeposition fixed_exact = at_rest<ExactMeshDeposition>(then);
    SampledMeshDeposition fixed_sampling = at_rest<SampledMeshDeposition>(then);
    expect_same(exact.volumes(), fixed_exact.volumes(), 0);
    for (const Particle& ball : balls_in_drum(100, 0.0005, 0.009)) {
      expect_same(deposited(exact, ball), deposited(fixed_exact, ball), 1e-15 * sphere_volume(ball.radius));
      expect_same(deposited(sampling, ball), deposited(fixed_sampling, ball),
                  1e-15 * sphere_volume(ball.radius));
    }
  }
}

}  // namespace
}  // namespace millfoam::averaging
