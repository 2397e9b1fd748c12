// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "meshing/mill/mill.hpp"
#include "meshing/mill/yaml_section.hpp"

namespace millfoam::meshing {

/// The map `geometry` of a stirred mill's mill.yaml. Throws MillError for an impossible mill: pins that hit
/// the shell, the base, the lid or each other, or that are thicker than the shaft.
Geometry read_stirred_geometry(const Section& in);

/// The map `speed` of a stirred mill: rad/s, right-handed about +z (up). Throws MillError for both ways to
/// give it at once, and for speeds that no mill has.
double read_stirred_speed(Section& in, const Geometry& geometry);

/// Volume of an impeller below a height, m^3, by quadrature over the height; what is above the lid is not
/// counted.
/// @param geometry  of a stirred mill
/// @param height  z, m; at most the mill's
double impeller_volume(const Geometry& geometry, double height);

/// Largest distance of the impeller's pins from the axis, m; of a bare shaft its radius.
double impeller_radius(const Impeller& impeller);

/// Height of the highest pin's upper edge, m; without pins that of the shaft's end.
double impeller_top(const Impeller& impeller);

}  // namespace millfoam::meshing
