// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "dem_driver/case_folder.hpp"
#include "dem_driver/dem_plan.hpp"
#include "meshing/mill/mill.hpp"

namespace millfoam::dem_driver {

/// The last state of a complete run, from which a run in another folder continues.
struct LastState {
  std::filesystem::path restart;  ///< restart file of `step`, with its folder
  long step = 0;                  ///< of the turning mill, its last
  std::string id;                 ///< hash of the file's bytes (FNV-1a, 16 hexadecimal digits)
};

/// The last state of the run in `other`. Throws std::runtime_error that names the file, what was found and
/// what was expected, when that run is not complete, is that of another charge or time-step, has other walls
/// than `folder`, or has lost its last restart file; or when both folders are the same.
/// @param other  case folder of the complete run
/// @param folder  of the run that continues
/// @param parts  its walls
/// @param mill  of the run that continues
/// @param plan  of the run that continues
LastState last_state(const CaseFolder& other, const CaseFolder& folder, const std::vector<std::string>& parts,
                     const meshing::Mill& mill, const DemPlan& plan);

/// Puts the restart file into `dem`, as the one of the run's first step. Throws std::runtime_error naming it.
void take_restart(const LastState& state, const CaseFolder& folder);

}  // namespace millfoam::dem_driver
