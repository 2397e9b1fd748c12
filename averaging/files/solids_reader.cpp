// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <sstream>

#include "averaging/files/hdf5_io.hpp"
#include "averaging/files/solids_file.hpp"
#include "averaging/files/solids_layout.hpp"

namespace millfoam::averaging {

namespace {

std::string list(const std::vector<hsize_t>& sizes) {
  std::ostringstream text;
  text << '[';
  for (std::size_t i = 0; i < sizes.size(); ++i) text << (i == 0 ? "" : " ") << sizes[i];
  text << ']';
  return text.str();
}

void check_is_hdf5(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) {
    const std::filesystem::path part = path.string() + ".part";
    throw hdf5::Error(std::filesystem::exists(part)
                          ? "there is no such file, only '" + part.string() + "', which is not complete"
                          : "there is no such file");
  }
  if (H5Fis_hdf5(path.c_str()) <= 0) throw hdf5::Error("this is not an HDF5 file, or it cannot be read");
}

hdf5::Handle open_file(const std::filesystem::path& path) {
  check_is_hdf5(path);
  const hdf5::Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "prepare to open the file");
#if H5_VERSION_GE(1, 10, 7)
  hdf5::check(H5Pset_file_locking(access.get(), 0, 1), "open the file without locks");
#endif
  return {H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.get()), H5Fclose, "open the file"};
}

void check_root(hid_t root) {
  const std::string format = hdf5::read_text_attribute(root, "format");
  if (format != layout::format) {
    throw hdf5::Error("attribute 'format' is '" + format + "', expected '" + layout::format + "'");
  }
  const int version = hdf5::read_int_attribute(root, "version", 1)[0];
  if (version != solids_version) {
    throw hdf5::Error("attribute 'version' is " + std::to_string(version) + ", expected " +
                      std::to_string(solids_version) + "; average again with this millAverage");
  }
  if (hdf5::read_int_attribute(root, "complete", 1)[0] != 1) {
    throw hdf5::Error("the file is not complete: the run that was to write it did not finish");
  }
}

BoxGrid read_grid(hid_t root) {
  const hdf5::Handle group = hdf5::open_group(root, "grid");
  const std::string kind = hdf5::read_text_attribute(group.get(), "kind");
  if (kind != "box") throw hdf5::Error("the grid's kind is '" + kind + "', expected 'box'");
  const auto lower = hdf5::read_double_attribute(group.get(), "lower", 3);
  const auto upper = hdf5::read_double_attribute(group.get(), "upper", 3);
  const auto shape = hdf5::read_int_attribute(group.get(), "shape", 3);
  const auto periodic = hdf5::read_int_attribute(group.get(), "periodic", 3);
  try {
    return {{lower[0], lower[1], lower[2]},
            {upper[0], upper[1], upper[2]},
            {shape[0], shape[1], shape[2]},
            {periodic[0] != 0, periodic[1] != 0, periodic[2] != 0}};
  } catch (const std::invalid_argument& error) {
    throw hdf5::Error(std::string("/grid: ") + error.what());
  }
}

/// Throws unless each window ends after it begins and no window begins before the last one ends.
void check_order(const std::vector<TimeWindow>& windows) {
  for (std::size_t w = 0; w < windows.size(); ++w) {
    const bool finite = std::isfinite(windows[w].begin) && std::isfinite(windows[w].end);
    const bool ordered =
        windows[w].end > windows[w].begin && (w == 0 || windows[w].begin > windows[w - 1].begin);
    if (finite && ordered) continue;
    std::ostringstream message;
    message << "window " << w << " goes from " << windows[w].begin << " to " << windows[w].end
            << " s; expected finite times in rising order";
    throw hdf5::Error(message.str());
  }
}

std::vector<TimeWindow> read_windows(hid_t root) {
  const hdf5::Handle group = hdf5::open_group(root, "window");
  const auto begin = hdf5::read_all(group.get(), "begin");
  const auto end = hdf5::read_all(group.get(), "end");
  const auto records = hdf5::read_all(group.get(), "records");
  if (begin.empty()) throw hdf5::Error("there is no window in it");
  if (end.size() != begin.size() || records.size() != begin.size()) {
    throw hdf5::Error("/window/begin, /window/end and /window/records differ in length");
  }
  std::vector<TimeWindow> windows;
  for (std::size_t w = 0; w < begin.size(); ++w) {
    windows.push_back({begin[w], end[w], std::llround(records[w])});
  }
  check_order(windows);
  return windows;
}

void check_shapes(hid_t root, const BoxGrid& grid, std::size_t windows) {
  const auto [nx, ny, nz] = grid.shape();
  for (const layout::Field& field : layout::fields) {
    std::vector<hsize_t> expected{windows, static_cast<hsize_t>(nz), static_cast<hsize_t>(ny),
                                  static_cast<hsize_t>(nx)};
    if (field.vector) expected.push_back(3);
    const std::vector<hsize_t> found = hdf5::dimensions(root, field.name);
    if (found == expected) continue;
    throw hdf5::Error(std::string("data set '") + field.name + "' has the shape " + list(found) +
                      ", expected " + list(expected));
  }
}

/// Throws for the first entry n of `values` that `allowed(n)` refuses; says where it is.
template <typename Allowed>
void check_values(const BoxGrid& grid, const char* name, std::size_t window,
                  const std::vector<double>& values, const char* expected, Allowed allowed) {
  for (std::size_t n = 0; n < values.size(); ++n) {
    if (allowed(n)) continue;
    const std::size_t voxel = n / (values.size() / grid.size());
    const auto nx = static_cast<std::size_t>(grid.shape()[0]);
    const auto ny = static_cast<std::size_t>(grid.shape()[1]);
    std::ostringstream message;
    message << name << " is " << values[n] << " in voxel (" << voxel % nx << ' ' << voxel / nx % ny << ' '
            << voxel / (nx * ny) << ") of window " << window << ", expected " << expected;
    throw hdf5::Error(message.str());
  }
}

void check_window(const BoxGrid& grid, std::size_t number, const SolidsWindow& window) {
  check_values(grid, "solidity", number, window.solidity,
               "0 <= solidity < 1 (are the voxels smaller than the balls?)",
               [&](std::size_t n) { return window.solidity[n] >= 0 && window.solidity[n] < 1; });
  check_values(grid, "velocity", number, window.velocity, "a finite number",
               [&](std::size_t n) { return std::isfinite(window.velocity[n]); });
  const auto is_diameter = [&](const std::vector<double>& d) {
    return [&](std::size_t n) {
      return std::isfinite(d[n]) && (d[n] > 0 || (d[n] == 0 && window.solidity[n] == 0));
    };
  };
  const char* expected = "a finite number, above 0 where there are solids";
  check_values(grid, "diameter", number, window.diameter, expected, is_diameter(window.diameter));
  check_values(grid, "diameter43", number, window.diameter43, expected, is_diameter(window.diameter43));
}

}  // namespace

struct SolidsReader::Open {
  hdf5::Handle file;
  SolidsHeader header;
  BoxGrid grid;
  std::vector<TimeWindow> windows;

  explicit Open(const std::filesystem::path& path)
      : file(open_file(path)),
        header(read_header()),
        grid(read_grid(file.get())),
        windows(read_windows(file.get())) {
    check_shapes(file.get(), grid, windows.size());
  }

  SolidsHeader read_header() const {
    check_root(file.get());
    SolidsHeader found;
    found.time0 = hdf5::read_double_attribute(file.get(), "time0", 1)[0];
    found.timestep = hdf5::read_double_attribute(file.get(), "timestep", 1)[0];
    found.whole_run = hdf5::read_int_attribute(file.get(), "whole_run", 1)[0] != 0;
    return found;
  }
};

SolidsReader::SolidsReader(const std::filesystem::path& path) : path_(path) {
  hdf5::naming_file<SolidsFileError>(path_, [&] { open_ = std::make_unique<Open>(path_); });
}

SolidsReader::~SolidsReader() = default;
SolidsReader::SolidsReader(SolidsReader&&) noexcept = default;
SolidsReader& SolidsReader::operator=(SolidsReader&&) noexcept = default;

const BoxGrid& SolidsReader::grid() const {
  return open_->grid;
}
const std::vector<TimeWindow>& SolidsReader::windows() const {
  return open_->windows;
}
double SolidsReader::time0() const {
  return open_->header.time0;
}
double SolidsReader::timestep() const {
  return open_->header.timestep;
}
bool SolidsReader::whole_run() const {
  return open_->header.whole_run;
}

SolidsWindow SolidsReader::read_window(std::size_t number) const {
  return hdf5::naming_file<SolidsFileError>(path_, [&] {
    if (number >= open_->windows.size()) {
      throw hdf5::Error("there is no window " + std::to_string(number) + ", only " +
                        std::to_string(open_->windows.size()));
    }
    const hid_t file = open_->file.get();
    SolidsWindow window{hdf5::read_row(file, "solidity", number), hdf5::read_row(file, "velocity", number),
                        hdf5::read_row(file, "diameter", number), hdf5::read_row(file, "diameter43", number)};
    check_window(open_->grid, number, window);
    return window;
  });
}

}  // namespace millfoam::averaging
