// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "averaging/deposition/deposition.hpp"

namespace millfoam::averaging {

/// Deposits in the voxels of a cylinder whose velocities are along r, theta and z, and which may turn: balls
/// are turned back by the cylinder's angle at the record's time, and deposited by another method where they
/// are then. Velocities are those of the lab, which that turn does not change along r, theta and z.
class CylindricalDeposition : public Deposition {
 public:
  /// @param cylinder  deposits in the cylinder at rest
  /// @param angular_velocity  of the cylinder about z, rad/s; it is in its place at DEM time 0
  CylindricalDeposition(std::unique_ptr<Deposition> cylinder, double angular_velocity);

  std::unique_ptr<Deposition> clone() const override;
  void begin_record(double time) override;
  const std::vector<double>& volumes() const override { return cylinder_->volumes(); }
  void deposit(const Particle& sphere, std::vector<Deposit>& deposits) override;
  void deposit(const Particle& particle, const Superquadric& shape, std::vector<Deposit>& deposits) override;

  /// Along r, theta and z at the ball's centre.
  Vector3 field_velocity(const Particle& particle) const override;

 private:
  Particle turned_back(const Particle& particle) const;

  std::unique_ptr<Deposition> cylinder_;
  double angular_velocity_;
  double angle_ = 0;  ///< of the cylinder at the record's time, rad
};

}  // namespace millfoam::averaging
