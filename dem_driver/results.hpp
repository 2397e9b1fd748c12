// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "dem_driver/case_folder.hpp"
#include "dem_driver/contact_results.hpp"
#include "dem_driver/dem_plan.hpp"
#include "dem_driver/fluid_ledger.hpp"
#include "dem_driver/liggghts_run.hpp"
#include "dem_driver/steady_state.hpp"
#include "meshing/mill/mill.hpp"

namespace millfoam::dem_driver {

/// The mill at one record.
struct HistoryRow {
  long step = 0;  ///< of the turning mill, from DEM time 0
  /// Of the charge on the walls that turn about +z, mean over the record's steps, N m.
  double torque = 0;
  double kinetic = 0;    ///< energy of translation, J
  double potential = 0;  ///< against the mill's axis, or a stirred mill's base, J
};

/// What LIGGGHTS has written of the turning mill, one row per record after the run's begin. Throws
/// std::runtime_error naming file and line where it cannot be read, and where a step has only its torque or
/// only its energies.
std::vector<HistoryRow> read_history(const CaseFolder& folder);

/// Torque of the charge on each wall of a stirred mill.
struct PartTorques {
  std::vector<std::string> parts;            ///< their names
  std::vector<std::vector<double>> torques;  ///< about +z, N m, of each part at each record
};

/// What LIGGGHTS has written of the parts' torques, a row for each record after step 0. Throws
/// std::runtime_error naming file and line where it cannot be read.
/// @param folder  of the case
/// @param parts  the walls in the order of the deck
PartTorques read_part_torques(const CaseFolder& folder, const std::vector<std::string>& parts);

/// All overlaps of one kind at the records at which they are counted.
struct OverlapStatistics {
  std::vector<double> counts;  ///< contacts in bins of equal width from 0 on
  double bin_width = 0;        ///< m
  double samples = 0;          ///< contacts, those beyond the last bin too
  double largest = 0;          ///< m
  /// Overlap that this share of all contacts stays below, m; within a bin's width.
  double percentile(double share) const;
};

/// Sums the histograms that LIGGGHTS has written, each for a part of the run. Throws std::runtime_error
/// naming file and line for one that cannot be read.
/// @param folder  of the case
/// @param kind  `ballOverlaps` for two balls, `wallOverlaps` for balls and walls
/// @param largest_diameter  of the balls, m; the deck's bins follow from it
OverlapStatistics read_overlaps(const CaseFolder& folder, const std::string& kind, double largest_diameter);

/// The results of a dry run.
struct Results {
  RunResult run;                           ///< what LIGGGHTS did
  long balls = 0;                          ///< put into the mill; `run.balls` are left at the end
  double resting_speed = 0;                ///< m/s, root mean square by mass of the charge at the run's begin
  std::vector<HistoryRow> history;         ///< one row for each record after the run's begin
  std::vector<FluidRow> fluid;             ///< one row for each of them, with a fluid
  std::vector<double> time;                ///< s, of each row
  double turn = 0;                         ///< of a stirred mill's impeller, in records; 0 of a tumbling mill
  std::vector<double> power;               ///< that the drive gives to the charge, W, of each row
  Steadiness power_steadiness;             ///< of `power`, W
  Steadiness kinetic_steadiness;           ///< of the energy of translation, J
  Steadiness potential_steadiness;         ///< of the potential energy, J
  OverlapStatistics ball_overlaps;         ///< of two balls
  OverlapStatistics wall_overlaps;         ///< of balls and walls
  std::optional<ContactResults> contacts;  ///< of a run that follows its contacts
  std::optional<PartTorques> part_torques;  ///< of a stirred mill
  bool steady() const;                      ///< whether power and both energies are
  double steady_from() const;               ///< s, the latest of the three
};

/// Reads what LIGGGHTS has written and judges it. Throws as read_history, read_overlaps and gather_contacts
/// do, and RunError when LIGGGHTS has not written a row of torque and energy for every record, or of what
/// else row_kinds has.
Results gather_results(const CaseFolder& folder, const meshing::Mill& mill, const DemPlan& plan,
                       const RunResult& run);

/// Writes `dumps/results.json`, `dumps/energy.csv`, of a stirred mill `dumps/torques.csv`,
/// `dumps/overlaps.csv`, `dumps/charge.csv` and, with a fluid, `dumps/fluid.csv`; with contacts also what
/// write_contact_files writes. Layout: FORMATS.md.
void write_results_files(const CaseFolder& folder, const meshing::Mill& mill, const DemPlan& plan,
                         const Results& results);

/// Prints the same in words.
void print_results(std::ostream& out, const DemPlan& plan, const Results& results);

}  // namespace millfoam::dem_driver
