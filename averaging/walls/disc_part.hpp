// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "averaging/walls/clipped_polygon.hpp"

namespace millfoam::averaging {

/// What lies below a part of a plane: area of its projection onto z = 0, m^2, and the volume down to a level
/// z, m^3; both negative where the part is seen from below.
struct BelowPlane {
  double area = 0;
  double volume = 0;
};

/// Of a whole polygon.
BelowPlane below(const ClippedPolygon& polygon, double level);

/// Of its part within a distance from the z axis. The polygon must lie within less than half a turn about
/// that axis. What the circle leaves is a polygon and segments of a circle, whose area and first moment are
///
///     R^2 (phi - sin phi) / 2,    2/3 R^3 sin^3(phi/2)  along the bisector, about the axis
///
/// @param slope  of the polygon's plane: dz/dx, dz/dy
BelowPlane below(const ClippedPolygon& polygon, double level, double radius, const Eigen::Vector2d& slope);

}  // namespace millfoam::averaging
