// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "dem_driver/deck.hpp"
#include "meshing/mill.hpp"

namespace millfoam::dem_driver {

/// The folders and files of one case that the dry run reads and writes.
struct CaseFolder {
  std::filesystem::path root;
  std::filesystem::path walls() const { return root / "walls"; }
  std::filesystem::path dem() const { return root / "dem"; }
  std::filesystem::path dumps() const { return root / "dumps"; }
  std::filesystem::path deck() const { return dem() / "in.mill"; }
  std::filesystem::path log() const { return dem() / "log.liggghts"; }
  std::filesystem::path run_file() const { return dumps() / "run.txt"; }
};

/// The wall parts of this mill: shell, lifters (if any), and for plain ends feedEnd and dischargeEnd.
/// Throws std::runtime_error naming the first `walls/<part>.stl` that does not exist.
std::vector<std::string> find_walls(const CaseFolder& folder, const meshing::Mill& mill);

/// Every `dump.*.txt` in the dumps folder.
std::vector<std::filesystem::path> find_dumps(const CaseFolder& folder);

/// Makes the folders and removes dumps and run file of an earlier run, so that two runs never mix. Nothing
/// else is removed. Returns the number of dumps removed.
std::size_t prepare_folders(const CaseFolder& folder);

/// Writes `dumps/run.txt`, lines `key value`: timestep (s), interval (steps between dumps), angular_velocity
/// (rad/s). The file appears whole or not at all.
void write_run_file(const CaseFolder& folder, const meshing::Mill& mill, const DemPlan& plan);

}  // namespace millfoam::dem_driver
