// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "meshing/mill/mill.hpp"
#include "meshing/mill/yaml_section.hpp"

namespace millfoam::meshing {

/// The map `flow` under the root, and `level` of the map `slurry`. `mill` has everything but the flow. Throws
/// MillError for an impossible flow: an unknown law, a start given twice, more slurry than there is room,
/// …
Flow read_flow(const Section& root, Section& slurry, const Mill& mill);

}  // namespace millfoam::meshing
