// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/files/grid_io.hpp"
#include "averaging/files/hdf5_file.hpp"
#include "averaging/files/hdf5_io.hpp"
#include "averaging/files/solids_file.hpp"
#include "averaging/files/solids_layout.hpp"

namespace millfoam::averaging {

namespace {

std::vector<hsize_t> row_dimensions(const Grid& grid, bool vector) {
  const std::vector<std::size_t> shape = field_shape(grid);
  std::vector<hsize_t> row(shape.begin(), shape.end());
  if (vector) row.push_back(3);
  return row;
}

hdf5::Handle create_field(hid_t parent, const Grid& grid, const layout::Field& field) {
  return hdf5::create_rows(parent, field.name, row_dimensions(grid, field.vector), H5T_NATIVE_DOUBLE,
                           field.units);
}

int version_of(const Grid& grid) {
  const auto* cylinder = std::get_if<CylinderGrid>(&grid);
  return cylinder != nullptr && cylinder->frame().cylindrical ? cylindrical_solids_version : solids_version;
}

void write_known(hid_t root, const char* name, const std::string& text) {
  if (!text.empty()) hdf5::write_attribute(root, name, text);
}

}  // namespace

struct SolidsWriter::Open {
  hdf5::Handle file;
  std::vector<hdf5::Handle> fields;
  std::vector<hdf5::Handle> inside_fraction;  ///< one where walls cut the cells, none otherwise
  std::vector<hdf5::Handle> ledger;
  std::vector<hdf5::Handle> times;
  std::size_t windows = 0;

  Open(const std::filesystem::path& part, const Grid& grid, const SolidsHeader& header)
      : file(hdf5::create_file(part)) {
    write_root(header, version_of(grid));
    const hdf5::Handle grid_group = hdf5::create_group(file.get(), "grid");
    hdf5::write_grid(grid_group.get(), grid);
    if (header.inside_fractions) {
      inside_fraction.push_back(create_field(grid_group.get(), grid, layout::inside_fraction));
    }
    create_windows();
    for (const layout::Field& field : layout::fields) {
      fields.push_back(create_field(file.get(), grid, field));
    }
    const hdf5::Handle group = hdf5::create_group(file.get(), "ledger");
    for (const layout::LedgerColumn& column : layout::ledger) {
      ledger.push_back(hdf5::create_rows(group.get(), column.name, {}, H5T_NATIVE_DOUBLE, "m3"));
    }
  }

  void write_root(const SolidsHeader& header, int version) const {
    const hid_t root = file.get();
    hdf5::write_attribute(root, "format", std::string(layout::format));
    hdf5::write_attribute(root, "version", version);
    hdf5::write_attribute(root, "complete", 0);
    hdf5::write_attribute(root, "time0", header.time0);
    hdf5::write_attribute(root, "timestep", header.timestep);
    hdf5::write_attribute(root, "whole_run", header.whole_run ? 1 : 0);
    hdf5::write_attribute(root, "method", header.method);
    hdf5::write_attribute(root, "smoothing", header.smoothing);
    if (header.angular_velocity) {
      hdf5::write_attribute(root, "angular_velocity", *header.angular_velocity);
    }
    if (header.solidity_cap) hdf5::write_attribute(root, "solidity_cap", *header.solidity_cap);
    if (header.walls_over_grid) hdf5::write_attribute(root, "walls_over_grid", *header.walls_over_grid);
    write_known(root, "program", header.program);
    write_known(root, "mill_charge", header.mill_charge);
    write_known(root, "mill_averages", header.mill_averages);
    write_known(root, "run_id", header.run_id);
    if (header.fines_share) hdf5::write_attribute(root, "fines_share", *header.fines_share);
  }

  void create_windows() {
    const hdf5::Handle group = hdf5::create_group(file.get(), "window");
    times.push_back(hdf5::create_rows(group.get(), "begin", {}, H5T_NATIVE_DOUBLE, "s"));
    times.push_back(hdf5::create_rows(group.get(), "end", {}, H5T_NATIVE_DOUBLE, "s"));
    for (const char* name : {"records", "starts_late", "ends_short"}) {
      times.push_back(hdf5::create_rows(group.get(), name, {}, H5T_NATIVE_LLONG, "1"));
    }
    times.push_back(hdf5::create_rows(group.get(), "balls_per_cell", {}, H5T_NATIVE_DOUBLE, "1"));
    times.push_back(hdf5::create_rows(group.get(), "expected", {}, H5T_NATIVE_LLONG, "1"));
  }

  void append(const WindowAverage& window) {
    for (std::size_t f = 0; f < fields.size(); ++f) {
      hdf5::append_row(fields[f], layout::fields[f].of(window).data());
    }
    for (const hdf5::Handle& data : inside_fraction) {
      hdf5::append_row(data, window.mean.inside_fraction.data());
    }
    for (std::size_t c = 0; c < ledger.size(); ++c) {
      hdf5::append_row(ledger[c], &(window.ledger.*layout::ledger[c].value));
    }
    hdf5::append_row(times[0], &window.time.begin);
    hdf5::append_row(times[1], &window.time.end);
    hdf5::append_row(times[2], window.time.records);
    hdf5::append_row(times[3], window.time.starts_late ? 1LL : 0LL);
    hdf5::append_row(times[4], window.time.ends_short ? 1LL : 0LL);
    hdf5::append_row(times[5], &window.balls_per_cell);
    hdf5::append_row(times[6], window.time.expected);
    hdf5::flush(file.get());
    ++windows;
  }

  void finish() {
    hdf5::flush(file.get());
    hdf5::overwrite_attribute(file.get(), "complete", 1);
    hdf5::flush(file.get());
    fields.clear();
    inside_fraction.clear();
    ledger.clear();
    times.clear();
    file.close("close the file");
  }
};

SolidsWriter::SolidsWriter(const std::filesystem::path& path, const Grid& grid, const SolidsHeader& header)
    : path_(path), part_(path.string() + ".part"), cells_(cell_count(grid)) {
  hdf5::naming_file<SolidsFileError>(part_, [&] { open_ = std::make_unique<Open>(part_, grid, header); });
}

SolidsWriter::~SolidsWriter() {
  const hdf5::QuietErrors quiet;
  open_.reset();
}

void SolidsWriter::append(const WindowAverage& window) {
  const auto check_size = [&](const layout::Field& field) {
    const std::size_t expected = cells_ * (field.vector ? 3 : 1);
    if (field.of(window).size() == expected) return;
    throw SolidsFileError(part_.string() + ": " + field.name + " has " +
                          std::to_string(field.of(window).size()) + " values, the grid needs " +
                          std::to_string(expected));
  };
  for (const layout::Field& field : layout::fields) check_size(field);
  if (!open_->inside_fraction.empty()) check_size(layout::inside_fraction);
  hdf5::naming_file<SolidsFileError>(part_, [&] { open_->append(window); });
}

void SolidsWriter::finish() {
  if (open_->windows == 0) throw SolidsFileError(part_.string() + ": no window was written");
  hdf5::naming_file<SolidsFileError>(part_, [&] {
    open_->finish();
    hdf5::rename_file(part_, path_);
  });
}

}  // namespace millfoam::averaging
