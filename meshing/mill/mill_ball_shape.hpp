// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "meshing/mill/superquadric.hpp"
#include "meshing/mill/yaml_section.hpp"

namespace millfoam::meshing {

/// Least radius of curvature that a ball may have over its diameter. Hertz' law needs overlaps well below the
/// radius of curvature, and softened balls overlap by several percent of their diameter.
inline constexpr double least_curvature_share = 0.08;

/// The longest way through a ball's centre that a mill has room for.
struct Room {
  double length;          ///< m
  const char* of;         ///< what is so long, for messages
  const char* unit;       ///< of the length, and how to allow larger balls
  bool included = false;  ///< whether the way may also be of this very length

  /// Whether a ball of that longest way, m, has room.
  bool holds(double way) const { return included ? way <= length : way < length; }
  /// "below the mill's length, 0.1 m"
  std::string words() const;
};

/// The key `shape` of a size class, or of a charge of one size: `sphere`, as where the key is missing, or a
/// map with half_axes and blockiness or roundness. The word `sphere` is not recorded: such a mill is that
/// without the key.
/// @param in  the map that has the key
/// @param diameter  of the sphere of equal volume, m, to which the half axes are scaled
/// @param room  that the ball must have
/// Throws MillError for an impossible shape, one that does not fit, and one with too sharp edges.
std::optional<Superquadric> read_ball_shape(Section in, double diameter, const Room& room);

}  // namespace millfoam::meshing
