// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

namespace millfoam::averaging {

/// Signed volume, m^3, of a sphere about the origin within the cone from the origin over a triangle.
///
/// For a closed surface of triangles that see their outside anticlockwise, the sum over them is the volume of
/// the sphere inside the surface, wherever the sphere is: this is the divergence theorem for the field x/3
/// cut at the sphere. A triangle turned round gives the same value with the other sign to the last bit, so
/// two cells that share a triangle neither lose nor double anything.
///
/// @param a, b, c  corners relative to the sphere's centre, m
/// @param radius   m, positive
double sphere_triangle_volume(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                              double radius);

}  // namespace millfoam::averaging
