// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "meshing/mill/superquadric.hpp"
#include "meshing/mill/yaml_section.hpp"

namespace millfoam::meshing {

/// Least radius of curvature that a ball may have over its diameter. Hertz' law needs overlaps well below the
/// radius of curvature, and softened balls overlap by several percent of their diameter.
inline constexpr double least_curvature_share = 0.08;

/// The key `shape` of a size class, or of a charge of one size: `sphere`, as where the key is missing, or a
/// map with half_axes and blockiness or roundness. The word `sphere` is not recorded: such a mill is that
/// without the key.
/// @param in  the map that has the key
/// @param diameter  of the sphere of equal volume, m, to which the half axes are scaled
/// @param room  m, that the ball's longest way through its centre must be below
/// @param of  what that is, for messages
/// Throws MillError for an impossible shape, one that does not fit, and one with too sharp edges.
std::optional<Superquadric> read_ball_shape(Section in, double diameter, double room, const char* of);

}  // namespace millfoam::meshing
