// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "averaging/grids/box_grid.hpp"
#include "averaging/files/solids_file.hpp"

namespace millfoam::averaging {

/// Everything that `millAverage` is told.
struct AverageRequest {
  std::string dumps;               ///< pattern of the dumps' names, see `find_dumps`
  std::optional<double> timestep;  ///< of the DEM run, s; unless given, out of run.txt beside the dumps
  BoxGrid grid;
  std::optional<double> window;  ///< length, s; unless given, one window over the whole run
  std::optional<double> start;   ///< DEM time, s
  std::optional<double> end;     ///< DEM time, s
  int template_points = 12;      ///< along a sphere's diameter
  std::filesystem::path output;
};

/// What was averaged, for the report.
struct AverageSummary {
  std::size_t dumps = 0;  ///< records used
  std::vector<TimeWindow> windows;
  std::vector<Ledger> ledgers;   ///< per window
  double occupied_solidity = 0;  ///< mean solidity over voxels and windows where it is not 0
  double largest_solidity = 0;   ///< of any voxel in any window
  double balls_per_occupied_voxel =
      0;  ///< mean over the records of balls deposited / voxels that hold some of them
};

/// What happens on the way.
struct AverageProgress {
  std::function<void(std::size_t done, std::size_t of)> records;  ///< after each record
  std::function<void(const std::string& sentence)> note;          ///< records left out, windows not full
};

/// Averages dumps into a solids file and its .xdmf. Holds one record and one window in memory.
/// Throws DumpError, WindowError, SolidsFileError or std::invalid_argument.
AverageSummary average_run(const AverageRequest& request, const AverageProgress& progress);

/// The ledger and the summary as a table, ending with advice where the numbers call for it.
std::string report(const AverageSummary& summary);

}  // namespace millfoam::averaging
