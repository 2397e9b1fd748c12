// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>

#include "averaging/files/slurry_reader.hpp"
#include "dem_driver/fluid_settings.hpp"
#include "dem_driver/voxel_field.hpp"

namespace millfoam::dem_driver {

/// A ball as the fluid sees it.
struct BallInFluid {
  Vector position = {};   ///< of its centre, lab frame, m
  Vector velocity = {};   ///< m/s
  double diameter = 0;    ///< of the sphere of equal volume, m
  double sphericity = 1;  ///< also crosswise, as orientations are random
  long long id = 0;       ///< for messages
  double volume() const;  ///< m^3
};

/// What the fluid does to a ball.
struct FluidForce {
  Vector pressure = {};  ///< of the pressure, buoyancy with it, N
  Vector drag = {};      ///< N
  Vector balance = {};   ///< of a TorqueBalance, N
  bool known = true;     ///< false: there is no field where the ball is, and all forces are 0
  Vector sum() const;    ///< of all, N
};

/// Torque of a force (N) on a ball about +z, N m.
double torque_about_z(const BallInFluid& ball, const Vector& force);

/// The force of a fluid on balls.
class FluidForces {
 public:
  virtual ~FluidForces() = default;
  /// Takes the fields of this DEM time, s, for all calls of `on` that follow.
  virtual void set_time(double time) = 0;
  /// The force on a ball.
  virtual FluidForce on(const BallInFluid& ball) const = 0;
};

/// Buoyancy in a pool at rest: the weight of the fluid in the place of the part of the sphere below the
/// pool's surface, upwards.
class PoolForces final : public FluidForces {
 public:
  /// @param level  height y of the surface, m
  /// @param density  of the fluid, kg/m^3
  PoolForces(double level, double density) : level_(level), density_(density) {}
  void set_time(double) override {}
  FluidForce on(const BallInFluid& ball) const override;

 private:
  double level_;
  double density_;
};

/// Share of a sphere's volume that lies below a level: a cap of height t has t^2 (3 R - t)/(4 R^3).
/// @param height  of its centre above the level, m
/// @param radius  of the sphere, m
double share_below(double height, double radius);

/// The force on a ball where it feels this: F = V (pressure_force + drag_force - K v). With polydispersity,
/// drag_force and K of a ball of diameter d are e/y + phi + 0.064 e y times those of the flow, y = d/d32, phi
/// the solidity, e = 1 - phi (R. Beetstra, M. A. van der Hoef & J. A. M. Kuipers, AIChE J. 53 (2007) 489).
/// With shapes, they are also multiplied by `ShapeDrag::factor` at the ball's own slip |drag_force/K - v|.
FluidForce force_on(const BallInFluid& ball, const FeltFluid& felt, bool polydispersity,
                    const ShapeDrag& shapes = {});

/// The forces of a flow, from slurry.h5, by `force_on` of a VoxelField.
///
/// Memory: the mean, or two windows, which are read when their time comes.
class VoxelForces final : public FluidForces {
 public:
  /// Throws averaging::SlurryFileError where the file cannot be read.
  VoxelForces(const std::filesystem::path& file, FluidTime time, ShapeDrag shapes = {});
  void set_time(double time) override;
  FluidForce on(const BallInFluid& ball) const override;

 private:
  VoxelField read(std::size_t window) const;

  averaging::SlurryReader reader_;
  FluidTime time_;
  ShapeDrag shapes_;
  std::optional<VoxelField> early_, late_;  ///< the mean, or the windows before and after the time
  std::size_t window_ = std::numeric_limits<std::size_t>::max();  ///< of early_
  double blend_ = 0;                                              ///< share of late_
};

/// What acts on the balls of a run with a fluid. Throws as VoxelForces, and where the flow's file is not the
/// one that was checked.
std::unique_ptr<FluidForces> make_fluid_forces(const FluidSettings& fluid);

/// The factor e/y + phi + 0.064 e y of a ball of diameter y d32 in a mixture of sizes of solidity phi.
double mixture_factor(double y, double solidity);

}  // namespace millfoam::dem_driver
