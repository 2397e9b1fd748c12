// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <stdexcept>
#include <string>

#include "averaging/dumps/dump_header.hpp"
#include "averaging/run/average_request.hpp"
#include "averaging/statistics/time_windows.hpp"
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

/// The box in which the balls of a mill's dry run repeat, as its dumps would name it.
DumpBox box_of_run(const meshing::Mill& mill);

/// Does something for averages of these options. What it throws, std::invalid_argument, WindowError or
/// another one as std::runtime_error, begins with them.
/// @param options  text of millDem's --average; empty: the mill's averages, of which nothing is named
/// @param action  without arguments
template <typename Action>
auto naming_options(const std::string& options, Action&& action) {
  if (options.empty()) return action();
  const std::string begin = "--average '" + options + "': ";
  try {
    return action();
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(begin + error.what());
  } catch (const WindowError& error) {
    throw WindowError(begin + error.what());
  } catch (const std::exception& error) {
    throw std::runtime_error(begin + error.what());
  }
}

/// The averages of a text of millAverage's options (cells, method, windows, tolerance and file); what these
/// leave open is that of the mill: of windows, their length. With a window, start or end of their own they
/// begin and end with the run where the options give no start and no end. Windows of a mill whose averages
/// start `steady` begin with the run, because the steady time is not known while the mill turns.
/// @param options  empty: the mill's averages
/// @param case_folder  has walls/, and gets solids.h5
/// @param begin  DEM time at which the run begins, s
/// @param duration  of the run, s
/// @param timestep  of the run, s
/// Throws std::invalid_argument naming the option, its value and what was expected, also for cells that
/// repeat as the balls do not, WindowError, and as naming_options.
LiveRequest live_request(const meshing::MillDescription& description, const std::string& options,
                         const std::string& case_folder, double begin, double duration, double timestep);

}  // namespace millfoam::averaging
