// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "meshing/mill/mill.hpp"
#include "meshing/mill/yaml_section.hpp"

namespace millfoam::meshing {

/// The map `averages` under the root. `mill` has everything but averages and flow; defaults follow from its
/// geometry, charge and speed. Throws MillError for averages that are impossible.
Averages read_averages(const Section& root, const Mill& mill);

/// The map `flow` under the root, and `level` of the map `slurry`. `mill` has everything but the flow. Throws
/// MillError for an impossible flow: an unknown law, a start given twice, more slurry than there is room,
/// …
Flow read_flow(const Section& root, Section& slurry, const Mill& mill);

}  // namespace millfoam::meshing
