// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/files/hdf5_arrays.hpp"

#include <algorithm>
#include <limits>

namespace millfoam::averaging::hdf5 {

namespace {

Handle create_array(hid_t parent, const std::string& name, hsize_t count, hid_t type) {
  const std::string action = "create data set '" + name + "'";
  const Handle space(H5Screate_simple(1, &count, nullptr), H5Sclose, action);
  const Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, action);
  check(H5Pset_obj_track_times(properties.get(), false), action);
  if (count > 0) {
    constexpr hsize_t numbers_per_chunk = 1 << 20;
    const hsize_t chunk = std::min(count, numbers_per_chunk);
    check(H5Pset_chunk(properties.get(), 1, &chunk), action);
    check(H5Pset_shuffle(properties.get()), action);
    check(H5Pset_deflate(properties.get(), 1), action);
  }
  return {H5Dcreate2(parent, name.c_str(), type, space.get(), H5P_DEFAULT, properties.get(), H5P_DEFAULT),
          H5Dclose, action};
}

Handle open_array(hid_t parent, const std::string& name) {
  return {H5Dopen2(parent, name.c_str(), H5P_DEFAULT), H5Dclose, "find data set '" + name + "'"};
}

std::size_t length(const Handle& dataset, const std::string& name) {
  const Handle space(H5Dget_space(dataset.get()), H5Sclose, "read the length of data set '" + name + "'");
  if (H5Sget_simple_extent_ndims(space.get()) != 1) {
    throw Error("data set '" + name + "' should have one dimension");
  }
  return static_cast<std::size_t>(H5Sget_simple_extent_npoints(space.get()));
}

Handle text_type(std::size_t size) {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "make a type for texts");
  check(H5Tset_size(type.get(), size), "make a type for texts");
  check(H5Tset_strpad(type.get(), H5T_STR_NULLPAD), "make a type for texts");
  return type;
}

}  // namespace

void write_array(hid_t parent, const std::string& name, const std::vector<int>& values) {
  const Handle dataset = create_array(parent, name, values.size(), H5T_NATIVE_INT);
  if (values.empty()) return;
  check(H5Dwrite(dataset.get(), H5T_NATIVE_INT, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()),
        "write data set '" + name + "' (is the disk full?)");
}

void write_array(hid_t parent, const std::string& name, const std::vector<std::string>& texts) {
  std::size_t size = 1;
  for (const std::string& text : texts) size = std::max(size, text.size());
  std::vector<char> padded(size * texts.size(), '\0');
  for (std::size_t i = 0; i < texts.size(); ++i) {
    std::copy(texts[i].begin(), texts[i].end(), padded.begin() + static_cast<std::ptrdiff_t>(i * size));
  }
  const Handle type = text_type(size);
  const Handle dataset = create_array(parent, name, texts.size(), type.get());
  if (texts.empty()) return;
  check(H5Dwrite(dataset.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, padded.data()),
        "write data set '" + name + "' (is the disk full?)");
}

std::vector<int> read_ints(hid_t parent, const std::string& name) {
  const Handle dataset = open_array(parent, name);
  const Handle type(H5Dget_type(dataset.get()), H5Tclose, "read the type of data set '" + name + "'");
  if (H5Tget_class(type.get()) != H5T_INTEGER) {
    throw Error("data set '" + name + "' should hold whole numbers");
  }
  std::vector<long long> wide(length(dataset, name));
  if (wide.empty()) return {};
  check(H5Dread(dataset.get(), H5T_NATIVE_LLONG, H5S_ALL, H5S_ALL, H5P_DEFAULT, wide.data()),
        "read data set '" + name + "'");
  std::vector<int> values;
  values.reserve(wide.size());
  for (const long long value : wide) {
    if (value < std::numeric_limits<int>::min() || value > std::numeric_limits<int>::max()) {
      throw Error("data set '" + name + "' holds " + std::to_string(value) + ", which is too large");
    }
    values.push_back(static_cast<int>(value));
  }
  return values;
}

std::vector<std::string> read_texts(hid_t parent, const std::string& name) {
  const Handle dataset = open_array(parent, name);
  const Handle stored(H5Dget_type(dataset.get()), H5Tclose, "read the type of data set '" + name + "'");
  if (H5Tget_class(stored.get()) != H5T_STRING || H5Tis_variable_str(stored.get()) != 0) {
    throw Error("data set '" + name + "' should hold texts of fixed length");
  }
  const std::size_t size = H5Tget_size(stored.get()), count = length(dataset, name);
  if (count == 0) return {};
  std::vector<char> padded(size * count);
  check(H5Dread(dataset.get(), stored.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, padded.data()),
        "read data set '" + name + "'");
  std::vector<std::string> texts;
  for (auto text = padded.begin(); text != padded.end(); text += static_cast<std::ptrdiff_t>(size)) {
    texts.emplace_back(text, std::find(text, text + static_cast<std::ptrdiff_t>(size), '\0'));
  }
  return texts;
}

}  // namespace millfoam::averaging::hdf5
