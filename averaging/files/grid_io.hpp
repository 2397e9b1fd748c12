// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "averaging/files/hdf5_handle.hpp"
#include "averaging/grids/grid.hpp"

/// @file
/// The group /grid of a file of fields. Both functions throw hdf5::Error.

namespace millfoam::averaging::hdf5 {

/// Writes a grid into an open, empty group.
void write_grid(hid_t group, const Grid& grid);

/// Reads it back, without what is there for pictures only.
Grid read_grid(hid_t group);

}  // namespace millfoam::averaging::hdf5
