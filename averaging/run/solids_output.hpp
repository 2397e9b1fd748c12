// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "averaging/dumps/run_metadata.hpp"
#include "averaging/files/output_lock.hpp"
#include "averaging/run/average_request.hpp"
#include "averaging/run/cell_setup.hpp"
#include "averaging/run/solids_summary.hpp"

namespace millfoam::averaging {

/// Checks that every file that a request is to write may be written, and locks them. Throws SolidsFileError,
/// and std::runtime_error where a lock's file cannot be written.
std::vector<FileLock> lock_outputs(const AverageRequest& request);

/// What holds for a whole solids file.
/// @param request  of the averages
/// @param windows  of the request: the file's
/// @param settings  of the DEM run
/// @param setup  of the cells
/// @param metadata  of run.json, if it is there
/// @param time0  DEM time at which its first window begins, s
/// @param program  that writes it, with its version
SolidsHeader solids_header(const AverageRequest& request, const WindowsRequest& windows,
                           const RunSettings& settings, const CellSetup& setup,
                           const std::optional<RunMetadata>& metadata, double time0,
                           const std::string& program);

/// Whether all files that a request asks of a run are there (solids files, their .xdmf and their summaries),
/// each written after the run was complete, and none with another fingerprint of the mill's averages than the
/// request. Runs of equal plans have one id, so that this alone does not tell.
/// @param request  of the averages
/// @param run  of run.json
bool are_written(const AverageRequest& request, const RunMetadata& run);

/// Whether a solids file holds averages of these settings on these cells in these windows. Numbers may differ
/// by 1e-9 of their size. The program that wrote the file, and what it holds of the dry run, are not
/// compared. Throws SolidsFileError where it cannot be read.
/// @param file  the solids file
/// @param header  that the averages would have
/// @param grid  of their cells
/// @param windows  begins, ends and records of their windows
bool holds_averages(const std::filesystem::path& file, const SolidsHeader& header, const Grid& grid,
                    const std::vector<TimeWindow>& windows);

/// Writes a solids file, its .xdmf and its summary in JSON, which it returns. Throws SolidsFileError.
/// @param output  the solids file
/// @param grid  of the cells
/// @param header  of the file
/// @param windows  their number, at least one
/// @param window  reads each of them, from 0
SolidsSummary write_solids(const std::filesystem::path& output, const Grid& grid, const SolidsHeader& header,
                           std::size_t windows, const std::function<WindowAverage(std::size_t)>& window);

}  // namespace millfoam::averaging
