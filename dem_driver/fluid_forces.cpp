// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/fluid_forces.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "averaging/files/slurry_file.hpp"
#include "meshing/files/file_fingerprint.hpp"
#include "meshing/mill/mill.hpp"
#include "meshing/surface/pi.hpp"

namespace millfoam::dem_driver {

double BallInFluid::volume() const {
  return pi / 6 * diameter * diameter * diameter;
}

Vector FluidForce::sum() const {
  Vector result{};
  for (std::size_t k = 0; k < 3; ++k) result[k] = pressure[k] + drag[k] + balance[k];
  return result;
}

double torque_about_z(const BallInFluid& ball, const Vector& force) {
  return ball.position[0] * force[1] - ball.position[1] * force[0];
}

double share_below(double height, double radius) {
  const double cap = std::clamp(radius - height, 0.0, 2 * radius);
  return cap * cap * (3 * radius - cap) / (4 * radius * radius * radius);
}

FluidForce PoolForces::on(const BallInFluid& ball) const {
  const double share = share_below(ball.position[1] - level_, ball.diameter / 2);
  FluidForce force;
  force.pressure[1] = share * density_ * meshing::gravity * ball.volume();
  return force;
}

std::unique_ptr<FluidForces> make_fluid_forces(const FluidSettings& fluid) {
  if (fluid.kind == FluidKind::slurry) {
    if (file_fingerprint(fluid.file) != fluid.file_id)
      throw averaging::SlurryFileError(fluid.file.string() +
                                       ": has changed since millDem checked it, run millDem again");
    return std::make_unique<VoxelForces>(fluid.file, fluid.time, fluid.shapes);
  }
  return std::make_unique<PoolForces>(fluid.level, fluid.density);
}

double mixture_factor(double y, double solidity) {
  const double voidage = 1 - solidity;
  return voidage / y + solidity + 0.064 * voidage * y;
}

VoxelForces::VoxelForces(const std::filesystem::path& file, FluidTime time, ShapeDrag shapes)
    : reader_(file), time_(time), shapes_(std::move(shapes)) {
  if (time == FluidTime::windows && reader_.header().windows == 0)
    throw averaging::SlurryFileError(
        file.string() +
        ": has no time windows, only a mean over the run; expected a flow's slurry.h5, "
        "or --fluid-time mean");
  set_time(0);
}

VoxelField VoxelForces::read(std::size_t window) const {
  return {reader_.grid(), time_ == FluidTime::mean ? reader_.mean() : reader_.window(window)};
}

void VoxelForces::set_time(double time) {
  if (time_ == FluidTime::mean) {
    if (!early_) early_ = read(0);
    return;
  }
  const std::size_t last = reader_.header().windows - 1;
  // A run's times rise, so the window of the last call is near
  std::size_t window = window_ > last || time < reader_.middle(window_) ? 0 : window_;
  while (window < last && reader_.middle(window + 1) <= time) ++window;
  const std::size_t next = std::min(window + 1, last);
  if (window != window_) {
    if (window == window_ + 1 && late_)
      early_ = std::move(late_);
    else
      early_ = read(window);
    late_ = read(next);
    window_ = window;
  }
  const double begin = reader_.middle(window), length = reader_.middle(next) - begin;
  blend_ = length > 0 ? std::clamp((time - begin) / length, 0.0, 1.0) : 0;
}

namespace {

/// Between a ball and the fluid that it feels, m/s.
double slip_of(const BallInFluid& ball, const FeltFluid& felt) {
  double square = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double slip = felt.drag[k] / felt.exchange - ball.velocity[k];
    square += slip * slip;
  }
  return std::sqrt(square);
}

}  // namespace

FluidForce force_on(const BallInFluid& ball, const FeltFluid& felt, bool polydispersity,
                    const ShapeDrag& shapes) {
  FluidForce force;
  force.known = felt.known;
  if (!felt.known) return force;
  double factor = 1;
  if (polydispersity && felt.diameter > 0)
    factor = mixture_factor(ball.diameter / felt.diameter, felt.solidity);
  if (!shapes.bed.empty() && felt.exchange > 0)
    factor *= shapes.factor(ball.sphericity, felt.solidity, slip_of(ball, felt), ball.diameter);
  const double volume = ball.volume();
  for (std::size_t k = 0; k < 3; ++k) {
    force.pressure[k] = volume * felt.pressure[k];
    force.drag[k] = volume * factor * (felt.drag[k] - felt.exchange * ball.velocity[k]);
  }
  return force;
}

FluidForce VoxelForces::on(const BallInFluid& ball) const {
  FeltFluid felt = early_->at(ball.position);
  if (blend_ > 0) {
    const FeltFluid late = late_->at(ball.position);
    if (felt.known && late.known) {
      FeltFluid between;
      between.add(1 - blend_, felt);
      between.add(blend_, late);
      between.known = true;
      felt = between;
    } else if (late.known) {
      felt = late;
    }
  }
  return force_on(ball, felt, reader_.header().polydispersity, shapes_);
}

}  // namespace millfoam::dem_driver
