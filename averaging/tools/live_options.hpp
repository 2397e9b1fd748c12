// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "averaging/run/average_request.hpp"
#include "meshing/mill/mill_reader.hpp"

namespace millfoam::averaging {

/// Averages that a dry run makes while the mill turns.
struct LiveRequest {
  /// Without an end where the mill's windows are made: the run may be made longer.
  AverageRequest request;
  std::optional<double> end;  ///< DEM time at which the last whole window ends, s; nothing: the run's end
  bool steady = false;        ///< of all windows those since the charge is steady
  double tolerance = 1;       ///< largest share of the balls' volume that may be outside or clipped
};

/// The averages of a text of millAverage's options (cells, method, windows, tolerance and file); what these
/// leave open is that of the mill. Windows of a mill whose averages start `steady` begin with the run,
/// because the steady time is not known while the mill turns.
/// @param options  empty: the mill's averages
/// @param case_folder  has walls/, and gets solids.h5
/// @param begin  DEM time at which the run begins, s
/// @param duration  of the run, s
/// @param timestep  of the run, s
/// Throws std::invalid_argument naming the option, its value and what was expected, and WindowError.
LiveRequest live_request(const meshing::MillDescription& description, const std::string& options,
                         const std::string& case_folder, double begin, double duration, double timestep);

}  // namespace millfoam::averaging
