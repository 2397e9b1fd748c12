// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <iosfwd>

#include "dem_driver/case_folder.hpp"
#include "dem_driver/deck.hpp"
#include "dem_driver/liggghts_log.hpp"

namespace millfoam::dem_driver {

/// What a dry run was.
struct RunResult {
  double wall_time = 0;        ///< s
  double resting_speed = 0;    ///< m/s, root mean square by mass of the charge at DEM time 0
  double largest_overlap = 0;  ///< m, of two balls, sampled at the log's lines
  std::size_t dumps = 0;
};

/// How progress is shown.
struct ProgressOutput {
  std::ostream& out;
  bool terminal = false;
};

/// Runs LIGGGHTS on the deck of `folder` with `ranks` processes (mpirun for more than one) in DIR/dem;
/// everything it prints goes to DIR/dem/log.liggghts. Shows progress and stops at the first sign of a useless
/// run. Throws RunError when `liggghts` (or `mpirun`) is not on PATH, when LIGGGHTS fails, loses balls or
/// inserts another number than asked, or when the number of dumps is not the plan's; the message has the
/// log's name and last lines.
RunResult run_liggghts(const CaseFolder& folder, const DemPlan& plan, int ranks, ProgressOutput progress);

/// Prints balls, steps, speed of the computation, overlap and dumps.
void print_result(std::ostream& out, const DemPlan& plan, const RunResult& result);

}  // namespace millfoam::dem_driver
