// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>

#include "averaging/grids/box_grid.hpp"
#include "averaging/grids/cylinder_grid.hpp"
#include "averaging/values/solids_window.hpp"

namespace millfoam::averaging {

/// The solids at one point.
struct LocalSolids {
  double solidity = 0;    ///< volume of particles over volume
  Vector3 velocity{};     ///< of the particles, lab frame, m/s; 0 where there are none
  double diameter = 0;    ///< Sauter mean, m; 0 where there are no particles
  double diameter43 = 0;  ///< m; 0 where there are no particles
  bool inside = false;    ///< whether the point lies in the grid; outside there are no solids
};

/// How a field on voxels is read at a point.
enum class Interpolation {
  cell,   ///< the value of the voxel that holds the point
  linear  ///< trilinear between the centres of voxels, in the grid's own coordinates
};

/// Solids at `point` (m, lab frame) out of one window on `grid`, a box or a cylinder.
///
/// `linear` interpolates phi, phi*u, phi/d32 and phi*d43 and divides afterwards, so that an empty voxel
/// counts with a solidity of 0 and not with a velocity of 0: next to it the velocity is still that of the
/// particles. Within the outer half of the outermost voxels the values are those of their centres; along a
/// periodic axis (the angle of a cylinder always is) the last voxel is the first one's neighbour. Where walls
/// cut the voxels, each takes part in proportion to its share inside: what lies in the wall is not known, and
/// not empty. The window's fields must have the grid's size.
LocalSolids sample(const BoxGrid& grid, const SolidsWindow& window, const Vector3& point,
                   Interpolation interpolation);
/// The same on a cylinder, whose own coordinates are r, theta and z. `time` is the DEM time, s, at which the
/// point is at `point`: a cylinder that turns is sampled where the point is in its frame. Velocities along r,
/// theta and z are interpolated as such, and turned to x and y at the point's own azimuth.
LocalSolids sample(const CylinderGrid& grid, const SolidsWindow& window, const Vector3& point,
                   Interpolation interpolation, double time = 0);

/// How much of the solids that `sample` gives at a point is of a voxel.
struct SolidsShare {
  std::size_t voxel = 0;  ///< its offset in the grid
  double solidity = 0;    ///< its part of the solidity at the point
};

/// The parts of `linear` interpolation on a box, which add up to the solidity at the point; all are 0 where
/// there are no solids, and beyond the grid.
std::array<SolidsShare, 8> solids_shares(const BoxGrid& grid, const SolidsWindow& window,
                                         const Vector3& point);

}  // namespace millfoam::averaging
