// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "averaging/dumps/dump_header.hpp"
#include "averaging/dumps/dump_series.hpp"
#include "averaging/dumps/run_metadata.hpp"
#include "averaging/run/average_progress.hpp"
#include "averaging/run/average_request.hpp"
#include "averaging/run/cell_setup.hpp"
#include "averaging/run/record_blocks.hpp"
#include "averaging/statistics/time_windows.hpp"

namespace millfoam::averaging {

/// The dumps of a run and how they are cut into windows and blocks.
struct RunPlan {
  std::vector<DumpFile> dumps;          ///< in order of time
  std::optional<RunMetadata> metadata;  ///< of run.json, if it is in the folder of the dumps
  RunSettings settings;                 ///< what request and metadata agree on
  std::vector<WindowPlan> series;       ///< windows of each length
  std::vector<RecordBlock> blocks;      ///< of all of them, in order of time
  std::optional<DumpBox> box;           ///< of the first dump that is averaged
};

/// Finds the dumps of a request, compares them with each other and with its period, and cuts them. Throws
/// DumpError, WindowError, and std::invalid_argument as `require_period_of`.
RunPlan plan_run(const AverageRequest& request, const AverageProgress& progress);

/// Throws std::out_of_range, naming the dump and the file, where cells that move are not known at the first
/// or the last record: a table of a motion, or a mesh of several times, may be of a part of the run alone.
void require_cells(const RunPlan& plan, const CellSetup& setup);

/// Throws std::invalid_argument when the grid cannot be meant for the balls. A first record that does not fit
/// is forgiven where the last one does: the charge may be filled in during the run.
void require_fitting_grid(const AverageRequest& request, const RunPlan& plan, const CellSetup& setup);

}  // namespace millfoam::averaging
