// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "averaging/run/average_progress.hpp"
#include "averaging/run/average_request.hpp"
#include "averaging/run/communicator.hpp"
#include "averaging/run/solids_summary.hpp"

/// The balls of a DEM run as fields on a grid or on a mesh's cells: their volume is deposited in cells,
/// summed over records and averaged over windows of time. Units are SI. Fields are flat lists, [cells] or
/// [cells][components], the cell varying slowest; a grid's cells are in its own order.
namespace millfoam::averaging {

/// Averages dumps into a solids file, its .xdmf and its summary in JSON for each series of windows, and
/// returns these summaries (none on ranks other than the first). Holds one record and the moments of one run
/// of records for each thread, and the windows under way.
///
/// A run that was killed resumes. For this, the finished windows of each output (`.journal`) and a checkpoint
/// (`.resume`, of the first output) are kept in the outputs' folder until the run is finished. The results do
/// not depend on the numbers of threads and ranks, nor on resumed runs.
///
/// Before anything is written it refuses outputs whose names belong to files of other kinds or that another
/// process is writing, and a grid that cannot be meant for the balls (`largest_outside`, `smallest_fill`).
///
/// Throws DumpError, WindowError, SolidsFileError, MeshFileError or std::invalid_argument.
std::vector<SolidsSummary> average_run(const AverageRequest& request, const AverageProgress& progress,
                                       Communicator& communicator);

}  // namespace millfoam::averaging
