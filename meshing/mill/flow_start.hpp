// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "meshing/mill/mill.hpp"
#include "meshing/mill/yaml_section.hpp"

namespace millfoam::meshing {

/// The slurry at the start of a flow: `level` of the map `slurry`, or `start` of the map `flow`. `mill` has
/// everything but the flow. Throws MillError for a start that is given twice, or for more slurry than there
/// is room.
/// @param flow  the map `flow`
/// @param slurry  the map `slurry`
/// @param with_balls  whether the flow has balls, which take their room
FlowStart read_flow_start(const Section& flow, Section& slurry, bool with_balls, const Mill& mill);

}  // namespace millfoam::meshing
