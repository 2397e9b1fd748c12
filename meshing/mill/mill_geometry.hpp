// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "meshing/mill/mill.hpp"
#include "meshing/mill/yaml_section.hpp"

namespace millfoam::meshing {

/// More cells than this overflow the 32-bit labels of OpenFOAM with their faces.
inline constexpr double most_cells = 1e8;

/// The map `geometry` of a mill.yaml. Throws MillError for an impossible mill: lifters that overlap, openings
/// that do not fit inside the lifters or without plain ends, …
Geometry read_geometry(const Section& in);

/// The map `resolution` of a mill.yaml. Throws MillError for numbers that the cross-section's blocks cannot
/// have, or for more cells than OpenFOAM counts.
/// With `lifters_changed`, where --set or a variant changes the lifters, cells at lifters of the file that
/// are taken away are left out.
Resolution read_resolution(const Section& in, const Geometry& geometry, bool lifters_changed);

/// Width of the flow's cells on the shell, m: the requested one, or that of the counts around the mill.
double shell_cell_size(const Resolution& resolution, const Geometry& geometry);

}  // namespace millfoam::meshing
