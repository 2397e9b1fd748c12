// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "averaging/deposition/deposition.hpp"
#include "averaging/grids/grid.hpp"
#include "averaging/mesh/mesh_diffusion.hpp"
#include "averaging/run/average_request.hpp"
#include "averaging/statistics/window_average.hpp"
#include "averaging/walls/moving_walls.hpp"

namespace millfoam::averaging {

/// What the DEM run's metadata and the request agree on.
struct RunSettings {
  double timestep = 0;                     ///< of the DEM run, s
  std::optional<double> angular_velocity;  ///< of the mill about z, right-handed, rad/s
  double sauter_diameter = 0;              ///< of the balls in the first dump that is used, m
};

/// The grid, method and walls of a request, prepared once and shared by all threads.
struct CellSetup {
  Grid grid;                                       ///< for the solids file
  std::unique_ptr<Deposition> deposition;          ///< each thread has a clone of it
  CellLimits limits;                               ///< for `average`
  std::shared_ptr<const MovingWalls> walls;        ///< null unless walls cut the cells
  std::shared_ptr<const MeshDiffusion> diffusion;  ///< null unless fields on a mesh are smoothed
  std::string method;                              ///< in words, for the solids file
  double smoothing = 0;                            ///< width, m
  std::optional<double> walls_over_grid;           ///< width of the walls across z over that of the grid
};

/// Prepares all that does not depend on the records. `note` gets sentences on what was taken for granted.
/// Throws std::invalid_argument for settings that do not go together, and for a mesh or a period that cannot
/// be used, naming the option and the mesh's file; MeshFileError, SurfaceError.
CellSetup set_up(const AverageRequest& request, const RunSettings& settings,
                 const std::function<void(const std::string&)>& note);

}  // namespace millfoam::averaging
