// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "meshing/mill/mill.hpp"
#include "meshing/mill/yaml_section.hpp"

namespace millfoam::meshing {

/// Most voxels or slices along an axis, which memory and files can hold.
inline constexpr int most_along_axis = 10000;

/// Most voxels together: a window of their velocity, 24 bytes each, is one chunk of an HDF5 file, which may
/// have 4 GiB.
inline constexpr double most_voxels = 1.7e8;

/// Length along the axis that slurry and balls can reach, m.
double axial_reach(const Geometry& geometry);

/// Voxels across and along the mill, by the keys `voxel_size` or `counts` of a map; an even number across
/// unless counted. Where neither is given, their size is `usual_size`, m. `usual_along` is their number along
/// the axis; 0: by their size.
Voxels read_voxels(Section& in, const Geometry& geometry, double usual_size, int usual_along);

}  // namespace millfoam::meshing
