// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "averaging/walls/clipped_polygon.hpp"

namespace millfoam::averaging {

/// The prism between a flat polygon and its projection onto a plane z = level; both negative where the
/// polygon is seen from below.
struct Prism {
  double area = 0;    ///< of the projection, m^2
  double volume = 0;  ///< m^3
};

/// Of a whole polygon.
/// @param polygon  corners in m
/// @param level  m
Prism prism_below(const ClippedPolygon& polygon, double level);

/// Of its part within a distance from the z axis. The polygon must lie within less than half a turn about
/// that axis. What the circle leaves is a polygon and segments of a circle, whose area and first moment are
///
///     R^2 (phi - sin phi) / 2,    2/3 R^3 sin^3(phi/2)  along the bisector, about the axis
///
/// @param polygon  corners in m
/// @param level, radius  m
/// @param slope  of the polygon's plane: dz/dx, dz/dy
Prism prism_below(const ClippedPolygon& polygon, double level, double radius, const Eigen::Vector2d& slope);

}  // namespace millfoam::averaging
