// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "averaging/files/hdf5_handle.hpp"

/// @file
/// Data sets of one dimension that are written and read as a whole. All functions throw hdf5::Error with the
/// name of the data set when HDF5 fails.

namespace millfoam::averaging::hdf5 {

/// Writes whole numbers, compressed; without an attribute `units`, for these are numbers of things.
void write_array(hid_t parent, const std::string& name, const std::vector<int>& values);

/// Writes texts, padded to the longest with zeros.
void write_array(hid_t parent, const std::string& name, const std::vector<std::string>& texts);

/// Throws also unless the data set has one dimension and holds whole numbers that fit.
std::vector<int> read_ints(hid_t parent, const std::string& name);

/// Texts of fixed length; throws also for other kinds.
std::vector<std::string> read_texts(hid_t parent, const std::string& name);

}  // namespace millfoam::averaging::hdf5
