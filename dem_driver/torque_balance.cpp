// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/torque_balance.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace millfoam::dem_driver {

namespace {

double length(const Vector& v) {
  return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

double weight_of(const FluidForce& force) {
  return length(force.pressure) + length(force.drag);
}

}  // namespace

TorqueBalance::TorqueBalance(double torque, const std::vector<BallInFluid>& balls,
                             const std::function<FluidForce(const BallInFluid&)>& force, double ball,
                             RankGroup& ranks) {
  std::vector<double> weights;
  weights.reserve(balls.size());
  std::vector<double> sums(4, 0.0);  // weight, weight times x and y, torque
  for (const BallInFluid& one : balls) {
    const FluidForce felt = force(one);
    const double weight = weights.emplace_back(weight_of(felt));
    sums[0] += weight;
    sums[1] += weight * one.position[0];
    sums[2] += weight * one.position[1];
    sums[3] += torque_about_z(one, felt.sum());
  }
  sums = ranks.all_sums(std::move(sums));
  if (!(sums[0] > 0)) return;
  centre_ = {sums[1] / sums[0], sums[2] / sums[0]};
  std::vector<double> inertia(1, 0.0);
  for (std::size_t i = 0; i < balls.size(); ++i) {
    const double x = balls[i].position[0] - centre_[0], y = balls[i].position[1] - centre_[1];
    inertia[0] += weights[i] * (x * x + y * y);
  }
  inertia = ranks.all_sums(std::move(inertia));
  const double distance = std::sqrt(inertia[0] / sums[0]);
  if (!(distance > ball / 4)) return;
  const double largest = largest_share / distance;
  factor_ = std::clamp((torque - sums[3]) / inertia[0], -largest, largest);
}

Vector TorqueBalance::on(const BallInFluid& ball, const FluidForce& force) const {
  const double per_length = factor_ * weight_of(force);
  return {-per_length * (ball.position[1] - centre_[1]), per_length * (ball.position[0] - centre_[0]), 0};
}

}  // namespace millfoam::dem_driver
