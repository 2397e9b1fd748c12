// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "averaging/values/particle.hpp"

namespace millfoam::averaging {

/// Radius, m, of the smallest sphere about a superquadric's centre that holds it, for blockiness of 2 or
/// more:
///
///     R(u, v; n) = (u^q + v^q)^(1/q),  q = 2n/(n-2);   max(u, v) for n = 2
///     radius = R(R(a, b; n2), c; n1)
///
/// by Hoelder's inequality, first in the plane of x and y and then between it and z.
double bounding_radius(const Superquadric& shape);

}  // namespace millfoam::averaging
