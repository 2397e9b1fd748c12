// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "averaging/tools/options.hpp"
#include "meshing/mill/mill_reader.hpp"

namespace millfoam::averaging {

/// Fills what the options leave open from the section `averages` of a mill and the layout of its case's
/// folder: dumps, walls, grid, method, windows, start and output. A start `steady` is `steady_from_s` of
/// `dumps/results.json`; windows that the dumps do not fill are left out. Returns the fingerprint of the
/// mill's averages, or an empty text where the options request others. With the mill's grid the method is its
/// own too.
///
/// Throws MillError, and std::invalid_argument for dumps of another mill, or where no window is left.
std::string take_from_mill(const meshing::MillDescription& description, Options& options);

/// Fills grid, periods, walls and method from the section `averages` of a mill; the grid of the options must
/// be empty.
void take_grid(const meshing::Mill& mill, Options& options);

/// DEM time at which the last whole window of a dry run ends, s. Throws std::invalid_argument where there is
/// none.
/// @param start  of the first window, s
/// @param end  of the dry run, s
/// @param duration  of the dry run, s, for the message
/// @param window  length of the windows, s
double last_whole_window(double start, double end, double duration, double window);

}  // namespace millfoam::averaging
