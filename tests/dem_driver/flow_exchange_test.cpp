// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/flow_exchange.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <future>
#include <limits>
#include <string>
#include <tuple>

#include "meshing/mill/mill_charge.hpp"
#include "meshing/mill/superquadric.hpp"
#include "meshing/surface/pi.hpp"
#include "millfoam_version.hpp"
#include "tests/dem_driver/small_mill.hpp"

namespace millfoam::dem_driver {
namespace {

using averaging::BallFields;
using averaging::BoxGrid;
using averaging::ExchangePipes;
using averaging::ExchangeSide;
using tests::message_of;

const BoxGrid box({0, 0, 0}, {0.04, 0.04, 0.02}, {4, 4, 2}, {false, false, true});
constexpr double dem_step = 1e-5, diameter = 0.004;
constexpr long first_step = 1000;

/// A uniform flow.
BallFields uniform(double up, double exchange, double speed) {
  const std::size_t n = box.size();
  BallFields fields{std::vector<double>(n, 1),        std::vector<double>(3 * n, 0),
                    std::vector<double>(n, exchange), std::vector<double>(3 * n, 0),
                    std::vector<double>(n, 0.3),      std::vector<double>(n, diameter)};
  for (std::size_t i = 0; i < n; ++i) {
    fields.pressure_force[3 * i + 1] = up;
    fields.drag_force[3 * i] = exchange * speed;
  }
  return fields;
}

TEST(VoxelField, is_over_a_ball_the_mean_of_its_voxels) {
  BallFields fields = uniform(0, 0, 0);
  for (std::size_t i = 0; i < box.size(); ++i) fields.exchange[i] = static_cast<double>(i);
  const VoxelField field(box, fields);
  EXPECT_DOUBLE_EQ(field.over({0.015, 0.005, 0.005}, diameter).exchange, 1);
  EXPECT_NEAR(field.over({0.02, 0.005, 0.005}, diameter).exchange, 1.5, 1e-12);
  // Its cube has an edge of 3.22 mm: a quarter of it lies beyond the face at 0.02 m
  const double edge = std::cbrt(pi / 6) * diameter;
  EXPECT_NEAR(field.over({0.02 - edge / 4, 0.005, 0.005}, diameter).exchange, 1.25, 1e-12);
  // The next period's first layer has the numbers 0 to 15, the last one 16 to 31
  EXPECT_NEAR(field.over({0.005, 0.005, 0.02}, diameter).exchange, 8, 1e-12);
  // A quarter beyond the face along x and along y: 1, 2, 5 and 6 with 9, 3, 3 and 1 sixteenths
  EXPECT_NEAR(field.over({0.02 - edge / 4, 0.01 - edge / 4, 0.005}, diameter).exchange, 2.25, 1e-12);
  // Beyond the box there is nothing, and what is inside counts whole: the last voxel of a row
  EXPECT_DOUBLE_EQ(field.over({0.04, 0.005, 0.005}, diameter).exchange, 3);
  EXPECT_FALSE(field.over({-0.01, 0.005, 0.005}, diameter).known);
  EXPECT_TRUE(field.over({0, 0.005, 0.005}, diameter).known);
  fields.inside.assign(box.size(), 0);
  EXPECT_FALSE(VoxelField(box, fields).over({0.015, 0.005, 0.005}, diameter).known);
}

/// Balls that meet a flow which the test writes.
class FlowExchangeTest : public testing::Test {
 protected:
  FluidOrder order() const {
    FluidOrder result;
    result.fluid.kind = FluidKind::flow;
    result.fluid.file = folder_.path() / "exchange";
    result.timestep = dem_step;
    result.record_steps = 100;
    result.exchange = ExchangeOrder{box};
    result.exchange->ball_density = 2500;
    result.exchange->smallest_ball = diameter;
    result.exchange->rayleigh_fraction = 0.2;
    result.exchange->begin = first_step;
    result.exchange->end = first_step + 1000;
    return result;
  }

  /// Starts a flow, which ends its side when it returns.
  void start(const std::function<void(ExchangePipes&)>& flow) {
    flow_ = std::async(std::launch::async, [this, flow] {
      ExchangePipes pipes(folder_.path() / "exchange", ExchangeSide::flow);
      flow(pipes);
    });
  }

  /// A flow that greets and takes the first balls.
  static averaging::SolidsAt greet(ExchangePipes& pipes, double time = 0) {
    pipes.send(pack(averaging::FlowOffer{false, time, version()}));
    averaging::unpack_balls_offer(pipes.receive(averaging::BallsOffer::kind));
    return averaging::unpack_solids(pipes.receive(averaging::SolidsAt::kind), box.size());
  }

  /// One ball that moves along x.
  static std::vector<BallInFluid> ball() { return {{{0.015, 0.02, 0.01}, {0.5, 0, 0}, diameter}}; }

  tests::TemporaryFolder folder_;
  std::future<void> flow_;
  RankGroup alone_;
};

TEST_F(FlowExchangeTest, gives_the_balls_and_gets_their_forces) {
  const double volume = pi / 6 * diameter * diameter * diameter;
  start([&](ExchangePipes& pipes) {
    const auto first = greet(pipes);
    EXPECT_EQ(first.time, 0);
    EXPECT_NEAR(first.deposited / volume, 1, 1e-12);
    EXPECT_EQ(first.fields.velocity[3 * box.offset({1, 1, 0})], 0.5);
    pipes.send(pack(averaging::ForcesUntil{0.00203, 0, uniform(1e4, 2e5, 0.8)}));
    const auto second = averaging::unpack_solids(pipes.receive(averaging::SolidsAt::kind), box.size());
    EXPECT_NEAR(second.time, 0.00203, 1e-12);
    pipes.send(pack(averaging::ForcesUntil{0.01, 0, uniform(2e4, 0, 0)}));
    averaging::unpack_solids(pipes.receive(averaging::SolidsAt::kind), box.size());
    pipes.send({averaging::exchange_end, {}, {}});
  });
  FlowExchange exchange(order(), first_step, alone_);
  EXPECT_TRUE(exchange.due(first_step));
  exchange.meet(first_step, ball());
  EXPECT_FALSE(exchange.due(first_step + 202));
  EXPECT_TRUE(exchange.due(first_step + 203));
  const BallInFluid felt{{0.015, 0.02, 0.01}, {0.5, 0, 0}, diameter};
  EXPECT_NEAR(exchange.on(felt).pressure[1], 1e4 * volume, 1e-12);
  EXPECT_NEAR(exchange.on(felt).drag[0], 2e5 * (0.8 - 0.5) * volume, 1e-12);
  exchange.meet(first_step + 203, ball());
  EXPECT_NEAR(exchange.on(felt).pressure[1], 2e4 * volume, 1e-12);
  exchange.meet(first_step + 1000, ball());
  EXPECT_FALSE(exchange.due(first_step + 100000));
  flow_.get();
}

TEST_F(FlowExchangeTest, gives_all_of_the_balls_where_walls_cut_the_voxels) {
  const auto mill = tests::small_mill();
  const CaseFolder drum{folder_.path() / "case"};
  tests::write_drum(drum, mill.geometry);
  const BoxGrid around({-0.022, -0.022, 0}, {0.022, 0.022, 0.012}, {11, 11, 3}, {false, false, true});
  FluidOrder in_the_drum = order();
  const ExchangeOrder still = *in_the_drum.exchange;
  in_the_drum.exchange = ExchangeOrder{around};
  in_the_drum.exchange->walls = {drum.walls() / "shell.stl"};
  in_the_drum.exchange->angular_velocity = mill.angular_velocity;
  in_the_drum.exchange->ball_density = still.ball_density;
  in_the_drum.exchange->smallest_ball = still.smallest_ball;
  in_the_drum.exchange->begin = still.begin;
  in_the_drum.exchange->end = still.end;
  // Along the wall, one behind the other
  std::vector<BallInFluid> balls;
  double volume = 0;
  for (int i = 0; i < 30; ++i) {
    const double angle = 2 * pi * i / 30, radius = i % 3 == 0 ? 0.0015 : 0.001;
    balls.push_back(
        {{0.0186 * std::cos(angle), 0.0186 * std::sin(angle), 0.0004 * i}, {0, 0, 0.1}, 2 * radius});
    volume += 4 * pi / 3 * radius * radius * radius;
  }
  start([&](ExchangePipes& pipes) {
    pipes.send(pack(averaging::FlowOffer{true, 0, version()}));
    pipes.receive(averaging::BallsOffer::kind);
    const auto solids = averaging::unpack_solids(pipes.receive(averaging::SolidsAt::kind), around.size());
    ASSERT_EQ(solids.fields.inside_fraction.size(), around.size());
    double all = 0, inside = 0, along = 0;
    for (std::size_t n = 0; n < around.size(); ++n) {
      const double room = solids.fields.inside_fraction[n] * around.voxel_volume();
      inside += room;
      all += solids.fields.solidity[n] * room;
      along += solids.fields.solidity[n] * room * solids.fields.velocity[3 * n + 2];
    }
    // A prism of 60 sides
    EXPECT_NEAR(inside / (30 * std::sin(2 * pi / 60) * 0.02 * 0.02 * 0.012), 1, 1e-9);
    EXPECT_NEAR(all / volume, 1, 1e-12);
    EXPECT_NEAR(along / (0.1 * volume), 1, 1e-12);
    pipes.send({averaging::exchange_end, {}, {}});
  });
  in_the_drum.exchange->end = first_step;
  FlowExchange exchange(in_the_drum, first_step, alone_);
  exchange.meet(first_step, balls);
  flow_.get();
}

TEST_F(FlowExchangeTest, of_a_mixture_gives_each_size_its_own_drag) {
  start([&](ExchangePipes& pipes) {
    pipes.send(pack(averaging::FlowOffer{true, 0, version()}));
    pipes.receive(averaging::BallsOffer::kind);
    pipes.receive(averaging::SolidsAt::kind);
    pipes.send(pack(averaging::ForcesUntil{0.001, 0, uniform(0, 1000, 0.8)}));
  });
  FlowExchange exchange(order(), first_step, alone_);
  exchange.meet(first_step, ball());
  flow_.get();
  const BallInFluid large{{0.015, 0.02, 0.01}, {0, 0, 0}, 2 * diameter};
  EXPECT_NEAR(exchange.on(large).drag[0] / (large.volume() * mixture_factor(2, 0.3) * 800), 1, 1e-12);
}

TEST_F(FlowExchangeTest, gives_the_balls_the_torque_of_the_flow) {
  start([&](ExchangePipes& pipes) {
    greet(pipes);
    pipes.send(pack(averaging::ForcesUntil{0.001, -1.7e-4, uniform(1e4, 2e5, 0.8)}));
  });
  const std::vector<BallInFluid> balls{{{0.015, 0.02, 0.01}, {0.5, 0, 0}, diameter},
                                       {{0.025, 0.03, 0.01}, {0.1, 0.2, 0}, diameter},
                                       {{0.031, 0.008, 0.004}, {0, 0, 0.1}, diameter}};
  FlowExchange exchange(order(), first_step, alone_);
  exchange.meet(first_step, balls);
  flow_.get();
  double torque = 0;
  Vector added{};
  for (const BallInFluid& one : balls) {
    const FluidForce force = exchange.on(one);
    torque += one.position[0] * force.sum()[1] - one.position[1] * force.sum()[0];
    for (std::size_t k = 0; k < 3; ++k) added[k] += force.balance[k];
  }
  EXPECT_NEAR(torque, -1.7e-4, 1e-16);
  EXPECT_NEAR(added[0], 0, 1e-16);
  EXPECT_NEAR(added[1], 0, 1e-16);
  EXPECT_EQ(added[2], 0);
}

TEST_F(FlowExchangeTest, meets_every_step_of_a_flow_with_steps_shorter_than_the_balls) {
  const double volume = pi / 6 * diameter * diameter * diameter;
  start([&](ExchangePipes& pipes) {
    greet(pipes);
    // Ends nearest to the balls' step 0, and nearest to their step 1
    pipes.send(pack(averaging::ForcesUntil{0.4 * dem_step, 0, uniform(1e4, 0, 0)}));
    const auto again = averaging::unpack_solids(pipes.receive(averaging::SolidsAt::kind), box.size());
    EXPECT_EQ(again.time, 0);
    pipes.send(pack(averaging::ForcesUntil{0.8 * dem_step, 0, uniform(2e4, 0, 0)}));
  });
  FlowExchange exchange(order(), first_step, alone_);
  exchange.meet(first_step, ball());
  flow_.get();
  EXPECT_FALSE(exchange.due(first_step));
  EXPECT_TRUE(exchange.due(first_step + 1));
  EXPECT_NEAR(exchange.on({{0.015, 0.02, 0.01}, {0.5, 0, 0}, diameter}).pressure[1], 2e4 * volume, 1e-12);
}

TEST_F(FlowExchangeTest, lets_the_flow_end_within_the_last_record) {
  for (const long before : {100L, 101L}) {
    start([&](ExchangePipes& pipes) {
      greet(pipes, static_cast<double>(1000 - before) * dem_step);
      pipes.send({averaging::exchange_end, {}, {}});
    });
    const long step = first_step + 1000 - before;
    FlowExchange exchange(order(), step, alone_);
    const std::string message = message_of([&] { exchange.meet(step, ball()); });
    flow_.get();
    EXPECT_EQ(message.empty(), before == 100) << message;
  }
}

TEST_F(FlowExchangeTest, refuses_another_message_in_the_place_of_forces) {
  start([&](ExchangePipes& pipes) {
    greet(pipes);
    auto message = pack(averaging::ForcesUntil{0.001, 0, uniform(0, 0, 0)});
    message.kind = "other";
    pipes.send(message);
  });
  FlowExchange exchange(order(), first_step, alone_);
  const std::string message = message_of([&] { exchange.meet(first_step, ball()); });
  EXPECT_NE(message.find("the flow sends 'other', expected 'forces'"), std::string::npos) << message;
  flow_.get();
}

TEST_F(FlowExchangeTest, refuses_a_flow_that_ends_early) {
  start([&](ExchangePipes& pipes) {
    greet(pipes);
    pipes.send({averaging::exchange_end, {}, {}});
  });
  FlowExchange exchange(order(), first_step, alone_);
  EXPECT_NE(message_of([&] {
              exchange.meet(first_step, ball());
            }).find("the flow has ended at its time 0 s, expected 0.01 s"),
            std::string::npos);
  flow_.get();
}

TEST_F(FlowExchangeTest, refuses_another_version_and_another_time_and_tells_the_flow) {
  std::string told;
  start([&](ExchangePipes& pipes) {
    pipes.send(pack(averaging::FlowOffer{false, 0, "of yesterday"}));
    told = message_of([&] { pipes.receive(); });
  });
  EXPECT_NE(message_of([&] {
              FlowExchange(order(), first_step, alone_);
            }).find("the flow is of version of yesterday"),
            std::string::npos);
  flow_.get();
  EXPECT_NE(told.find("cannot go on: the flow is of version of yesterday"), std::string::npos);

  start([&](ExchangePipes& pipes) {
    pipes.send(pack(averaging::FlowOffer{false, 0.05, version()}));
    told = message_of([&] { pipes.receive(); });
  });
  EXPECT_NE(message_of([&] {
              FlowExchange(order(), first_step + 4000, alone_);
            }).find("the flow begins at its time 0.05 s, the balls at 0.04 s"),
            std::string::npos);
  flow_.get();
  EXPECT_NE(told.find("cannot go on: the flow begins at its time 0.05 s"), std::string::npos) << told;
}

TEST_F(FlowExchangeTest, refuses_forces_that_are_not_finite_or_too_strong) {
  BallFields broken = uniform(0, 0, 0);
  broken.pressure_force[3 * box.offset({2, 1, 0})] = std::numeric_limits<double>::quiet_NaN();
  BallFields nowhere = uniform(0, 0, 0);
  nowhere.inside[box.offset({3, 1, 0})] = std::numeric_limits<double>::quiet_NaN();
  const double none = std::numeric_limits<double>::quiet_NaN();
  for (const auto& [fields, torque, words] :
       {std::tuple{broken, 0.0, "not finite in voxel x y z = (2, 1, 0)"},
        std::tuple{nowhere, 0.0, "not finite in voxel x y z = (3, 1, 0)"},
        std::tuple{uniform(0, 0, 0), none, "torque on the balls is not finite"},
        std::tuple{uniform(0, 2e7, 0), 0.0, "takes 0.08 of"}}) {
    std::string told;
    start([&, given = fields, turns = torque](ExchangePipes& pipes) {
      greet(pipes);
      pipes.send(pack(averaging::ForcesUntil{0.001, turns, given}));
      told = message_of([&] { pipes.receive(); });
    });
    {
      FlowExchange exchange(order(), first_step, alone_);
      EXPECT_NE(message_of([&] { exchange.meet(first_step, ball()); }).find(words), std::string::npos);
    }
    flow_.get();
    EXPECT_NE(told.find(words), std::string::npos);
  }
}

TEST(FluidOrderOfAFlow, comes_back_from_its_file) {
  const tests::TemporaryFolder folder;
  meshing::Mill mill = tests::small_mill();
  mill.flow.write_interval = 3 * mill.dem.record_interval;
  mill.averages.voxels = {{-0.02, -0.02, 0}, {0.02, 0.02, mill.geometry.length}, {4, 4, 2}};
  mill.averages.method = "sample";
  mill.averages.template_points = 9;
  mill.fingerprint.averages = "00000000000000aa";
  DemPlan plan = plan_dem(mill);
  continue_from(2 * plan.turning_steps, plan);
  meet_flow(folder.path() / "exchange", mill, plan);
  EXPECT_EQ(plan.restart_steps, 3 * plan.step.steps_per_record);
  FluidOrder order{plan.fluid, plan.step.value, plan.step.steps_per_record, std::nullopt};
  order.exchange = exchange_of(mill, {"../walls/shell.stl"}, plan.begin, plan.end_step());
  const auto file = folder.path() / "dem" / "fluid.json";
  std::filesystem::create_directories(file.parent_path());
  write_fluid_order(file, mill, order);
  const FluidOrder found = read_fluid_order(file);
  EXPECT_EQ(found.fluid.kind, FluidKind::flow);
  EXPECT_TRUE(std::filesystem::weakly_canonical(found.fluid.file) ==
              std::filesystem::weakly_canonical(folder.path() / "exchange"));
  ASSERT_TRUE(found.exchange);
  EXPECT_EQ(found.exchange->grid.shape(), mill.averages.voxels.shape);
  EXPECT_EQ(found.exchange->walls,
            std::vector<std::filesystem::path>{file.parent_path() / "../walls/shell.stl"});
  EXPECT_EQ(found.exchange->grid.lower(), mill.averages.voxels.lower);
  EXPECT_EQ(found.exchange->grid.upper(), mill.averages.voxels.upper);
  EXPECT_EQ(found.exchange->grid.periodic(), (std::array<bool, 3>{false, false, true}));
  EXPECT_FALSE(found.exchange->exact);
  EXPECT_EQ(found.exchange->template_points, 9);
  EXPECT_EQ(found.exchange->mill, "00000000000000aa");
  EXPECT_EQ(found.exchange->smallest_ball, 0.002);
  EXPECT_EQ(found.exchange->rayleigh_fraction, 0.2);
  EXPECT_EQ(found.exchange->begin, plan.begin);
  EXPECT_EQ(found.exchange->angular_velocity, mill.angular_velocity);
  EXPECT_EQ(found.exchange->ball_density, mill.ball.density);
  EXPECT_EQ(found.exchange->end, plan.end_step());
  EXPECT_TRUE(found.fluid.shapes.bed.empty());
}

TEST(FluidOrderOfAFlow, has_the_shapes_of_the_balls_with_the_law_that_knows_them) {
  const tests::TemporaryFolder folder;
  meshing::Mill mill = tests::small_mill();
  meshing::SizeClass& size = mill.charge.classes.front();
  mill.charge.classes.resize(1);
  meshing::SizeClass blunt = size;
  size.mass = meshing::ball_mass(mill, size.diameter);
  blunt.shape = meshing::Superquadric{{size.diameter / 2, size.diameter / 2, size.diameter / 2}, 4};
  blunt.mass = 3 * size.mass;
  mill.charge.classes.push_back(blunt);
  EXPECT_TRUE(shape_drag_of(mill).bed.empty());
  mill.flow.law = "HoelzerSommerfeld";
  FluidOrder order{{}, 1e-5, 1, std::nullopt};
  order.fluid.kind = FluidKind::slurry;
  order.fluid.shapes = shape_drag_of(mill);
  const auto file = folder.path() / "fluid.json";
  write_fluid_order(file, mill, order);
  const ShapeDrag found = read_fluid_order(file).fluid.shapes;
  ASSERT_EQ(found.bed.size(), 2U);
  EXPECT_DOUBLE_EQ(found.bed[0].share, 0.25);
  EXPECT_DOUBLE_EQ(found.bed[0].shape.sphericity, 1);
  EXPECT_DOUBLE_EQ(found.bed[1].share, 0.75);
  EXPECT_DOUBLE_EQ(found.bed[1].shape.sphericity, meshing::sphericity(*blunt.shape));
  EXPECT_EQ(found.slurry.density, mill.slurry.density);
  EXPECT_EQ(found.slurry.viscosity, mill.slurry.plastic_viscosity);
  mill.charge.classes.resize(1);
  EXPECT_TRUE(shape_drag_of(mill).bed.empty());
}

TEST(FluidOrderOfAFlow, changes_the_deck_with_the_averages_that_the_flow_gets) {
  meshing::Mill mill = tests::small_mill();
  mill.averages.voxels = {{-0.02, -0.02, 0}, {0.02, 0.02, 0.01}, {4, 4, 2}};
  mill.averages.method = "exact";
  mill.flow.write_interval = mill.dem.record_interval;
  const auto words = [&] {
    DemPlan plan = plan_dem(mill);
    meet_flow("exchange", mill, plan);
    return in_words(plan.fluid);
  };
  const std::string before = words();
  EXPECT_EQ(before,
            "forces of a flow that runs at the same time and gets exact averages on 4 x 4 x 2 voxels from "
            "(-0.02 -0.02 0) to (0.02 0.02 0.01) m");
  mill.averages.method = "sample";
  mill.averages.template_points = 9;
  EXPECT_NE(words().find("gets averages by 9 points along a diameter on 4 x 4 x 2"), std::string::npos);
  mill.flow.coupling.voxels = {{-0.02, -0.02, 0}, {0.02, 0.02, 0.01}, {5, 5, 2}};
  EXPECT_NE(words().find("on 5 x 5 x 2 voxels"), std::string::npos);
}

TEST(FluidOrderOfAFlow, has_a_restart_file_whenever_the_flow_is_written_after_whole_records) {
  meshing::Mill mill = tests::small_mill();
  for (const double records : {0.1, 3.2}) {
    mill.flow.write_interval = records * mill.dem.record_interval;
    DemPlan plan = plan_dem(mill);
    const std::string message = tests::message_of([&] { meet_flow("exchange", mill, plan); });
    EXPECT_NE(message.find("flow.write_interval"), std::string::npos) << message;
    EXPECT_NE(message.find("a whole number of times dem.record_interval, 0.01 s"), std::string::npos)
        << message;
  }
  mill.flow.write_interval = mill.dem.record_interval;
  DemPlan plan = plan_dem(mill);
  meet_flow("exchange", mill, plan);
  EXPECT_EQ(plan.restart_steps, plan.step.steps_per_record);
  EXPECT_TRUE(plan.fluid.file.is_absolute());
}

}  // namespace
}  // namespace millfoam::dem_driver
