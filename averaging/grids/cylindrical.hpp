// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "averaging/values/vector3.hpp"

namespace millfoam::averaging {

/// A vector or point turned about z by an angle, rad, right-handed.
Vector3 turned(const Vector3& vector, double angle);

/// Components along r, theta and z at a point of a vector that is given along x, y and z:
///
///     v_r = v_x cos(theta) + v_y sin(theta),  v_theta = -v_x sin(theta) + v_y cos(theta)
///
/// On the axis theta is 0.
Vector3 to_cylindrical(const Vector3& vector, const Vector3& point);

/// The inverse of `to_cylindrical` at the same point.
Vector3 to_cartesian(const Vector3& components, const Vector3& point);

}  // namespace millfoam::averaging
