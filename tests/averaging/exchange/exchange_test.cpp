// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <future>
#include <string>

#include "averaging/exchange/exchange_fields.hpp"
#include "averaging/exchange/exchange_pipes.hpp"
#include "tests/averaging/test_support.hpp"

namespace millfoam::averaging {
namespace {

/// What the action throws.
template <typename Action>
std::string refusal_of(const Action& action) {
  try {
    action();
  } catch (const ExchangeError& error) {
    return error.what();
  }
  return {};
}

/// Both ends of the pipes in a folder.
class Exchange : public testing::Test {
 protected:
  void SetUp() override {
    auto other = std::async(std::launch::async, [&] {
      return std::make_unique<ExchangePipes>(folder_ / "pipes", ExchangeSide::flow);
    });
    balls_ = std::make_unique<ExchangePipes>(folder_ / "pipes", ExchangeSide::balls);
    flow_ = other.get();
  }

  TemporaryFolder folder_;
  std::unique_ptr<ExchangePipes> balls_, flow_;
};

TEST_F(Exchange, passes_messages_both_ways_in_order) {
  flow_->send({"one", "text", {1, 2.5}});
  flow_->send({"two", "", {}});
  const ExchangeMessage one = balls_->receive();
  EXPECT_EQ(one.kind, "one");
  EXPECT_EQ(one.text, "text");
  EXPECT_EQ(one.numbers, (std::vector<double>{1, 2.5}));
  EXPECT_EQ(balls_->receive("two").numbers.size(), 0U);
  balls_->send({"back", "", {3}});
  EXPECT_EQ(flow_->receive().numbers, std::vector<double>{3});
}

TEST_F(Exchange, passes_more_than_a_pipe_holds) {
  const std::vector<double> many(300000, 0.25);
  auto sent = std::async(std::launch::async, [&] { flow_->send({"many", "", many}); });
  EXPECT_EQ(balls_->receive().numbers, many);
  sent.get();
}

TEST_F(Exchange, says_that_the_other_side_has_ended) {
  flow_.reset();
  EXPECT_NE(refusal_of([&] { balls_->receive(); }).find("the flow has ended"), std::string::npos);
  EXPECT_NE(refusal_of([&] { balls_->send({"one", "", {}}); }).find("the flow has ended"), std::string::npos);
}

TEST_F(Exchange, carries_the_reason_of_a_refusal) {
  balls_->refuse("a ball is lost");
  EXPECT_NE(
      refusal_of([&] { flow_->receive("solids"); }).find("the run of the balls cannot go on: a ball is lost"),
      std::string::npos);
}

TEST_F(Exchange, refuses_another_kind_and_what_is_no_message) {
  flow_->send({"one", "", {}});
  EXPECT_NE(refusal_of([&] { balls_->receive("two"); }).find("sends 'one', expected 'two'"),
            std::string::npos);
  // Lengths of 0, so that only the mark gives it away
  std::ofstream(folder_ / "pipes" / "to_balls") << std::string(8, 'x') << std::string(92, '\0') << std::flush;
  EXPECT_NE(refusal_of([&] { balls_->receive(); }).find("no message of millFoam"), std::string::npos);
}

TEST(ExchangePipes, refuses_a_file_in_the_place_of_a_pipe) {
  const TemporaryFolder folder;
  folder.write("to_balls", "text");
  EXPECT_NE(refusal_of([&] { ExchangePipes(folder / ".", ExchangeSide::flow); }).find("is no named pipe"),
            std::string::npos);
}

TEST(ExchangePipes, that_fail_half_way_let_the_other_side_end) {
  const TemporaryFolder folder;
  folder.write("to_flow", "text");
  auto flow = std::async(std::launch::async, [&] {
    return refusal_of([&] { ExchangePipes(folder / ".", ExchangeSide::flow); });
  });
  expect_named(refusal_of([&] { ExchangePipes(folder / ".", ExchangeSide::balls); }), {"is no named pipe"});
  expect_named(flow.get(), {"is no named pipe"});
  for (const auto& open : std::filesystem::directory_iterator("/proc/self/fd")) {
    std::error_code closed;
    EXPECT_NE(std::filesystem::read_symlink(open.path(), closed).filename(), "to_balls");
  }
}

const BoxGrid grid({0, -1, 0}, {0.5, 1, 2}, {2, 1, 3}, {false, false, true});

TEST(ExchangeFields, come_back_from_their_messages) {
  const FlowOffer flow = unpack_flow_offer(pack(FlowOffer{true, 1.5, "version"}));
  EXPECT_TRUE(flow.polydispersity);
  EXPECT_EQ(flow.time, 1.5);
  EXPECT_EQ(flow.program, "version");

  const BallsOffer balls = unpack_balls_offer(pack(BallsOffer{grid, 3, -6.4, "version", "mill"}));
  EXPECT_EQ(balls.grid.lower(), grid.lower());
  EXPECT_EQ(balls.grid.upper(), grid.upper());
  EXPECT_EQ(balls.grid.shape(), grid.shape());
  EXPECT_EQ(balls.grid.periodic(), grid.periodic());
  EXPECT_EQ(balls.time0, 3);
  EXPECT_EQ(balls.angular_velocity, -6.4);
  EXPECT_EQ(balls.program, "version");
  EXPECT_EQ(balls.mill, "mill");
  EXPECT_FALSE(unpack_balls_offer(pack(BallsOffer{grid, 3, {}, "", ""})).angular_velocity);

  const std::size_t n = grid.size();
  ForcesUntil forces{2.5, -0.5, {}};
  forces.fields.inside.assign(n, 1);
  forces.fields.pressure_force.assign(3 * n, 2);
  forces.fields.exchange.assign(n, 3);
  forces.fields.drag_force.assign(3 * n, 4);
  forces.fields.solidity.assign(n, 5);
  forces.fields.diameter.assign(n, 6);
  const ForcesUntil felt = unpack_forces(pack(forces), n);
  EXPECT_EQ(felt.time, 2.5);
  EXPECT_EQ(felt.torque, -0.5);
  EXPECT_EQ(felt.fields.inside, forces.fields.inside);
  EXPECT_EQ(felt.fields.pressure_force, forces.fields.pressure_force);
  EXPECT_EQ(felt.fields.exchange, forces.fields.exchange);
  EXPECT_EQ(felt.fields.drag_force, forces.fields.drag_force);
  EXPECT_EQ(felt.fields.solidity, forces.fields.solidity);
  EXPECT_EQ(felt.fields.diameter, forces.fields.diameter);

  SolidsAt solids{0.5, 1e-5, {}};
  solids.fields.solidity.assign(n, 0.1);
  solids.fields.velocity.assign(3 * n, 0.2);
  solids.fields.diameter.assign(n, 0.3);
  solids.fields.diameter43.assign(n, 0.4);
  EXPECT_TRUE(unpack_solids(pack(solids), n).fields.inside_fraction.empty());
  solids.fields.inside_fraction.assign(n, 0.5);
  const SolidsAt seen = unpack_solids(pack(solids), n);
  EXPECT_EQ(seen.time, 0.5);
  EXPECT_EQ(seen.deposited, 1e-5);
  EXPECT_EQ(seen.fields.solidity, solids.fields.solidity);
  EXPECT_EQ(seen.fields.diameter, solids.fields.diameter);
  EXPECT_EQ(seen.fields.diameter43, solids.fields.diameter43);
  EXPECT_EQ(seen.fields.velocity, solids.fields.velocity);
  EXPECT_EQ(seen.fields.inside_fraction, solids.fields.inside_fraction);
}

TEST(ExchangeFields, of_another_grid_are_refused) {
  SolidsAt solids;
  solids.fields.solidity.assign(4, 0);
  EXPECT_NE(refusal_of([&] { unpack_solids(pack(solids), 6); }).find("another length"), std::string::npos);
  EXPECT_NE(refusal_of([&] {
              unpack_forces({ForcesUntil::kind, "", {}}, 6);
            }).find("another length"),
            std::string::npos);
}

TEST(ExchangeFields, with_a_number_too_many_or_too_few_are_refused) {
  const auto longer = [](ExchangeMessage message) {
    message.numbers.push_back(0);
    return message;
  };
  const auto shorter = [](ExchangeMessage message) {
    message.numbers.pop_back();
    return message;
  };
  const std::size_t n = grid.size();
  const ExchangeMessage flow = pack(FlowOffer{}), balls = pack(BallsOffer{grid, 0, {}, "", ""});
  const ExchangeMessage forces{ForcesUntil::kind, "", std::vector<double>(2 + 10 * n)};
  const ExchangeMessage solids{SolidsAt::kind, "", std::vector<double>(2 + 7 * n)};
  EXPECT_EQ(refusal_of([&] { unpack_forces(forces, n); }), "");
  EXPECT_EQ(refusal_of([&] { unpack_solids(solids, n); }), "");
  for (const auto& change : {std::function<ExchangeMessage(ExchangeMessage)>(longer),
                             std::function<ExchangeMessage(ExchangeMessage)>(shorter)}) {
    expect_named(refusal_of([&] { unpack_flow_offer(change(flow)); }), {"'flow'", "another length"});
    expect_named(refusal_of([&] { unpack_balls_offer(change(balls)); }), {"'balls'", "another length"});
    expect_named(refusal_of([&] { unpack_forces(change(forces), n); }), {"'forces'", "another length"});
    expect_named(refusal_of([&] { unpack_solids(change(solids), n); }), {"'solids'", "another length"});
  }
}

}  // namespace
}  // namespace millfoam::averaging
