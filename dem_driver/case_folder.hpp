// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <filesystem>
#include <vector>

#include "averaging/files/file_lock.hpp"

namespace millfoam::dem_driver {

/// The folders and files of one case that the dry run reads and writes. The functions only make the paths;
/// nothing has to exist. Layouts of the files: FORMATS.md.
struct CaseFolder {
  std::filesystem::path root;  ///< the folder of the case, absolute or relative to where the program runs
  /// STL files of the walls, one for each part.
  std::filesystem::path walls() const { return root / "walls"; }
  /// Where LIGGGHTS runs: decks, log, restart files and segments.
  std::filesystem::path dem() const { return root / "dem"; }
  /// Dumps of the balls, and the results.
  std::filesystem::path dumps() const { return root / "dumps"; }
  /// Dumps of the contacts; only with dem.contact_interval.
  std::filesystem::path contacts() const { return root / "contacts"; }
  /// Input of LIGGGHTS for a run from the start.
  std::filesystem::path deck() const { return dem() / "in.mill"; }
  /// What LIGGGHTS printed, of a resumed run after that of the earlier parts.
  std::filesystem::path log() const { return dem() / "log.liggghts"; }
  /// Input of LIGGGHTS for a run from a restart file.
  std::filesystem::path resume_deck() const { return dem() / "in.resume"; }
  /// What millLiggghts needs for a fluid besides the deck; only with one.
  std::filesystem::path fluid_order() const { return dem() / "fluid.json"; }
  /// What millLiggghts needs for statistics of the contacts besides the deck; only with them.
  std::filesystem::path contact_order() const { return dem() / "contacts.json"; }
  /// What millLiggghts needs for averages of the run besides the deck; only with them.
  std::filesystem::path averages_order() const { return dem() / "averages.json"; }
  /// Time-step, steps and charge before the run.
  std::filesystem::path plan_file() const { return dem() / "plan.json"; }
  /// Held by lock_folder.
  std::filesystem::path lock() const { return dem() / "lock"; }
  /// Time-step, interval and speed of the dumps; there only after a complete run.
  std::filesystem::path run_file() const { return dumps() / "run.json"; }
  /// Summary: power, energies, overlaps, cost.
  std::filesystem::path results() const { return dumps() / "results.json"; }
  /// Torque, power, energies and largest overlap, a row for each record.
  std::filesystem::path energy() const { return dumps() / "energy.csv"; }
  /// Torque on each wall of a stirred mill.
  std::filesystem::path torques() const { return dumps() / "torques.csv"; }
  /// What the fluid did to the balls, a row for each record; only with one.
  std::filesystem::path fluid() const { return dumps() / "fluid.csv"; }
  /// Power that the contacts dissipate, by their kinds; only with their statistics.
  std::filesystem::path contact_power() const { return dumps() / "contact_power.csv"; }
  /// Collisions over their energy; only with their statistics.
  std::filesystem::path contact_spectra() const { return dumps() / "contact_spectra.csv"; }
  /// Force and work on the cells of the walls; only with statistics of the contacts.
  std::filesystem::path wall_forces() const { return dumps() / "wall_forces.vtp"; }
  /// Histograms of the overlaps.
  std::filesystem::path overlaps() const { return dumps() / "overlaps.csv"; }
  /// Books of the charge, a row for each size class.
  std::filesystem::path charge() const { return dumps() / "charge.csv"; }
};

/// Every `dump.*.txt` in the dumps folder, in no order; none without that folder.
std::vector<std::filesystem::path> find_dumps(const CaseFolder& folder);

/// Removes `run.json`, `results.json` and the tables in their folder, so that a failed run leaves no results
/// of an earlier run.
void remove_results(const CaseFolder& folder);

/// Locks a folder for this process and the programs that it starts, so that no other run writes there: the
/// lock ends with the last of these programs, however they end.
/// @param folder  of the case; its file `dem/lock` is made where it is missing, the folder `dem` must exist
/// @param longest_wait  for programs that a killed run has left behind
///
/// Throws std::runtime_error when another run keeps the lock, or when the file cannot be written.
averaging::FileLock lock_folder(const CaseFolder& folder,
                                std::chrono::milliseconds longest_wait = std::chrono::seconds(10));

}  // namespace millfoam::dem_driver
