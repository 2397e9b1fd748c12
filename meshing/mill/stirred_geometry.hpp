// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "meshing/mill/mill.hpp"
#include "meshing/mill/yaml_section.hpp"

namespace millfoam::meshing {

/// The map `geometry` of a stirred mill's mill.yaml. Throws MillError for an impossible mill: pins or discs
/// that hit the shell, the base, the lid or each other, or pins that are thicker than the shaft.
Geometry read_stirred_geometry(const Section& in);

/// The map `speed` of a stirred mill: rad/s, right-handed about +z (up). Throws MillError for both ways to
/// give it at once, and for speeds that no mill has.
double read_stirred_speed(Section& in, const Geometry& geometry);

/// Volume of an impeller below a height, m^3: of shaft and discs in closed form, of pins by quadrature over
/// the height; what is above the lid is not counted.
/// @param geometry  of a stirred mill
/// @param height  z, m; at most the mill's
double impeller_volume(const Geometry& geometry, double height);

/// Whether a disc's lower face is the shaft's end.
bool is_at_shaft_end(const Disc& disc, const Impeller& impeller);

/// Largest distance of the tips' centres and of the discs' rims from the axis, m; of a bare shaft its radius.
double impeller_radius(const Impeller& impeller);

/// Smallest distance of the shell from pins, whose ends are flat, and from discs, m.
/// @param geometry  of a stirred mill
double impeller_gap(const Geometry& geometry);

/// Height of the upper edge of the highest pin or disc, m; of a bare shaft that of its end.
double impeller_top(const Impeller& impeller);

}  // namespace millfoam::meshing
