// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "averaging/grids/box_grid.hpp"
#include "averaging/grids/cylinder_grid.hpp"

namespace millfoam::averaging {

/// Pairs of cells that share a face, by their positions in a field, the lower one first, each pair once;
/// along periodic directions the last voxel's neighbour is the first one. A voxel is not a neighbour of
/// itself. Voxels that meet in a line or corner only, as those about the axis of a cylinder, are none. Throws
/// std::invalid_argument for grids of more cells than an int can number.
std::vector<std::array<int, 2>> neighbours(const BoxGrid& grid);
/// The same on a cylinder, whose angle always is periodic.
std::vector<std::array<int, 2>> neighbours(const CylinderGrid& grid);

}  // namespace millfoam::averaging
