// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "meshing/mill/mill.hpp"
#include "meshing/walls/wall_surface.hpp"

namespace millfoam::meshing {

/// The walls of a stirred mill with its impeller at DEM time 0: parts impeller, shell, base and lid, which
/// share their points and close the space of the balls. Round parts are facetted so that chords lie within
/// 0.1 % of the shell's radius of the arcs, with their points on the true surface; each piece of the
/// shaft's side between discs is triangulated unrolled, with a hole for each pin.
/// @param geometry  of a stirred mill
WallSurface make_stirred_walls(const Geometry& geometry);

/// Largest relative difference between the volume that a stirred mill's walls enclose and the closed form.
inline constexpr double allowed_stirred_volume_error = 0.005;

/// Throws std::runtime_error when the walls enclose another volume than the closed form, m^3, by more than
/// that.
void require_stirred_volume(double of_walls, double closed_form);

}  // namespace millfoam::meshing
