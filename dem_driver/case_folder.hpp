// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "dem_driver/deck.hpp"
#include "meshing/mill/mill.hpp"

namespace millfoam::dem_driver {

/// The folders and files of one case that the dry run reads and writes.
struct CaseFolder {
  std::filesystem::path root;
  std::filesystem::path walls() const { return root / "walls"; }
  std::filesystem::path dem() const { return root / "dem"; }
  std::filesystem::path dumps() const { return root / "dumps"; }
  std::filesystem::path contacts() const { return root / "contacts"; }
  std::filesystem::path deck() const { return dem() / "in.mill"; }
  std::filesystem::path log() const { return dem() / "log.liggghts"; }
  std::filesystem::path resume_deck() const { return dem() / "in.resume"; }
  std::filesystem::path plan_file() const { return dem() / "plan.json"; }
  std::filesystem::path lock() const { return dem() / "lock"; }
  std::filesystem::path run_file() const { return dumps() / "run.json"; }
  std::filesystem::path results() const { return dumps() / "results.json"; }
  std::filesystem::path energy() const { return dumps() / "energy.csv"; }
  std::filesystem::path overlaps() const { return dumps() / "overlaps.csv"; }
  std::filesystem::path charge() const { return dumps() / "charge.csv"; }
};

/// The wall parts of this mill: shell, lifters (if any), and for plain ends feedEnd and dischargeEnd, each of
/// which may be missing where the others close that end. Each file is read. Throws std::runtime_error naming
/// the first `walls/<part>.stl` that is missing, that read_wall refuses, or with which the walls are not
/// those of this mill (require_fit).
std::vector<std::string> find_walls(const CaseFolder& folder, const meshing::Mill& mill);

/// Every `dump.*.txt` in the dumps folder.
std::vector<std::filesystem::path> find_dumps(const CaseFolder& folder);

/// Lock of a folder for this process and the programs that it starts, so that no other run writes there.
/// Waits some seconds for programs that a killed run has left behind. Throws std::runtime_error when another
/// run has the lock.
class FolderLock {
 public:
  explicit FolderLock(const CaseFolder& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int file_ = -1;
};

/// Removes run file and results.
void remove_results(const CaseFolder& folder);

/// Makes the folders and removes dumps, contacts, run file, results, restart files and histories of an
/// earlier run, so that two runs never mix. Nothing else is removed. Returns the number of dumps removed.
std::size_t prepare_folders(const CaseFolder& folder);

/// One line of comment for each wall with a checksum (FNV-1a) of its file: a deck that has them belongs to
/// these walls only.
std::string wall_checksums(const CaseFolder& folder, const std::vector<std::string>& parts);

/// Writes `dumps/run.json`: time-step, interval of the dumps, speed, duration and mass of the charge. The
/// file appears whole or not at all.
void write_run_file(const CaseFolder& folder, const meshing::Mill& mill, const DemPlan& plan);

}  // namespace millfoam::dem_driver
