// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/fluid_forces.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "meshing/mill/mill.hpp"
#include "slurry_writer.hpp"
#include "small_mill.hpp"

namespace millfoam::dem_driver {
namespace {

using tests::FlowAtPoint;
using tests::SlurryContent;
using tests::TemporaryFolder;

/// 10 x 8 x 6 voxels that repeat along z.
const averaging::BoxGrid grid({-0.05, -0.04, 0}, {0.05, 0.04, 0.03}, {10, 8, 6}, {false, false, true});

BallInFluid ball_at(const Vector& position, const Vector& velocity = {}, double diameter = 0.003) {
  return {position, velocity, diameter};
}

/// Linear in x and y, constant along the periodic axis.
FlowAtPoint linear(const Vector& x) {
  FlowAtPoint flow;
  flow.pressure_force = {3 + 200 * x[0], -1 + 50 * x[1], 7 - 40 * x[0]};
  flow.exchange = 900 + 1e4 * x[1];
  flow.drag_force = {5 - 30 * x[1], 20 * x[0], 2};
  return flow;
}

struct VoxelForcesTest : ::testing::Test {
  TemporaryFolder folder;
  std::filesystem::path file = folder.path() / "slurry.h5";

  VoxelForces forces(const SlurryContent& content, FluidTime time = FluidTime::mean) const {
    tests::write_slurry(file, content);
    return VoxelForces(file, time);
  }
  VoxelForces of_mean(const std::function<FlowAtPoint(const Vector&)>& flow) const {
    return forces({grid, {flow}, flow});
  }
};

TEST(PoolForces, ASphereBelowTheLevelFeelsTheWeightOfTheFluidInItsPlaceAndOneAboveNothing) {
  const PoolForces pool(0.01, 1200);
  const double whole = 1200 * meshing::gravity * ball_at({}).volume();
  EXPECT_NEAR(pool.on(ball_at({0.02, -0.02, 0})).pressure[1], whole, 1e-12 * whole);
  EXPECT_NEAR(pool.on(ball_at({0.02, 0.01, 0})).pressure[1], whole / 2, 1e-12 * whole);
  EXPECT_EQ(pool.on(ball_at({0.02, 0.0116, 0})).pressure[1], 0);
  EXPECT_EQ(pool.on(ball_at({0.02, -0.02, 0})).pressure[0], 0);
  EXPECT_EQ(pool.on(ball_at({0.02, -0.02, 0}, {1, 2, 3})).drag, (Vector{0, 0, 0}));
}

TEST(PoolForces, TheShareBelowALevelIsTheIntegralOfTheSpheresSections) {
  // Sections pi (R^2 - s^2) from s = -R up to -height, by Simpson's rule, which is exact for them
  const double radius = 0.7;
  for (const double height : {-0.5, -0.1, 0.0, 0.3, 0.69}) {
    const double top = -height, length = top + radius, middle = (top - radius) / 2;
    const auto section = [&](double s) { return radius * radius - s * s; };
    const double below = length / 6 * (section(-radius) + 4 * section(middle) + section(top));
    EXPECT_NEAR(share_below(height, radius), below / (4.0 / 3 * std::pow(radius, 3)), 1e-14) << height;
  }
  EXPECT_EQ(share_below(0.8, radius), 0);
  EXPECT_DOUBLE_EQ(share_below(-0.8, radius), 1);
}

TEST_F(VoxelForcesTest, LinearFieldsAreReproducedBetweenVoxels) {
  const VoxelForces forces = of_mean(linear);
  const Vector velocity{0.3, -0.2, 0.1};
  for (const Vector& x : {Vector{0.0123, -0.0177, 0.011}, {-0.0449, 0.0349, 0.0299}, {0.0, 0.0, -0.004}}) {
    const BallInFluid ball = ball_at(x, velocity);
    const FluidForce found = forces.on(ball);
    const FlowAtPoint flow = linear(x);
    ASSERT_TRUE(found.known);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(found.pressure[k], ball.volume() * flow.pressure_force[k], 1e-12 * ball.volume() * 20);
      EXPECT_NEAR(found.drag[k], ball.volume() * (flow.drag_force[k] - flow.exchange * velocity[k]),
                  1e-12 * ball.volume() * 500);
    }
  }
}

TEST_F(VoxelForcesTest, AlongAPeriodicAxisTheLastVoxelIsNextToTheFirst) {
  const auto wave = [](const Vector& x) {
    FlowAtPoint flow;
    flow.pressure_force[0] = x[2] < 0.005 ? 10 : x[2] > 0.025 ? 30 : 0;
    return flow;
  };
  const VoxelForces forces = of_mean(wave);
  const double volume = ball_at({}).volume();
  // Voxels are 5 mm long: at the seam, 2.5 mm from both centres, and a quarter of a voxel beyond it
  for (const double z : {0.0, 0.03, -0.03, 0.09})
    EXPECT_NEAR(forces.on(ball_at({0, 0, z})).pressure[0], 20 * volume, 1e-9 * volume) << z;
  for (const double z : {0.00125, 0.03125, -0.02875})
    EXPECT_NEAR(forces.on(ball_at({0, 0, z})).pressure[0], 15 * volume, 1e-9 * volume) << z;
}

TEST_F(VoxelForcesTest, AtWallsTheVoxelsWithFluidAloneCountAndBeyondTheBoxItsEdge) {
  const auto half = [](const Vector& x) {
    FlowAtPoint flow = linear({0, 0, 0});
    flow.inside = x[0] < 0.01 ? 0.3 : 0;
    if (flow.inside == 0) flow.exchange = flow.pressure_force[0] = std::nan("");
    return flow;
  };
  const VoxelForces forces = of_mean(half);
  const double volume = ball_at({}).volume();
  for (const Vector& x : {Vector{0.014, 0, 0.01}, {-0.0499, 0.0399, 0.01}, {-0.0545, 0, 0.01}}) {
    const FluidForce found = forces.on(ball_at(x));
    ASSERT_TRUE(found.known) << x[0];
    EXPECT_NEAR(found.pressure[0], 3 * volume, 1e-12 * volume) << x[0];
  }
  for (const Vector& x : {Vector{0.016, 0, 0.01}, {0, 0.0451, 0.01}, {0.4, 0, 0}}) {
    const FluidForce found = forces.on(ball_at(x, {1, 1, 1}));
    EXPECT_FALSE(found.known) << x[0];
    EXPECT_EQ(found.pressure, (Vector{0, 0, 0}));
    EXPECT_EQ(found.drag, (Vector{0, 0, 0}));
  }
}

TEST_F(VoxelForcesTest, WindowsAreLinearInTimeBetweenTheirMiddlesAndHeldAtBothEnds) {
  const auto constant = [](double value) {
    return [value](const Vector&) {
      FlowAtPoint flow;
      flow.pressure_force[2] = value;
      return flow;
    };
  };
  VoxelForces forces =
      this->forces({grid, {constant(1), constant(5), constant(-3), constant(7)}}, FluidTime::windows);
  const BallInFluid ball = ball_at({0.001, 0.002, 0.003});
  const auto expect = [&](double time, double value) {
    forces.set_time(time);
    EXPECT_NEAR(forces.on(ball).pressure[2] / ball.volume(), value, 1e-12) << time;
  };
  expect(0, 1);
  expect(0.5, 1);
  expect(0.75, 2);
  expect(1.5, 5);
  expect(2.25, -1);
  expect(3.25, 4.5);  // past a whole window
  expect(9, 7);
  expect(0.75, 2);  // and back
}

TEST_F(VoxelForcesTest, AWindowWithoutFluidAtABallLeavesItsNeighboursAlone) {
  const auto flow = [](double inside, double value) {
    return [=](const Vector&) {
      FlowAtPoint at;
      at.inside = inside;
      at.pressure_force[0] = value;
      return at;
    };
  };
  VoxelForces forces = this->forces({grid, {flow(0, 0), flow(1, 6)}}, FluidTime::windows);
  forces.set_time(1);
  EXPECT_NEAR(forces.on(ball_at({})).pressure[0], 6 * ball_at({}).volume(), 1e-15);
  forces.set_time(0);
  EXPECT_FALSE(forces.on(ball_at({})).known);
}

TEST_F(VoxelForcesTest, InAMixtureOfSizesTheForcesOfAllBallsAddUpToThatOfTheLaw) {
  // beta = K phi (1 + 0.064 e d43/d32), physics of the drag laws: 60 % of the volume in balls of 4 mm
  const double phi = 0.55, e = 1 - phi, share = 0.6, large = 0.004, small = 0.002;
  const double d32 = 1 / (share / large + (1 - share) / small), d43 = share * large + (1 - share) * small;
  const auto flow = [&](const Vector&) {
    FlowAtPoint at;
    at.exchange = 1000;
    at.drag_force = {200, 0, 0};
    at.solidity = phi;
    at.diameter = d32;
    return at;
  };
  SlurryContent content{grid, {flow}, flow};
  content.polydispersity = true;
  double force = 0;  // of a unit of volume
  {
    const VoxelForces forces = this->forces(content);
    for (const auto& [diameter, part] : {std::pair(large, share), {small, 1 - share}}) {
      const BallInFluid ball = ball_at({}, {-0.3, 0, 0}, diameter);
      force += phi * part / ball.volume() * forces.on(ball).drag[0];
    }
  }
  EXPECT_NEAR(force / (phi * (1 + 0.064 * e * d43 / d32) * (200 + 1000 * 0.3)), 1, 1e-12);
  content.polydispersity = false;
  const BallInFluid ball = ball_at({}, {}, large);
  EXPECT_NEAR(this->forces(content).on(ball).drag[0] / (200 * ball.volume()), 1, 1e-12);
}

TEST_F(VoxelForcesTest, FilesThatCannotPushBallsAreRefusedWithTheReason) {
  const auto complaint = [&](const SlurryContent& content, FluidTime time = FluidTime::mean) {
    return tests::message_of([&] { forces(content, time); });
  };
  const auto expect = [&](const std::string& message, const std::string& words) {
    EXPECT_EQ(message.find(file.string() + ": "), 0u) << message;
    EXPECT_NE(message.find(words), std::string::npos) << message;
  };
  expect(tests::message_of([&] { VoxelForces(file, FluidTime::mean); }), "there is no such file");
  SlurryContent content{grid, {linear}, linear};
  content.version = 1;
  expect(complaint(content),
         "version 1, which has no forces on balls (group /balls), expected version 2: run the flow");
  content.version = 2;
  content.complete = 0;
  expect(complaint(content), "not complete");
  content.complete = 1;
  content.balls = false;
  expect(complaint(content), "its flow had no balls");
  content.balls = true;
  content.mean = {};
  expect(complaint(content), "no mean over the run");
  content.windows = {linear, [](const Vector& x) {
                       FlowAtPoint flow = linear(x);
                       if (x[0] > 0 && x[0] < 0.01 && x[1] > 0.03 && x[2] > 0.025)
                         flow.drag_force[1] = INFINITY;
                       return flow;
                     }};
  expect(complaint(content, FluidTime::windows),
         "'balls/drag_force' is not finite in voxel x y z = (5, 7, 5), whose "
         "centre is (0.005, 0.035, 0.0275) m");
}

}  // namespace
}  // namespace millfoam::dem_driver
