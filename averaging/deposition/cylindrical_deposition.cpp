// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/deposition/cylindrical_deposition.hpp"

#include <cmath>
#include <utility>

#include "averaging/grids/cylindrical.hpp"

namespace millfoam::averaging {

namespace {

/// The quaternion of a body that is turned about z by an angle, rad: the product of that turn and `of`.
std::array<double, 4> turned_body(const std::array<double, 4>& of, double angle) {
  const double w = std::cos(angle / 2), z = std::sin(angle / 2);
  return {w * of[0] - z * of[3], w * of[1] - z * of[2], w * of[2] + z * of[1], w * of[3] + z * of[0]};
}

}  // namespace

CylindricalDeposition::CylindricalDeposition(std::unique_ptr<Deposition> cylinder, double angular_velocity)
    : cylinder_(std::move(cylinder)), angular_velocity_(angular_velocity) {}

std::unique_ptr<Deposition> CylindricalDeposition::clone() const {
  auto copy = std::make_unique<CylindricalDeposition>(cylinder_->clone(), angular_velocity_);
  copy->angle_ = angle_;
  return copy;
}

void CylindricalDeposition::begin_record(double time) {
  cylinder_->begin_record(time);
  angle_ = angular_velocity_ * time;
}

Particle CylindricalDeposition::turned_back(const Particle& particle) const {
  Particle result = particle;
  if (angle_ != 0) result.position = turned(particle.position, -angle_);
  return result;
}

void CylindricalDeposition::deposit(const Particle& sphere, std::vector<Deposit>& deposits) {
  cylinder_->deposit(turned_back(sphere), deposits);
}

void CylindricalDeposition::deposit(const Particle& particle, const Superquadric& shape,
                                    std::vector<Deposit>& deposits) {
  Superquadric body = shape;
  body.quaternion = turned_body(shape.quaternion, -angle_);
  cylinder_->deposit(turned_back(particle), body, deposits);
}

Vector3 CylindricalDeposition::field_velocity(const Particle& particle) const {
  return to_cylindrical(particle.velocity, particle.position);
}

}  // namespace millfoam::averaging
