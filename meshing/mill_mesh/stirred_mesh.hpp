// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "meshing/mill/mill.hpp"
#include "meshing/volume/mesh_quality.hpp"
#include "meshing/volume/volume_mesh.hpp"

namespace millfoam::meshing {

/// What a stirred mill's mesh may have at most. The cells at the four edges of the block that a pin takes
/// have a face with an angle of 180 degrees on the pin: these are its most skew ones.
inline constexpr QualityLimits stirred_limits = {
    50, 2, 5, allowed_volume_error,
    "choose another resolution.cell_size, or an impeller whose parts are further from each other, from the "
    "shaft's end and from the shell"};

/// Hexahedra that fill a stirred mill at DEM time 0, with a hole for the impeller; the mesh turns as a whole
/// with it. The patches are impeller, shell, base and lid.
///
/// Rings of cells about the axis reach from the shaft to the shell; below the shaft's end an O-grid fills the
/// middle. Where a pin lies, a block of the rings' cells is left out, and the points around it are moved
/// onto the pin: the sides of the block's section become arcs of the pin's circle. Between the pins' heights
/// the lines of cells go over from one level's angles to the next one's. The tips of pins are flat. Cells are
/// about `cell_size` (m) wide; smaller at pins, tips and in gaps, up to four times as high far above the
/// impeller.
VolumeMesh make_stirred_mesh(const Geometry& geometry, double cell_size);

}  // namespace millfoam::meshing
