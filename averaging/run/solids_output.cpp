// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/run/solids_output.hpp"

#include <algorithm>

#include "averaging/files/solids_file.hpp"
#include "averaging/files/xdmf.hpp"
#include "averaging/run/summary_file.hpp"

namespace millfoam::averaging {

namespace {

namespace fs = std::filesystem;

/// The run of which a solids file is; empty where there is no such file.
std::string run_of_solids(const fs::path& file) {
  try {
    return SolidsReader(file).header().run_id;
  } catch (const SolidsFileError&) {
    return {};
  }
}

}  // namespace

std::vector<FileLock> lock_outputs(const AverageRequest& request) {
  std::vector<FileLock> locks;
  for (const WindowsRequest& windows : request.windows) {
    require_solids_or_nothing(windows.output);
    require_summary_or_nothing(summary_path(windows.output));
    require_xdmf_or_nothing(xdmf_path(windows.output));
    locks.push_back(lock_output(windows.output));
  }
  return locks;
}

SolidsHeader solids_header(const AverageRequest& request, const WindowsRequest& windows,
                           const RunSettings& settings, const CellSetup& setup,
                           const std::optional<RunMetadata>& metadata, double time0,
                           const std::string& program) {
  SolidsHeader header;
  header.time0 = time0;
  header.timestep = settings.timestep;
  header.whole_run = !windows.length;
  header.method = setup.method;
  header.angular_velocity = settings.angular_velocity;
  header.smoothing = setup.smoothing;
  header.solidity_cap = request.solidity_cap;
  header.inside_fractions = !setup.limits.whole_volumes.empty();
  header.walls_over_grid = setup.walls_over_grid;
  header.program = program;
  header.mill_averages = request.mill_averages;
  if (metadata) {
    header.mill_charge = metadata->mill_charge;
    header.run_id = metadata->run_id;
    header.fines_share = metadata->fines_share;
  }
  return header;
}

bool are_written(const AverageRequest& request, const RunMetadata& run) {
  const auto is_newer = [&](const fs::path& file) {
    return fs::exists(file) && fs::last_write_time(file) >= fs::last_write_time(run.file);
  };
  return std::all_of(request.windows.begin(), request.windows.end(), [&](const WindowsRequest& windows) {
    const fs::path summary = summary_path(windows.output);
    return is_newer(windows.output) && run_of_solids(windows.output) == run.run_id &&
           is_newer(xdmf_path(windows.output)) && is_newer(summary) && run_of_summary(summary) == run.run_id;
  });
}

SolidsSummary write_solids(const std::filesystem::path& output, const Grid& grid, const SolidsHeader& header,
                           std::size_t windows, const std::function<WindowAverage(std::size_t)>& window) {
  SolidsSummary summary = begin_summary(output, header, grid);
  SolidsWriter writer(output, grid, header);
  for (std::size_t w = 0; w < windows; ++w) {
    const WindowAverage average = window(w);
    writer.append(average);
    summary.windows.push_back(
        summarise(grid, average.time, average.ledger, average.balls_per_cell, average.mean));
  }
  writer.finish();
  write_xdmf(output);
  write_summary(summary_path(output), summary, header.program);
  return summary;
}

}  // namespace millfoam::averaging
