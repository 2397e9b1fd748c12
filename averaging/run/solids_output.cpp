// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/run/solids_output.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <variant>

#include "averaging/files/solids_file.hpp"
#include "averaging/files/xdmf.hpp"
#include "averaging/run/summary_file.hpp"

namespace millfoam::averaging {

namespace {

namespace fs = std::filesystem;

/// The header of a solids file; an empty one where it cannot be read.
SolidsHeader header_in(const fs::path& file) {
  try {
    return SolidsReader(file).header();
  } catch (const SolidsFileError&) {
    return {};
  }
}

bool is_equal(double one, double other) {
  return std::abs(one - other) <= 1e-9 * std::max(std::abs(one), std::abs(other));
}

bool is_equal(const std::optional<double>& one, const std::optional<double>& other) {
  return one && other ? is_equal(*one, *other) : one.has_value() == other.has_value();
}

template <typename Numbers>
bool are_equal(const Numbers& some, const Numbers& others) {
  return std::equal(some.begin(), some.end(), others.begin(), others.end(),
                    [](double one, double other) { return is_equal(one, other); });
}

bool is_equal(const BoxGrid& one, const BoxGrid& other) {
  return one.shape() == other.shape() && one.periodic() == other.periodic() &&
         are_equal(one.lower(), other.lower()) && are_equal(one.upper(), other.upper());
}

bool is_equal(const CylinderGrid& one, const CylinderGrid& other) {
  return one.shape() == other.shape() && one.periodic_z() == other.periodic_z() &&
         one.frame().cylindrical == other.frame().cylindrical &&
         is_equal(one.frame().angular_velocity, other.frame().angular_velocity) &&
         are_equal(one.radii(), other.radii()) && are_equal(one.ends(), other.ends());
}

bool is_equal(const MeshCells& one, const MeshCells& other) {
  return one.file == other.file && one.motion == other.motion && is_equal(one.time, other.time) &&
         are_equal(one.volumes, other.volumes);
}

bool is_equal(const Grid& one, const Grid& other) {
  if (one.index() != other.index()) return false;
  return std::visit(
      [&](const auto& grid) { return is_equal(grid, std::get<std::decay_t<decltype(grid)>>(other)); }, one);
}

bool is_equal(const SolidsHeader& one, const SolidsHeader& other) {
  return one.mill_averages == other.mill_averages && one.method == other.method &&
         one.whole_run == other.whole_run && one.inside_fractions == other.inside_fractions &&
         is_equal(one.time0, other.time0) && is_equal(one.timestep, other.timestep) &&
         is_equal(one.smoothing, other.smoothing) && is_equal(one.solidity_cap, other.solidity_cap) &&
         is_equal(one.angular_velocity, other.angular_velocity) &&
         is_equal(one.walls_over_grid, other.walls_over_grid);
}

bool is_equal(const TimeWindow& one, const TimeWindow& other) {
  return one.records == other.records && is_equal(one.begin, other.begin) && is_equal(one.end, other.end);
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
    if (!is_newer(windows.output) || !is_newer(xdmf_path(windows.output)) || !is_newer(summary)) return false;
    const SolidsHeader header = header_in(windows.output);
    return header.run_id == run.run_id && header.mill_averages == request.mill_averages &&
           run_of_summary(summary) == run.run_id;
  });
}

bool holds_averages(const fs::path& file, const SolidsHeader& header, const Grid& grid,
                    const std::vector<TimeWindow>& windows) {
  const SolidsReader solids(file);
  const std::vector<TimeWindow>& found = solids.windows();
  return is_equal(solids.header(), header) && is_equal(solids.grid(), grid) &&
         std::equal(found.begin(), found.end(), windows.begin(), windows.end(),
                    [](const TimeWindow& one, const TimeWindow& other) { return is_equal(one, other); });
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
