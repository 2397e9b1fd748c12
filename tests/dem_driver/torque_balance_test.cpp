// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/torque_balance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <condition_variable>
#include <future>
#include <mutex>
#include <vector>

namespace millfoam::dem_driver {
namespace {

constexpr double diameter = 0.004;

/// Ten balls on a spiral; the fluid pushes the outer ones more strongly.
std::vector<BallInFluid> spiral() {
  std::vector<BallInFluid> balls;
  for (int i = 0; i < 10; ++i)
    balls.push_back({{0.004 * i * std::cos(i), 0.03 + 0.003 * i * std::sin(i), 0.01 * i}, {}, diameter});
  return balls;
}

FluidForce rising(const BallInFluid& ball) {
  FluidForce force;
  force.pressure = {0, 1e-3, 0};
  force.drag = {-0.05 * ball.position[0], 0, 0.02};
  return force;
}

TEST(TorqueBalance, gives_the_torque_and_no_force) {
  RankGroup alone;
  const auto balls = spiral();
  const TorqueBalance balance(3e-4, balls, rising, diameter, alone);
  double torque = 0;
  Vector sum{};
  for (const auto& ball : balls) {
    const Vector added = balance.on(ball, rising(ball));
    torque += torque_about_z(ball, rising(ball).sum()) + torque_about_z(ball, added);
    for (std::size_t k = 0; k < 3; ++k) sum[k] += added[k];
  }
  EXPECT_NEAR(torque, 3e-4, 1e-16);
  for (const double component : sum) EXPECT_NEAR(component, 0, 1e-16);
}

TEST(TorqueBalance, turns_two_equal_balls_about_their_middle) {
  RankGroup alone;
  const std::vector<BallInFluid> pair{{{0.1, 0.02, 0}, {}, diameter}, {{0.1, 0.04, 0}, {}, diameter}};
  const auto up = [](const BallInFluid&) { return FluidForce{{0, 1, 0}}; };  // torque 0.2 N m
  const TorqueBalance balance(0.194, pair, up, diameter, alone);
  // - 0.006 N m by a pair of forces 0.02 m apart
  EXPECT_NEAR(balance.on(pair[0], up(pair[0]))[0], -0.3, 1e-12);
  EXPECT_NEAR(balance.on(pair[1], up(pair[1]))[0], 0.3, 1e-12);
}

TEST(TorqueBalance, adds_at_most_half_of_the_fluids_force) {
  RankGroup alone;
  const std::vector<BallInFluid> pair{{{0.1, 0.02, 0}, {}, diameter}, {{0.1, 0.04, 0}, {}, diameter}};
  const auto up = [](const BallInFluid&) { return FluidForce{{0, 1, 0}}; };
  for (const double torque : {-1.0, 1.0}) {
    const TorqueBalance balance(torque, pair, up, diameter, alone);
    EXPECT_NEAR(balance.on(pair[1], up(pair[1]))[0], torque < 0 ? 0.5 : -0.5, 1e-12);
  }
}

TEST(TorqueBalance, needs_balls_that_are_apart) {
  RankGroup alone;
  const auto up = [](const BallInFluid&) { return FluidForce{{0, 1, 0}}; };
  for (const double apart : {0.4, 0.6}) {
    const std::vector<BallInFluid> pair{{{0.1, 0.02, 0}, {}, diameter},
                                        {{0.1, 0.02 + apart * diameter, diameter}, {}, diameter}};
    const TorqueBalance balance(0.2 - 1e-4, pair, up, diameter, alone);
    EXPECT_NEAR(balance.on(pair[1], up(pair[1]))[0], apart < 0.5 ? 0 : 1e-4 / (apart * diameter), 1e-12);
  }
}

TEST(TorqueBalance, pushes_no_ball_that_feels_no_fluid) {
  RankGroup alone;
  const TorqueBalance balance(3e-4, spiral(), rising, diameter, alone);
  EXPECT_EQ(balance.on({{1, 1, 0}, {}, diameter}, FluidForce{}), Vector{});
}

TEST(TorqueBalance, does_nothing_for_one_ball_and_for_none) {
  RankGroup alone;
  const std::vector<BallInFluid> one{{{0.1, 0.02, 0}, {}, diameter}};
  for (const auto& balls : {one, std::vector<BallInFluid>{}})
    EXPECT_EQ(TorqueBalance(1, balls, rising, diameter, alone).on(one[0], rising(one[0])), Vector{});
}

/// Two ranks that are threads of the test.
class TwoRanks {
 public:
  class Rank final : public RankGroup {
   public:
    Rank(TwoRanks& both, int number) : both_(both), number_(number) {}
    int rank() const override { return number_; }
    void sum(std::vector<double>& numbers) override { both_.meet(numbers, true, number_ == 0); }
    void broadcast(std::vector<double>& numbers) override { both_.meet(numbers, number_ == 0, true); }

   private:
    TwoRanks& both_;
    int number_;
  };

 private:
  /// Adds up what those give who give, for those who take.
  void meet(std::vector<double>& numbers, bool gives, bool takes) {
    std::unique_lock lock(mutex_);
    if (arrived_ == 0) sums_.clear();
    if (gives) {
      sums_.resize(numbers.size());
      for (std::size_t i = 0; i < numbers.size(); ++i) sums_[i] += numbers[i];
    }
    const long meeting = meeting_;
    if (++arrived_ == 2) {
      arrived_ = 0;
      ++meeting_;
      result_ = sums_;
      come_.notify_all();
    } else {
      come_.wait(lock, [&] { return meeting_ > meeting; });
    }
    if (takes) numbers = result_;
  }

  std::mutex mutex_;
  std::condition_variable come_;
  std::vector<double> sums_, result_;
  int arrived_ = 0;
  long meeting_ = 0;
};

TEST(TorqueBalance, of_balls_on_two_ranks_is_that_of_one) {
  RankGroup alone;
  const auto balls = spiral();
  const TorqueBalance whole(3e-4, balls, rising, diameter, alone);
  TwoRanks both;
  const auto on_rank = [&](int number) {
    TwoRanks::Rank rank(both, number);
    const std::vector<BallInFluid> own(balls.begin() + (number == 0 ? 0 : 4),
                                       balls.begin() + (number == 0 ? 4 : 10));
    return TorqueBalance(3e-4, own, rising, diameter, rank);
  };
  auto second = std::async(std::launch::async, on_rank, 1);
  const TorqueBalance first = on_rank(0);
  for (const TorqueBalance& part : {first, second.get()})
    for (const auto& ball : balls)
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_NEAR(part.on(ball, rising(ball))[k], whole.on(ball, rising(ball))[k], 1e-15);
}

}  // namespace
}  // namespace millfoam::dem_driver
