// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "averaging/files/slurry_reader.hpp"
#include "averaging/grids/box_grid.hpp"
#include "averaging/values/voxel_sums.hpp"

namespace millfoam::averaging {

/// What balls feel at one time, as means over voxels: those of a window of slurry.h5 with a single sample.
/// @param sums  of the components `ball_components`, over all cells
BallFields ball_means(const BoxGrid& grid, const VoxelSums& sums);

}  // namespace millfoam::averaging
