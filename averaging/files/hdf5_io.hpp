// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "averaging/files/hdf5_handle.hpp"

/// @file
/// The few kinds of attributes and data sets that this room's files are made of. All functions throw
/// hdf5::Error with the name of the attribute or data set when HDF5 fails.

namespace millfoam::averaging::hdf5 {

/// Opens a group of a file or group.
Handle open_group(hid_t parent, const std::string& name);
/// Makes a new group in a file or group.
Handle create_group(hid_t parent, const std::string& name);

/// Writes a new attribute: a text of fixed length.
void write_attribute(hid_t object, const std::string& name, const std::string& text);
/// Writes a new attribute: a list of numbers.
void write_attribute(hid_t object, const std::string& name, const std::vector<double>& values);
/// Writes a new attribute: a list of whole numbers.
void write_attribute(hid_t object, const std::string& name, const std::vector<int>& values);

/// Writes a new attribute: a single number is written as a scalar, as h5py's users expect.
void write_attribute(hid_t object, const std::string& name, double value);
/// The same of a whole number.
void write_attribute(hid_t object, const std::string& name, int value);

/// Gives an attribute that is there a new value.
void overwrite_attribute(hid_t object, const std::string& name, int value);

/// A text attribute of fixed or of variable length; throws for another kind.
std::string read_text_attribute(hid_t object, const std::string& name);

/// Any kind of number, converted; throws unless there are `count` of them.
std::vector<double> read_double_attribute(hid_t object, const std::string& name, std::size_t count);
/// The same, converted to whole numbers.
std::vector<int> read_int_attribute(hid_t object, const std::string& name, std::size_t count);

/// Chunks must stay below it, bytes: HDF5 counts their bytes with 32 bits.
inline constexpr hsize_t chunk_limit = (hsize_t{1} << 32) - 1;

/// Dimensions of the chunks of one row: the whole row, or where that reaches the limit, equal parts of it
/// along its slowest dimensions.
/// @param row  its dimensions, slowest first; at least one
/// @param number_size  bytes of a number
/// @param limit  bytes that a chunk stays below, more than those of a number
std::vector<hsize_t> chunk_of_row(const std::vector<hsize_t>& row, hsize_t number_size,
                                  hsize_t limit = chunk_limit);

/// Creates an empty data set that grows along its first dimension.
/// @param parent  file or group that it is made in
/// @param name   of the data set
/// @param row    dimensions of one row, slowest first; empty for a single number per row
/// @param type   H5T_NATIVE_DOUBLE or H5T_NATIVE_INT64
/// @param units  written as the attribute `units`
///
/// A row with dimensions is one chunk, or several of `chunk_of_row`, compressed (shuffle, deflate level 1:
/// most voxels of a mill are empty).
Handle create_rows(hid_t parent, const std::string& name, const std::vector<hsize_t>& row, hid_t type,
                   const std::string& units);

/// Appends one row; `values` holds the product of its dimensions.
void append_row(const Handle& dataset, const double* values);
/// Appends a row of a single whole number.
void append_row(const Handle& dataset, long long value);

/// Writes a data set of fixed size; `sizes` are its dimensions, slowest first.
void write_array(hid_t parent, const std::string& name, const std::vector<double>& values,
                 const std::vector<hsize_t>& sizes, const std::string& units);

/// Writes a list of whole numbers.
void write_array(hid_t parent, const std::string& name, const std::vector<long long>& values,
                 const std::string& units);

/// Whether there is a data set or group of this name.
bool has(hid_t parent, const std::string& name);

/// Whether an object has an attribute.
bool has_attribute(hid_t object, const std::string& name);

/// Dimensions of a data set, slowest first; throws when there is none of this name.
std::vector<hsize_t> dimensions(hid_t parent, const std::string& name);

/// Row `index` along the first dimension, flattened in C order; throws for one beyond the last.
std::vector<double> read_row(hid_t parent, const std::string& name, hsize_t index);

/// All values, flattened in C order.
std::vector<double> read_all(hid_t parent, const std::string& name);

}  // namespace millfoam::averaging::hdf5
