// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <iosfwd>
#include <optional>
#include <string>

#include "dem_driver/case_folder.hpp"
#include "dem_driver/dem_plan.hpp"
#include "dem_driver/liggghts_log.hpp"

namespace millfoam::dem_driver {

/// What a dry run took.
struct RunResult {
  double wall_time = 0;   ///< s, of a resumed run with all earlier parts
  int ranks = 1;          ///< processes of LIGGGHTS, of a resumed run those of its last part
  double memory = 0;      ///< bytes, of its last part: ranks times the largest resident memory of a process
  long balls = 0;         ///< that LIGGGHTS counted at the end
  std::size_t dumps = 0;  ///< of balls, those of the earlier parts of a resumed run too
  std::string liggghts;   ///< its version
};

/// How progress is shown.
struct ProgressOutput {
  std::ostream& out;      ///< must outlive the run
  bool terminal = false;  ///< whether `out` is one, so that a line can be written over
};

/// Throws RunError that names the program and its package when one of those that a run needs is missing:
/// `millLiggghts` in the folder of this program, of superquadrics `millLiggghtsSuperquadric`, `setpriv` and,
/// for more than one rank, `mpirun` on PATH. The variable MILLFOAM_LIGGGHTS may name another program in the
/// place of millLiggghts, which takes its options.
void require_programs(const DemPlan& plan, int ranks);

/// Runs LIGGGHTS with `ranks` processes (mpirun for more than one) in DIR/dem, on `in.mill`, or on
/// `in.resume` when the run resumes from step `resumed_at`. Its output is appended to DIR/dem/log.liggghts.
/// Shows progress, and stops at the first sign of a useless run. Every dump and restart file is checked when
/// it is written (OutputCheck), and the last complete restart file is kept. Throws RunError as
/// require_programs does, when mpirun refuses so many ranks, when LIGGGHTS fails, loses balls or inserts
/// another number than asked, or when the number of dumps is not the plan's; the message has the log's name
/// and last lines, or mpirun's first ones.
RunResult run_liggghts(const CaseFolder& folder, const DemPlan& plan, int ranks, ProgressOutput progress,
                       std::optional<long> resumed_at = std::nullopt);

}  // namespace millfoam::dem_driver
