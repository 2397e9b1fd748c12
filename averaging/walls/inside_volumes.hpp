// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "averaging/grids/box_grid.hpp"
#include "averaging/grids/cylinder_grid.hpp"
#include "averaging/walls/surface.hpp"

namespace millfoam::averaging {

/// Volume of each voxel inside the walls, [voxels], m^3: exact to round-off.
///
/// By the divergence theorem along x, of a voxel from x_i to x_i + dx, over the triangles of the walls,
///
///     V = sum sign(n_x) Int clamp(x - x_i, 0, dx) dy dz
///
/// where the integral runs over the triangle's part within the voxel's range of y and z. The triangles are
/// cut by the planes between voxels, so that the integrands are linear. What differs from an empty or a whole
/// voxel by less than 1e-12 of it is made so.
/// @param grid   of the lab frame
/// @param walls  closed surface of the mill, m
/// @param place  carries the walls to where they are; along periodic axes they are not repeated
std::vector<double> inside_volumes(const BoxGrid& grid, const Surface& walls, const Eigen::Isometry3d& place);

/// The same for a cylinder, exact too: along z, with triangles cut by the planes between steps of z and
/// theta; between steps of r the integrals of linear functions over polygons cut by a circle are in closed
/// form.
std::vector<double> inside_volumes(const CylinderGrid& grid, const Surface& walls,
                                   const Eigen::Isometry3d& place);

}  // namespace millfoam::averaging
