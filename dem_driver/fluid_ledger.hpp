// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <fstream>
#include <string>
#include <vector>

#include "dem_driver/case_folder.hpp"
#include "dem_driver/fluid_forces.hpp"

namespace millfoam::dem_driver {

/// Sums over balls and steps of what the fluid did: numbers that add up over ranks.
struct FluidSums {
  /// Pressure x y z and drag x y z, N; power, W; torque about z, N m, and its part by TorqueBalance; balls
  /// without field.
  std::array<double, 10> values = {};
  /// Adds a ball of one step.
  void add(const BallInFluid& ball, const FluidForce& force);
};

/// Writes what the fluid did to all balls, a line for each record: the step, then the means over the record's
/// steps of FluidSums' values. Each line is on the disk before the call returns.
class FluidLedgerFile {
 public:
  /// Begins the file. Throws std::runtime_error naming it.
  explicit FluidLedgerFile(const std::filesystem::path& file);
  /// Writes the record that ends with `step` and had so many steps. Throws as above.
  void write(long step, const FluidSums& sums, long steps);

 private:
  std::filesystem::path name_;
  std::ofstream out_;
};

/// The fluid at one record: means over the record's steps of sums over all balls.
struct FluidRow {
  long step = 0;             ///< at the record's end
  Vector pressure = {};      ///< N
  Vector drag = {};          ///< N
  double power = 0;          ///< on the balls, W
  double torque = 0;         ///< about +z, N m
  double balance = 0;        ///< part of the torque that is by TorqueBalance, N m
  double without_field = 0;  ///< balls, mean number
};

/// The ledger of all segments of a run, after the step at which it began. Throws std::runtime_error naming
/// file and line where it cannot be read.
std::vector<FluidRow> read_fluid_ledger(const CaseFolder& folder);

}  // namespace millfoam::dem_driver
