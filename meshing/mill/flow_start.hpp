// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "meshing/mill/mill.hpp"
#include "meshing/mill/yaml_section.hpp"

namespace millfoam::meshing {

/// The slurry at the start of a flow: `level` of the map `slurry`, or `start` of the map `flow`. `mill` has
/// everything but the flow. Throws MillError for a start that is given twice, or for more slurry than there
/// is room.
/// `flow` and `slurry` are these maps; `with_balls` says whether the flow has balls, which take their room.
FlowStart read_flow_start(const Section& flow, Section& slurry, bool with_balls, const Mill& mill);

}  // namespace millfoam::meshing
