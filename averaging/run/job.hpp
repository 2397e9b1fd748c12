// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "averaging/dumps/dump_series.hpp"
#include "averaging/dumps/run_notes.hpp"
#include "averaging/run/average_run.hpp"
#include "averaging/run/cell_setup.hpp"
#include "averaging/run/record_blocks.hpp"
#include "averaging/statistics/time_windows.hpp"

namespace millfoam::averaging {

/// The dumps of a run and how they are cut.
struct Job {
  std::vector<DumpFile> dumps;
  std::optional<RunNotes> notes;
  RunSettings settings;
  std::vector<WindowPlan> plans;  ///< for each series of windows
  std::vector<RecordBlock> blocks;
};

/// Finds the dumps of a request and cuts them. Throws DumpError, WindowError.
Job prepare(const AverageRequest& request, const AverageProgress& progress);

/// Throws std::invalid_argument when the grid cannot be meant for the balls. A first record that does not fit
/// is forgiven where the last one does: the charge may be filled in during the run.
void require_fitting_grid(const AverageRequest& request, const Job& job, const CellSetup& setup);

}  // namespace millfoam::averaging
