// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "dem_driver/case_folder.hpp"
#include "dem_driver/dem_plan.hpp"
#include "meshing/mill/mill.hpp"

namespace millfoam::dem_driver {

/// Writes `dumps/run.json`: time-step, interval and number of the dumps, speed, begin, duration, mass of the
/// charge, fluid, and `walls`, which are wall_fingerprints at the run's begin and are left out where empty.
/// The file appears whole or not at all.
void write_run_file(const CaseFolder& folder, const meshing::Mill& mill, const DemPlan& plan,
                    const std::map<std::string, std::string>& walls = {});

/// What a `run.json` says of its complete run.
struct CompleteRun {
  std::string charge;    ///< fingerprint of the mill's charge
  double time_step = 0;  ///< s
  long end_step = 0;     ///< last step of the turning mill
};

/// Reads a `run.json`. Throws std::runtime_error naming the file, what was found and what was expected.
CompleteRun read_run_file(const std::filesystem::path& file);

}  // namespace millfoam::dem_driver
