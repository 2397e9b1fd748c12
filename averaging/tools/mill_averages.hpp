// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "averaging/tools/options.hpp"
#include "meshing/mill/mill_reader.hpp"

namespace millfoam::averaging {

/// Fills what the options leave open from the section `averages` of a mill and the layout of its case's
/// folder: dumps, walls, grid, method, windows, start and output. A start `steady` is `steady_from_s` of
/// `dumps/results.json`; windows that the dry run does not fill are left out. Of dumps in another folder,
/// given windows are taken as they are. With the windows of the mill, all dumps of the run are expected. The
/// walls must be those of the dry run (`wall_files` of its `run.json`). Returns the fingerprint of the mill's
/// averages, or an empty text where the options request others.
///
/// Throws MillError, and std::invalid_argument for dumps or walls of another mill, where no window is left,
/// and as take_grid.
std::string take_from_mill(const meshing::MillDescription& description, Options& options);

/// Whether options as they were typed request other averages than those of their mill.
bool request_others(const Options& options);

/// Whether they have cells of their own: voxels of a box or a cylinder, or a mesh.
bool has_grid(const Options& options);

/// Whether they have a window, a start or an end of their own.
bool has_windows(const Options& options);

/// Fills in the grid of the section `averages` of a mill with its periods, and its walls and method where the
/// options leave these open: a mill's method holds for its own grid. The options must not have one. Throws
/// std::invalid_argument that names
/// `--shape`, `--frame`, `--components` or `--periodic`, which say nothing about a mill's grid.
void take_grid(const meshing::Mill& mill, Options& options);

/// When a dry run becomes steady.
struct SteadyStart {
  double time = 0;      ///< DEM time, s
  std::string warning;  ///< a sentence where the run did not become steady; otherwise empty
};

/// From the `results.json` of a dry run: `steady_from_s` and `steady`. Throws std::invalid_argument that
/// names the file where it has no such number, JsonError where it cannot be read.
SteadyStart steady_start(const std::filesystem::path& results);

/// DEM time at which the last whole window of a dry run ends, s. Times are rounded to whole time-steps, as
/// plan_windows does. Throws std::invalid_argument where there is none, WindowError.
/// @param start  of the first window, s
/// @param end  of the dry run, s
/// @param duration  of the dry run, s, for the message
/// @param window  length of the windows, s
/// @param timestep  of the dry run, s
double last_whole_window(double start, double end, double duration, double window, double timestep);

}  // namespace millfoam::averaging
