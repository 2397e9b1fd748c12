// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/files/hdf5_io.hpp"

#include <algorithm>
#include <functional>
#include <numeric>

namespace millfoam::averaging::hdf5 {

namespace {

Handle attribute_space(const std::string& name, const hsize_t* count) {
  const std::string action = "make room for attribute '" + name + "'";
  if (count == nullptr) return {H5Screate(H5S_SCALAR), H5Sclose, action};
  return {H5Screate_simple(1, count, nullptr), H5Sclose, action};
}

void write_raw_attribute(hid_t object, const std::string& name, const Handle& space, hid_t type,
                         const void* values) {
  const std::string action = "write attribute '" + name + "'";
  const Handle attribute(H5Acreate2(object, name.c_str(), type, space.get(), H5P_DEFAULT, H5P_DEFAULT),
                         H5Aclose, action);
  check(H5Awrite(attribute.get(), type, values), action);
}

Handle open_attribute(hid_t object, const std::string& name) {
  if (H5Aexists(object, name.c_str()) <= 0) throw Error("attribute '" + name + "' is missing");
  return {H5Aopen(object, name.c_str(), H5P_DEFAULT), H5Aclose, "open attribute '" + name + "'"};
}

template <typename T>
std::vector<T> read_number_attribute(hid_t object, const std::string& name, std::size_t count, hid_t type) {
  const Handle attribute = open_attribute(object, name);
  const Handle space(H5Aget_space(attribute.get()), H5Sclose, "read attribute '" + name + "'");
  const hssize_t found = H5Sget_simple_extent_npoints(space.get());
  if (found != static_cast<hssize_t>(count)) {
    throw Error("attribute '" + name + "' holds " + std::to_string(found) + " values, expected " +
                std::to_string(count));
  }
  std::vector<T> values(count);
  check(H5Aread(attribute.get(), type, values.data()), "read attribute '" + name + "' as numbers");
  return values;
}

Handle open_dataset(hid_t parent, const std::string& name) {
  return {H5Dopen2(parent, name.c_str(), H5P_DEFAULT), H5Dclose, "find data set '" + name + "'"};
}

std::vector<hsize_t> extent(const Handle& space) {
  const int rank = H5Sget_simple_extent_ndims(space.get());
  if (rank < 0) throw Error("cannot read the dimensions of a data set");
  std::vector<hsize_t> sizes(static_cast<std::size_t>(rank));
  H5Sget_simple_extent_dims(space.get(), sizes.data(), nullptr);
  return sizes;
}

Handle dataset_space(const Handle& dataset) {
  return {H5Dget_space(dataset.get()), H5Sclose, "read the dimensions of a data set"};
}

hsize_t product(const std::vector<hsize_t>& sizes) {
  return std::accumulate(sizes.begin(), sizes.end(), hsize_t{1}, std::multiplies<>());
}

/// Selects row `index` in a file's space and returns the matching space in memory.
Handle select_row(const Handle& file_space, hsize_t index) {
  std::vector<hsize_t> count = extent(file_space);
  if (count.empty() || index >= count[0]) throw Error("cannot select row " + std::to_string(index));
  std::vector<hsize_t> start(count.size(), 0);
  start[0] = index;
  count[0] = 1;
  check(H5Sselect_hyperslab(file_space.get(), H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr),
        "select row " + std::to_string(index));
  const hsize_t points = product(count);
  return {H5Screate_simple(1, &points, nullptr), H5Sclose, "make room for row " + std::to_string(index)};
}

void append_raw_row(const Handle& dataset, hid_t type, const void* values) {
  std::vector<hsize_t> sizes = extent(dataset_space(dataset));
  const hsize_t row = sizes[0]++;
  const std::string action = "write row " + std::to_string(row) + " (is the disk full?)";
  check(H5Dset_extent(dataset.get(), sizes.data()), action);
  const Handle file_space = dataset_space(dataset);
  const Handle memory_space = select_row(file_space, row);
  check(H5Dwrite(dataset.get(), type, memory_space.get(), file_space.get(), H5P_DEFAULT, values), action);
}

void write_raw_array(hid_t parent, const std::string& name, hid_t type, const void* values,
                     const std::vector<hsize_t>& sizes, const std::string& units) {
  const std::string action = "write data set '" + name + "' (is the disk full?)";
  const Handle space(H5Screate_simple(static_cast<int>(sizes.size()), sizes.data(), nullptr), H5Sclose,
                     action);
  const Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, action);
  check(H5Pset_obj_track_times(properties.get(), false), action);
  const Handle dataset(
      H5Dcreate2(parent, name.c_str(), type, space.get(), H5P_DEFAULT, properties.get(), H5P_DEFAULT),
      H5Dclose, action);
  write_attribute(dataset.get(), "units", units);
  check(H5Dwrite(dataset.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), action);
}

}  // namespace

Handle open_group(hid_t parent, const std::string& name) {
  return {H5Gopen2(parent, name.c_str(), H5P_DEFAULT), H5Gclose, "find group '" + name + "'"};
}

Handle create_group(hid_t parent, const std::string& name) {
  return {H5Gcreate2(parent, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose,
          "create group '" + name + "'"};
}

void write_attribute(hid_t object, const std::string& name, const std::string& text) {
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "make a type for attribute '" + name + "'");
  check(H5Tset_size(type.get(), text.size() + 1), "size attribute '" + name + "'");
  write_raw_attribute(object, name, attribute_space(name, nullptr), type.get(), text.c_str());
}

void write_attribute(hid_t object, const std::string& name, const std::vector<double>& values) {
  const hsize_t count = values.size();
  write_raw_attribute(object, name, attribute_space(name, &count), H5T_NATIVE_DOUBLE, values.data());
}

void write_attribute(hid_t object, const std::string& name, const std::vector<int>& values) {
  const hsize_t count = values.size();
  write_raw_attribute(object, name, attribute_space(name, &count), H5T_NATIVE_INT, values.data());
}

void write_attribute(hid_t object, const std::string& name, double value) {
  write_raw_attribute(object, name, attribute_space(name, nullptr), H5T_NATIVE_DOUBLE, &value);
}

void write_attribute(hid_t object, const std::string& name, int value) {
  write_raw_attribute(object, name, attribute_space(name, nullptr), H5T_NATIVE_INT, &value);
}

void overwrite_attribute(hid_t object, const std::string& name, int value) {
  check(H5Awrite(open_attribute(object, name).get(), H5T_NATIVE_INT, &value),
        "write attribute '" + name + "'");
}

std::string read_text_attribute(hid_t object, const std::string& name) {
  const std::string action = "read attribute '" + name + "' as text";
  const Handle attribute = open_attribute(object, name);
  const Handle type(H5Aget_type(attribute.get()), H5Tclose, action);
  const Handle space(H5Aget_space(attribute.get()), H5Sclose, action);
  if (H5Tget_class(type.get()) != H5T_STRING || H5Sget_simple_extent_npoints(space.get()) != 1) {
    throw Error("cannot " + action);
  }
  if (H5Tis_variable_str(type.get()) > 0) {
    char* raw = nullptr;
    check(H5Aread(attribute.get(), type.get(), &raw), action);
    std::string text = raw == nullptr ? "" : raw;
    H5free_memory(raw);
    return text;
  }
  std::vector<char> raw(H5Tget_size(type.get()) + 1, '\0');
  check(H5Aread(attribute.get(), type.get(), raw.data()), action);
  return raw.data();
}

std::vector<double> read_double_attribute(hid_t object, const std::string& name, std::size_t count) {
  return read_number_attribute<double>(object, name, count, H5T_NATIVE_DOUBLE);
}

std::vector<int> read_int_attribute(hid_t object, const std::string& name, std::size_t count) {
  return read_number_attribute<int>(object, name, count, H5T_NATIVE_INT);
}

std::vector<hsize_t> chunk_of_row(const std::vector<hsize_t>& row, hsize_t number_size, hsize_t limit) {
  std::vector<hsize_t> chunk = row;
  hsize_t bytes = number_size * product(row);
  for (std::size_t d = 0; d < row.size() && bytes >= limit; ++d) {
    const hsize_t layer = std::max<hsize_t>(bytes / row[d], 1);
    const hsize_t most = std::max<hsize_t>((limit - 1) / layer, 1);  // layers in a chunk
    const hsize_t parts = (row[d] + most - 1) / most;
    chunk[d] = (row[d] + parts - 1) / parts;
    bytes = chunk[d] * layer;
  }
  return chunk;
}

Handle create_rows(hid_t parent, const std::string& name, const std::vector<hsize_t>& row, hid_t type,
                   const std::string& units) {
  const std::string action = "create data set '" + name + "'";
  std::vector<hsize_t> now = row, most = row;
  std::vector<hsize_t> chunk = row.empty() ? row : chunk_of_row(row, H5Tget_size(type));
  now.insert(now.begin(), 0);
  most.insert(most.begin(), H5S_UNLIMITED);
  constexpr hsize_t numbers_per_chunk = 256;
  chunk.insert(chunk.begin(), row.empty() ? numbers_per_chunk : 1);

  const Handle space(H5Screate_simple(static_cast<int>(now.size()), now.data(), most.data()), H5Sclose,
                     action);
  const Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, action);
  // Without the time of writing in it, the same input gives the same file to the last bit.
  check(H5Pset_obj_track_times(properties.get(), false), action);
  check(H5Pset_chunk(properties.get(), static_cast<int>(chunk.size()), chunk.data()), action);
  if (!row.empty()) {
    check(H5Pset_shuffle(properties.get()), action);
    check(H5Pset_deflate(properties.get(), 1), action);
  }
  Handle dataset(
      H5Dcreate2(parent, name.c_str(), type, space.get(), H5P_DEFAULT, properties.get(), H5P_DEFAULT),
      H5Dclose, action);
  write_attribute(dataset.get(), "units", units);
  return dataset;
}

void append_row(const Handle& dataset, const double* values) {
  append_raw_row(dataset, H5T_NATIVE_DOUBLE, values);
}

void append_row(const Handle& dataset, long long value) {
  append_raw_row(dataset, H5T_NATIVE_LLONG, &value);
}

void write_array(hid_t parent, const std::string& name, const std::vector<double>& values,
                 const std::vector<hsize_t>& sizes, const std::string& units) {
  write_raw_array(parent, name, H5T_NATIVE_DOUBLE, values.data(), sizes, units);
}

void write_array(hid_t parent, const std::string& name, const std::vector<long long>& values,
                 const std::string& units) {
  write_raw_array(parent, name, H5T_NATIVE_LLONG, values.data(), {values.size()}, units);
}

bool has(hid_t parent, const std::string& name) {
  return H5Lexists(parent, name.c_str(), H5P_DEFAULT) > 0;
}

bool has_attribute(hid_t object, const std::string& name) {
  return H5Aexists(object, name.c_str()) > 0;
}

std::vector<hsize_t> dimensions(hid_t parent, const std::string& name) {
  return extent(dataset_space(open_dataset(parent, name)));
}

std::vector<double> read_row(hid_t parent, const std::string& name, hsize_t index) {
  const Handle dataset = open_dataset(parent, name);
  const Handle file_space = dataset_space(dataset);
  const Handle memory_space = select_row(file_space, index);
  std::vector<double> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(memory_space.get())));
  check(H5Dread(dataset.get(), H5T_NATIVE_DOUBLE, memory_space.get(), file_space.get(), H5P_DEFAULT,
                values.data()),
        "read row " + std::to_string(index) + " of data set '" + name + "'");
  return values;
}

std::vector<double> read_all(hid_t parent, const std::string& name) {
  const Handle dataset = open_dataset(parent, name);
  std::vector<double> values(product(extent(dataset_space(dataset))));
  check(H5Dread(dataset.get(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()),
        "read data set '" + name + "'");
  return values;
}

}  // namespace millfoam::averaging::hdf5
