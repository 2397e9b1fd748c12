// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "meshing/cross_section.hpp"
#include "meshing/mill.hpp"
#include "meshing/volume_mesh.hpp"

namespace millfoam::meshing {

/// Hexahedra that fill the mill at DEM time 0: its cross-section drawn along z in `layers` equal
/// layers. The patches
/// are, in this order, shell, lifters (without faces in a smooth drum), feedEnd (z = 0) and dischargeEnd (z =
/// length); the two ends are joined periodically where the mill's ends are periodic.
VolumeMesh make_mill_mesh(const CrossSection& section, const Geometry& geometry, int layers);

}  // namespace millfoam::meshing
