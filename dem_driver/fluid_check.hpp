// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "dem_driver/deck.hpp"
#include "dem_driver/fluid_settings.hpp"
#include "meshing/mill/mill.hpp"

namespace millfoam::dem_driver {

/// The drag is explicit in a DEM step, so that a step must be short against the time rho/K in which it stops
/// a ball: K dt/rho is at most this. The ball's speed against the fluid then decays by a rate that is right
/// to half of it.
inline constexpr double largest_drag_step = 0.05;

/// A flow's forces for a run of this mill. All fields that the run will use are read. Throws
/// averaging::SlurryFileError as SlurryReader does, and for a file of another mill, for voxels that do not
/// cover the mill or are not periodic as it is, and for a drag that is too strong for the plan's time-step;
/// the message names the file, what was found and what was expected.
FluidSettings require_fluid_of(const std::filesystem::path& file, FluidTime time, const meshing::Mill& mill,
                               const DemPlan& plan);

}  // namespace millfoam::dem_driver
