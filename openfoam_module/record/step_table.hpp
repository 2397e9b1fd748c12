// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <filesystem>
#include <fstream>
#include <optional>

namespace millfoam::record {

/// What is known of one time-step of a flow, at its end. Shares are 0 to 1. Empty: not known in this step,
/// or not in this flow.
struct StepRow {
  double time = 0;                 ///< flow time at the end of the step, s
  double delta_t = 0;              ///< its length, s
  double courant = 0;              ///< largest Courant number of cells with slurry
  double surface_courant = 0;      ///< the same of cells that the slurry's surface cuts
  double air_courant = 0;          ///< the same of cells with air alone
  double voidage_change = 0;       ///< largest share by which the voidage of a cell changed
  double pressure_iterations = 0;  ///< of the linear solver for p_rgh, all its solutions together
  double pressure_residual = 0;    ///< after the last of them, normalised as OpenFOAM does
  double slurry = 0;               ///< volume of slurry in the mesh, m^3
  double fluid = 0;                ///< of slurry and air, m^3
  double alpha_min = 0;            ///< smallest share of slurry in the fluid
  double alpha_above = 0;          ///< largest share of slurry less 1
  double without_room = 0;         ///< fluid that a closed mill had no room for, all steps together, m^3
  std::optional<double> solids;    ///< volume of the balls in the mesh, m^3
  std::optional<double> volume_correction;  ///< share by which their volume was corrected to the ledger's
  std::optional<double> solids_moved;       ///< balls moved out of cells at the largest solidity, m^3
  std::optional<double> largest_reynolds;   ///< largest particle Reynolds number in slurry
  std::optional<double> beyond_law;         ///< share of the slurry in the bed that is beyond the law's range
  std::optional<double> solidity_below;     ///< by the bound: solidity below the law's smallest
  std::optional<double> solidity_above;     ///< above its largest
  std::optional<double> reynolds_below;     ///< Reynolds number below its smallest
  std::optional<double> reynolds_above;     ///< above its largest
  std::optional<double> force_mean;  ///< of the fluid on the balls over their weight, mean over the balls
  std::optional<double> force_95;    ///< what 95 % of the balls stay below
  std::optional<std::array<double, 3>> given_force;  ///< on all balls that feel the flow in its next step, N
  std::optional<double> given_torque;                ///< of this force about +z, N m
  std::optional<double> continuity_residual;         ///< rms of d(phi)/dt + div(phi u_s) over the solids, 1/s
  std::optional<double>
      continuity_speed;        ///< rms of the flow that it drives, over the slurry between balls, m/s
  std::optional<double> slip;  ///< rms of the slip between slurry and balls, over the same, m/s
  double wall = 0;             ///< wall time since the run began, s
};

/// A column of steps.csv.
struct StepColumn {
  const char* name;                                ///< with its unit
  std::optional<double> (*value)(const StepRow&);  ///< what it has of a step; nothing is written as nan
};

/// All columns, in their order.
extern const std::array<StepColumn, 32> step_columns;

/// steps.csv: one row per time-step, each handed to the operating system at once. What is not known is `nan`.
class StepTable {
 public:
  /// Begins a new file. Throws std::runtime_error when it cannot be written.
  explicit StepTable(const std::filesystem::path& path);

  /// Appends a row. Throws std::runtime_error when it cannot be written (a full disk).
  void add(const StepRow& row);

 private:
  std::filesystem::path path_;
  std::ofstream out_;
};

}  // namespace millfoam::record
