// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/torque_balance.hpp"

#include <cmath>

namespace millfoam::dem_driver {

namespace {

double size(const Vector& v) {
  return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

double weight_of(const FluidForce& force) {
  return size(force.pressure) + size(force.drag);
}

}  // namespace

TorqueBalance::TorqueBalance(double torque, const std::vector<BallInFluid>& balls,
                             const std::function<FluidForce(const BallInFluid&)>& force, double least,
                             RankGroup& ranks) {
  std::vector<FluidForce> forces;
  forces.reserve(balls.size());
  std::vector<double> sums(4, 0.0);  // weight, weight times x and y, torque
  for (const BallInFluid& ball : balls) {
    const FluidForce& one = forces.emplace_back(force(ball));
    const double weight = weight_of(one);
    sums[0] += weight;
    sums[1] += weight * ball.position[0];
    sums[2] += weight * ball.position[1];
    sums[3] += ball.position[0] * (one.pressure[1] + one.drag[1]) -
               ball.position[1] * (one.pressure[0] + one.drag[0]);
  }
  sums = ranks.all_sums(std::move(sums));
  if (!(sums[0] > 0)) return;
  centre_ = {sums[1] / sums[0], sums[2] / sums[0]};
  std::vector<double> inertia(1, 0.0);
  for (std::size_t i = 0; i < balls.size(); ++i) {
    const double x = balls[i].position[0] - centre_[0], y = balls[i].position[1] - centre_[1];
    inertia[0] += weight_of(forces[i]) * (x * x + y * y);
  }
  inertia = ranks.all_sums(std::move(inertia));
  if (inertia[0] > least * least * sums[0]) factor_ = (torque - sums[3]) / inertia[0];
}

Vector TorqueBalance::on(const BallInFluid& ball, const FluidForce& force) const {
  const double size = factor_ * weight_of(force);
  return {-size * (ball.position[1] - centre_[1]), size * (ball.position[0] - centre_[0]), 0};
}

}  // namespace millfoam::dem_driver
