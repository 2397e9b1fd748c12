// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "averaging/files/slurry_reader.hpp"
#include "averaging/grids/box_grid.hpp"
#include "dem_driver/dem_plan.hpp"
#include "dem_driver/fluid_settings.hpp"
#include "meshing/mill/mill.hpp"

namespace millfoam::dem_driver {

/// The drag is explicit in a DEM step, so that a step must be short against the time rho/K in which it stops
/// a ball: K dt/rho is at most this. The ball's speed against the fluid then decays by a rate that is right
/// to half of it.
inline constexpr double largest_drag_step = 0.05;

/// What the drag of a run's balls is judged by.
struct DragLimits {
  bool polydispersity = false;   ///< a ball feels the exchange of its own size
  double smallest_ball = 0;      ///< diameter, m
  double ball_density = 0;       ///< kg/m^3
  double timestep = 0;           ///< of the DEM run, s
  double rayleigh_fraction = 0;  ///< dem.rayleigh_fraction, by which the time-step is chosen
  double shape_factor = 1;       ///< largest exchange of a ball over that of the flow, by its shape
};

/// Throws averaging::SlurryFileError where the drag stops the smallest ball within too few steps; the message
/// names `source`, the place and what to change.
/// @param fields  on the grid
/// @param grid  of the voxels
/// @param source  of the fields
/// @param limits  of the mill: density and smallest diameter of its balls
void require_slow_drag(const averaging::BallFields& fields, const averaging::BoxGrid& grid,
                       const DragLimits& limits, const std::string& source);

/// A flow's forces for a run of this mill. All fields that the run will use are read. Throws
/// averaging::SlurryFileError as SlurryReader does, and for a file of another mill, for voxels that do not
/// cover the mill or are not periodic as it is, and for a drag that is too strong for the plan's time-step;
/// the message names the file, what was found and what was expected.
FluidSettings require_fluid_of(const std::filesystem::path& file, FluidTime time, const meshing::Mill& mill,
                               const DemPlan& plan);

/// Throws averaging::SlurryFileError, naming both times, where a fluid has time windows of which none shares
/// some time with the run. The plan must have its begin.
void require_windows_in_run(const FluidSettings& fluid, const DemPlan& plan);

}  // namespace millfoam::dem_driver
