// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "meshing/mill/mill.hpp"
#include "meshing/mill/yaml_section.hpp"

namespace millfoam::meshing {

/// Windows of averages in a turn of a tumbling mill where mill.yaml leaves them open: short against a turn,
/// with 25 records.
inline constexpr double windows_per_turn = 20;

/// The map `averages` under the root. `mill` has everything but averages and flow; defaults follow from its
/// geometry, charge and speed. Throws MillError for averages that are impossible.
Averages read_averages(const Section& root, const Mill& mill);

}  // namespace millfoam::meshing
