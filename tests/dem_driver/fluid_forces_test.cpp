// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/fluid_forces.hpp"

#include <gtest/gtest.h>
#include <hdf5.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include "averaging/files/slurry_file.hpp"
#include "meshing/files/file_fingerprint.hpp"
#include "tests/dem_driver/small_mill.hpp"

namespace millfoam::dem_driver {
namespace {

using averaging::BoxGrid;
using averaging::SlurrySegment;
using averaging::VoxelSums;

/// What balls feel at a place, and the share of the voxel there that is in the mesh.
struct Felt {
  Vector pressure{}, fluid_velocity{};
  double exchange = 0, solidity = 0, diameter = 0.004, inside = 1;
};
using Field = std::function<Felt(const Vector&)>;

/// 4 x 4 x 2 voxels of 0.1 m, periodic along z.
const BoxGrid grid({0, 0, 0}, {0.4, 0.4, 0.2}, {4, 4, 2}, {false, false, true});

/// A flow of balls at rest, from `begin` to `begin` + 1 s.
SlurrySegment segment(double begin, const Field& field) {
  using averaging::slurry_components;
  VoxelSums sums(grid.size(), slurry_components + averaging::ball_components);
  for (std::size_t voxel = 0; voxel < grid.size(); ++voxel) {
    const auto i = static_cast<int>(voxel);
    const auto at = grid.centre({i % 4, i / 4 % 4, i / 16});
    const Felt felt = field({at[0], at[1], at[2]});
    const double w = felt.solidity + averaging::few_balls, k = felt.exchange;
    const std::array<double, averaging::ball_components> own{w,
                                                             felt.solidity,
                                                             w * felt.pressure[0],
                                                             w * felt.pressure[1],
                                                             w * felt.pressure[2],
                                                             w * k,
                                                             w * k * felt.fluid_velocity[0],
                                                             w * k * felt.fluid_velocity[1],
                                                             w * k * felt.fluid_velocity[2],
                                                             0,
                                                             0,
                                                             0,
                                                             w * 1239,
                                                             w * felt.diameter};
    sums.volume[voxel] = felt.inside * grid.voxel_volume();
    for (std::size_t c = 0; c < own.size(); ++c)
      sums.values[voxel * sums.components + slurry_components + c] = sums.volume[voxel] * own[c];
  }
  SlurrySegment result(grid.size(), true);
  result.begin = begin;
  result.end = begin + 1;
  result.add(sums, 0, 1);
  return result;
}

class FluidForcesTest : public ::testing::Test {
 protected:
  /// slurry.h5 of a flow of a second for each of these fields, from DEM time 10 s on.
  std::filesystem::path write(const std::vector<Field>& fields, bool polydispersity = false) {
    std::vector<std::filesystem::path> segments;
    for (std::size_t k = 0; k < fields.size(); ++k) {
      segments.push_back(folder_.path() / ("segment." + std::to_string(k) + ".h5"));
      averaging::write_segment(segments.back(), grid, segment(static_cast<double>(k), fields[k]));
    }
    averaging::SlurryHeader header{10, 1, 0};
    header.balls = averaging::BallsHeader{"Hill", polydispersity, 1239, 1.2, {0, -9.81, 0}};
    averaging::assemble_slurry(file_, grid, header, segments);
    return file_;
  }

  /// Removes a group of the file.
  void drop(const char* name) const {
    const hid_t root = H5Fopen(file_.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    H5Ldelete(root, name, H5P_DEFAULT);
    H5Fclose(root);
  }

  tests::TemporaryFolder folder_;
  std::filesystem::path file_ = folder_.path() / "slurry.h5";
};

Felt pushing(const Vector&) {
  Felt felt;
  felt.pressure = {2, 0, 0};
  return felt;
}

void expect_near(const Vector& found, const Vector& expected, double tolerance) {
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(found[k], expected[k], tolerance) << "component " << k;
}

TEST(Pool, CarriesTheWeightOfTheSlurryInTheBallsPlace) {
  const PoolForces pool(0.1, 1239);
  const BallInFluid below{{0, 0, 0}, {0, 0, 0}, 0.004}, above{{0, 0.2, 0}, {0, 0, 0}, 0.004};
  expect_near(pool.on(below).pressure, {0, 1239 * 9.81 * below.volume(), 0}, 1e-15);
  expect_near(pool.on(above).pressure, {0, 0, 0}, 0);
}

TEST(Pool, CarriesASphereByTheCapThatIsBelow) {
  EXPECT_EQ(share_below(0, 2), 0.5);
  EXPECT_EQ(share_below(-2, 2), 1);
  EXPECT_EQ(share_below(2, 2), 0);
  // A quarter of the diameter: t^2 (3 R - t)/(4 R^3), t = R/2
  EXPECT_NEAR(share_below(1, 2), 5.0 / 32, 1e-15);
}

TEST_F(FluidForcesTest, AreLinearBetweenTheVoxelsCentres) {
  const auto linear = [](const Vector& x) {
    Felt felt;
    felt.pressure = {1 + 2 * x[0] - 3 * x[1], 4 * x[1], 5};
    felt.exchange = 1000 * (1 + x[0]);
    felt.solidity = 0.5;
    return felt;
  };
  VoxelForces forces(write({linear}), FluidTime::mean);
  const BallInFluid ball{{0.17, 0.22, 0.3}, {0.3, -0.2, 0.1}, 0.004};
  const FluidForce found = forces.on(ball);
  const double v = ball.volume(), k = 1000 * 1.17;
  EXPECT_TRUE(found.known);
  expect_near(found.pressure, {v * (1 + 0.34 - 0.66), v * 0.88, v * 5}, 1e-12 * v);
  expect_near(found.drag, {-v * k * 0.3, v * k * 0.2, -v * k * 0.1}, 1e-10 * v);
}

TEST_F(FluidForcesTest, RepeatAlongAPeriodicAxis) {
  const auto layered = [](const Vector& x) {
    Felt felt;
    felt.pressure = {x[2] < 0.1 ? 1.0 : 3.0, 0, 0};
    return felt;
  };
  VoxelForces forces(write({layered}), FluidTime::mean);
  // Centres at 0.05 and 0.15 m; a ball may lie a little beyond the box
  for (const auto& [z, expected] :
       {std::pair(0.05, 1.0), {0.15, 3.0}, {0.2, 2.0}, {0.0, 2.0}, {-0.025, 2.5}, {0.225, 1.5}}) {
    const BallInFluid ball{{0.2, 0.2, z}, {0, 0, 0}, 0.004};
    EXPECT_NEAR(forces.on(ball).pressure[0], expected * ball.volume(), 1e-12 * ball.volume()) << z;
  }
}

TEST_F(FluidForcesTest, AtAWallAreThoseOfTheVoxelsWithFluid) {
  const auto half = [](const Vector& x) {
    Felt felt;
    felt.inside = x[0] < 0.2 ? 0.3 : 0;
    felt.pressure = {7, 0, 0};
    return felt;
  };
  VoxelForces forces(write({half}), FluidTime::mean);
  const BallInFluid at_wall{{0.19, 0.2, 0.1}, {0, 0, 0}, 0.004}, beyond{{0.31, 0.2, 0.1}, {0, 0, 0}, 0.004};
  EXPECT_NEAR(forces.on(at_wall).pressure[0], 7 * at_wall.volume(), 1e-12 * at_wall.volume());
  EXPECT_FALSE(forces.on(beyond).known);
  expect_near(forces.on(beyond).pressure, {0, 0, 0}, 0);
  const BallInFluid outside{{-0.2, 0.2, 0.1}, {0, 0, 0}, 0.004};
  EXPECT_FALSE(forces.on(outside).known);
}

TEST_F(FluidForcesTest, OfWindowsAreLinearInTimeAndHeldAtTheirEnds) {
  std::vector<Field> fields;
  for (const double push : {1.0, 2.0, 6.0})
    fields.emplace_back([push](const Vector&) {
      Felt felt;
      felt.pressure = {push, 0, 0};
      return felt;
    });
  const auto file = write(fields);
  VoxelForces forces(file, FluidTime::windows);
  const BallInFluid ball{{0.2, 0.2, 0.1}, {0, 0, 0}, 0.004};
  // Windows are about 10.5, 11.5 and 12.5 s; times may go back, too
  for (const auto& [time, expected] : {std::pair(0.0, 1.0),
                                       {10.5, 1.0},
                                       {10.75, 1.25},
                                       {11.5, 2.0},
                                       {12.0, 4.0},
                                       {20.0, 6.0},
                                       {11.0, 1.5}}) {
    forces.set_time(time);
    EXPECT_NEAR(forces.on(ball).pressure[0], expected * ball.volume(), 1e-12 * ball.volume()) << time;
  }
  VoxelForces mean(file, FluidTime::mean);
  EXPECT_NEAR(mean.on(ball).pressure[0], 3 * ball.volume(), 1e-12 * ball.volume());
}

TEST_F(FluidForcesTest, BetweenAWindowWithFluidAtTheBallAndOneWithoutAreThoseOfTheFirst) {
  const auto felt = [](double inside, double push) {
    return [=](const Vector&) {
      Felt result;
      result.inside = inside;
      result.pressure = {push, 0, 0};
      return result;
    };
  };
  const BallInFluid ball{{0.2, 0.2, 0.1}, {0, 0, 0}, 0.004};
  for (const auto& fields :
       {std::vector<Field>{felt(1, 5), felt(0, 0)}, std::vector<Field>{felt(0, 0), felt(1, 5)}}) {
    VoxelForces forces(write(fields), FluidTime::windows);
    forces.set_time(10.75);
    EXPECT_TRUE(forces.on(ball).known);
    EXPECT_NEAR(forces.on(ball).pressure[0], 5 * ball.volume(), 1e-12 * ball.volume());
  }
}

TEST_F(FluidForcesTest, OfAMixtureGiveEachSizeItsOwnDrag) {
  const auto uniform = [](const Vector&) {
    Felt felt;
    felt.fluid_velocity = {0.1, 0, 0};
    felt.exchange = 2000;
    felt.solidity = 0.6;
    return felt;
  };
  VoxelForces forces(write({uniform}, true), FluidTime::mean);
  // Twice the Sauter diameter: e/y + phi + 0.064 e y
  const BallInFluid large{{0.2, 0.2, 0.1}, {0, 0, 0}, 0.008};
  const double factor = 0.4 / 2 + 0.6 + 0.064 * 0.4 * 2;
  EXPECT_NEAR(mixture_factor(2, 0.6), factor, 1e-15);
  EXPECT_NEAR(forces.on(large).drag[0], large.volume() * factor * 200, 1e-9 * large.volume() * 200);
}

TEST_F(FluidForcesTest, GiveEachShapeItsOwnDrag) {
  const auto uniform = [](const Vector&) {
    Felt felt;
    felt.pressure = {0, 3, 0};
    felt.fluid_velocity = {0.1, 0, 0};
    felt.exchange = 2000;
    felt.solidity = 0.6;
    return felt;
  };
  const drag::Shape round{1, 1}, blunt{0.8, 0.8};
  const drag::Fluid slurry{1239, 0.0014};
  FluidSettings fluid;
  fluid.kind = FluidKind::slurry;
  fluid.file = write({uniform});
  fluid.file_id = file_fingerprint(fluid.file);
  fluid.shapes = {{{0.4, round}, {0.6, blunt}}, slurry};
  const auto forces = make_fluid_forces(fluid);
  // A slip of 0.1 - 0.4 m/s along x and 0.4 along y
  BallInFluid ball{{0.2, 0.2, 0.1}, {0.4, -0.4, 0}, 0.004};
  const double re = drag::reynolds(0.6, 0.5, ball.diameter, slurry), volume = ball.volume();
  const auto law = [&](const drag::Shape& shape) { return drag::hoelzer_sommerfeld(0.6, re, shape); };
  double mean = 0;
  for (const drag::Shape& shape : {round, blunt}) {
    ball.sphericity = shape.sphericity;
    const FluidForce found = forces->on(ball);
    const double expected = law(shape) / (0.4 * law(round) + 0.6 * law(blunt)) * volume * 2000;
    expect_near(found.drag, {-0.3 * expected, 0.4 * expected, 0}, 1e-9 * expected);
    EXPECT_NEAR(found.pressure[1], 3 * volume, 1e-12 * volume);
    mean += (shape.sphericity == 1 ? 0.4 : 0.6) * found.drag[1];
  }
  EXPECT_NEAR(mean, volume * 2000 * 0.4, 1e-9 * mean);
}

TEST_F(FluidForcesTest, OfAFileWithoutWindowsAreTheMean) {
  // forces.h5 of a coupled mill
  const auto file = write({pushing});
  drop("window");
  VoxelForces forces(file, FluidTime::mean);
  const BallInFluid ball{{0.2, 0.2, 0.1}, {0, 0, 0}, 0.004};
  EXPECT_NEAR(forces.on(ball).pressure[0], 2 * ball.volume(), 1e-12 * ball.volume());
  const std::string message = tests::message_of([&] { VoxelForces(file, FluidTime::windows); });
  EXPECT_NE(message.find("slurry.h5: has no time windows"), std::string::npos) << message;
}

TEST_F(FluidForcesTest, OfAFlowWithoutBallsAreRefused) {
  const auto file = write({pushing});
  drop("balls");
  const std::string message = tests::message_of([&] { VoxelForces(file, FluidTime::mean); });
  EXPECT_NE(message.find("slurry.h5"), std::string::npos) << message;
  EXPECT_NE(message.find("no forces on balls"), std::string::npos) << message;
}

TEST_F(FluidForcesTest, OfAFileThatHasChangedSinceItWasCheckedAreRefused) {
  FluidSettings fluid;
  fluid.kind = FluidKind::slurry;
  fluid.file = write({pushing});
  fluid.file_id = file_fingerprint(fluid.file);
  EXPECT_NE(make_fluid_forces(fluid), nullptr);
  fluid.file_id = "0123456789abcdef";
  const std::string message = tests::message_of([&] { make_fluid_forces(fluid); });
  EXPECT_NE(message.find("slurry.h5: has changed since millDem checked it"), std::string::npos) << message;
}

TEST_F(FluidForcesTest, ThatAreNotFiniteAreRefusedWithTheirVoxel) {
  const auto broken = [](const Vector& x) {
    Felt felt;
    felt.exchange = x[0] > 0.3 && x[1] < 0.1 && x[2] < 0.1 ? std::numeric_limits<double>::quiet_NaN() : 1;
    return felt;
  };
  const auto file = write({broken});
  const std::string message = tests::message_of([&] { VoxelForces(file, FluidTime::mean); });
  EXPECT_NE(message.find("slurry.h5"), std::string::npos) << message;
  EXPECT_NE(message.find("exchange"), std::string::npos) << message;
  EXPECT_NE(message.find("voxel x y z = (3, 0, 0)"), std::string::npos) << message;
}

}  // namespace
}  // namespace millfoam::dem_driver
