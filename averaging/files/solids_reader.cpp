// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <sstream>

#include "averaging/files/grid_io.hpp"
#include "averaging/files/hdf5_file.hpp"
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

Grid read_grid(hid_t root) {
  return hdf5::read_grid(hdf5::open_group(root, "grid").get());
}

/// Throws unless each window ends after it begins and windows begin one after the other.
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
  const auto late = hdf5::read_all(group.get(), "starts_late");
  const auto cut = hdf5::read_all(group.get(), "ends_short");
  // Files of millFoam before 0.3 lack it
  const std::vector<double> expected = hdf5::has(group.get(), "expected")
                                           ? hdf5::read_all(group.get(), "expected")
                                           : std::vector<double>(begin.size(), 0.0);
  if (begin.empty()) throw hdf5::Error("there is no window in it");
  for (const auto* other : {&end, &records, &late, &cut, &expected}) {
    if (other->size() != begin.size()) throw hdf5::Error("the data sets of /window differ in length");
  }
  std::vector<TimeWindow> windows;
  for (std::size_t w = 0; w < begin.size(); ++w) {
    windows.push_back(
        {begin[w], end[w], std::llround(records[w]), late[w] != 0, cut[w] != 0, std::llround(expected[w])});
  }
  check_order(windows);
  return windows;
}

void check_shape(hid_t parent, const Grid& grid, std::size_t windows, const layout::Field& field) {
  std::vector<hsize_t> expected{windows};
  for (const std::size_t size : field_shape(grid)) expected.push_back(size);
  if (field.vector) expected.push_back(3);
  const std::vector<hsize_t> found = hdf5::dimensions(parent, field.name);
  if (found == expected) return;
  throw hdf5::Error(std::string("data set '") + field.name + "' has the shape " + list(found) +
                    ", expected " + list(expected));
}

/// Throws for the first entry n of `values` that `allowed(n)` refuses; says where it is.
template <typename Allowed>
void check_values(const Grid& grid, const char* name, std::size_t window, const std::vector<double>& values,
                  const char* expected, Allowed allowed) {
  for (std::size_t n = 0; n < values.size(); ++n) {
    if (allowed(n)) continue;
    const std::size_t cell = n / (values.size() / cell_count(grid));
    std::ostringstream message;
    message << name << " is " << values[n] << " in " << cell_name(grid, cell) << " of window " << window
            << ", expected " << expected;
    throw hdf5::Error(message.str());
  }
}

void check_window(const Grid& grid, std::size_t number, const SolidsWindow& window) {
  check_values(grid, "solidity", number, window.solidity,
               "0 <= solidity < 1 (are the cells smaller than the balls?)",
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
  check_values(grid, "insideFraction", number, window.inside_fraction, "0 to 1", [&](std::size_t n) {
    return window.inside_fraction[n] >= 0 && window.inside_fraction[n] <= 1;
  });
}

}  // namespace

struct SolidsReader::Open {
  hdf5::Handle file;
  SolidsHeader header;
  Grid grid;
  std::vector<TimeWindow> windows;

  explicit Open(const std::filesystem::path& path)
      : file(hdf5::open_file(path, "millAverage")),
        header(read_header()),
        grid(read_grid(file.get())),
        windows(read_windows(file.get())) {
    for (const layout::Field& field : layout::fields) {
      check_shape(file.get(), grid, windows.size(), field);
    }
    const hdf5::Handle group = hdf5::open_group(file.get(), "grid");
    header.inside_fractions = hdf5::has(group.get(), layout::inside_fraction.name);
    if (header.inside_fractions) check_shape(group.get(), grid, windows.size(), layout::inside_fraction);
  }

  SolidsHeader read_header() const {
    hdf5::check_format(file.get(), layout::format, {solids_version, cylindrical_solids_version},
                       "average again with this millAverage");
    SolidsHeader found;
    found.time0 = hdf5::read_double_attribute(file.get(), "time0", 1)[0];
    found.timestep = hdf5::read_double_attribute(file.get(), "timestep", 1)[0];
    found.whole_run = hdf5::read_int_attribute(file.get(), "whole_run", 1)[0] != 0;
    found.method = hdf5::read_text_attribute(file.get(), "method");
    found.smoothing = hdf5::read_double_attribute(file.get(), "smoothing", 1)[0];
    found.angular_velocity = read_optional("angular_velocity");
    found.solidity_cap = read_optional("solidity_cap");
    found.program = read_known("program");
    found.mill_charge = read_known("mill_charge");
    found.mill_averages = read_known("mill_averages");
    found.run_id = read_known("run_id");
    found.fines_share = read_optional("fines_share");
    found.walls_over_grid = read_optional("walls_over_grid");
    return found;
  }

  std::string read_known(const char* name) const {
    return hdf5::has_attribute(file.get(), name) ? hdf5::read_text_attribute(file.get(), name)
                                                 : std::string();
  }

  std::optional<double> read_optional(const char* name) const {
    if (!hdf5::has_attribute(file.get(), name)) return std::nullopt;
    return hdf5::read_double_attribute(file.get(), name, 1)[0];
  }
};

SolidsReader::SolidsReader(const std::filesystem::path& path) : path_(path) {
  hdf5::naming_file<SolidsFileError>(path_, [&] { open_ = std::make_unique<Open>(path_); });
}

SolidsReader::~SolidsReader() = default;
SolidsReader::SolidsReader(SolidsReader&&) noexcept = default;
SolidsReader& SolidsReader::operator=(SolidsReader&&) noexcept = default;

const Grid& SolidsReader::grid() const {
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
const SolidsHeader& SolidsReader::header() const {
  return open_->header;
}

SolidsWindow SolidsReader::read_window(std::size_t number) const {
  SolidsWindow window = read_unchecked(number);
  hdf5::naming_file<SolidsFileError>(path_, [&] { check_window(open_->grid, number, window); });
  return window;
}

SolidsWindow SolidsReader::read_unchecked(std::size_t number) const {
  return hdf5::naming_file<SolidsFileError>(path_, [&] {
    if (number >= open_->windows.size()) {
      throw hdf5::Error("there is no window " + std::to_string(number) + ", only " +
                        std::to_string(open_->windows.size()));
    }
    const hid_t file = open_->file.get();
    SolidsWindow window{hdf5::read_row(file, "solidity", number),
                        hdf5::read_row(file, "velocity", number),
                        hdf5::read_row(file, "diameter", number),
                        hdf5::read_row(file, "diameter43", number),
                        {}};
    if (open_->header.inside_fractions) {
      const hdf5::Handle group = hdf5::open_group(file, "grid");
      window.inside_fraction = hdf5::read_row(group.get(), layout::inside_fraction.name, number);
    }
    return window;
  });
}

std::vector<Ledger> SolidsReader::read_ledgers() const {
  return hdf5::naming_file<SolidsFileError>(path_, [&] {
    const hdf5::Handle group = hdf5::open_group(open_->file.get(), "ledger");
    std::vector<Ledger> ledgers(open_->windows.size());
    for (const layout::LedgerColumn& column : layout::ledger) {
      const std::vector<double> values = hdf5::read_all(group.get(), column.name);
      if (values.size() != ledgers.size()) {
        throw hdf5::Error(std::string("/ledger/") + column.name + " has " + std::to_string(values.size()) +
                          " values, expected one for each window");
      }
      for (std::size_t w = 0; w < ledgers.size(); ++w) ledgers[w].*column.value = values[w];
    }
    return ledgers;
  });
}

std::vector<double> SolidsReader::read_balls_per_cell() const {
  return hdf5::naming_file<SolidsFileError>(path_, [&] {
    std::vector<double> values =
        hdf5::read_all(hdf5::open_group(open_->file.get(), "window").get(), "balls_per_cell");
    if (values.size() != open_->windows.size()) {
      throw hdf5::Error("/window/balls_per_cell has " + std::to_string(values.size()) +
                        " values, expected one for each window");
    }
    return values;
  });
}

}  // namespace millfoam::averaging
