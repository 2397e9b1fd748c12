// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "meshing/mill/mill.hpp"
#include "meshing/mill_mesh/cross_section.hpp"

namespace millfoam::meshing {

/// Divisions whose cells are about `cell_size` (m) wide on the lifters and the shell. The perimeter is a
/// multiple of four, as the core needs, and no cell spans more than a fortieth of the shell, so that the
/// facets of the shell stay within 0.42 % of the circle's area. Layers in the ring are about as thick as they
/// are wide, or thinner where a band or the rows next to the lifters would be more than 2.5 times as thick as
/// those they touch.
Divisions choose_divisions(const Geometry& geometry, double cell_size);

/// The divisions of given counts, whose perimeter must be a multiple of four; the ring's layers, at least one
/// for each band, are distributed so that their ratios of thickness to width are as equal as whole numbers
/// allow.
Divisions given_divisions(const Geometry& geometry, const BlockCounts& counts);

}  // namespace millfoam::meshing
