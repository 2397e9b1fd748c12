// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/files/hdf5_io.hpp"
#include "averaging/files/solids_file.hpp"
#include "averaging/files/solids_layout.hpp"

namespace millfoam::averaging {

namespace {

hdf5::Handle create_file(const std::filesystem::path& path) {
  return {H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose,
          "create the file (is the folder there and writable?)"};
}

std::vector<int> as_ints(const std::array<bool, 3>& flags) {
  return {flags[0], flags[1], flags[2]};
}

std::vector<hsize_t> row_dimensions(const BoxGrid& grid, bool vector) {
  std::vector<hsize_t> row;
  for (std::size_t a = 3; a-- > 0;) row.push_back(static_cast<hsize_t>(grid.shape()[a]));
  if (vector) row.push_back(3);
  return row;
}

}  // namespace

struct SolidsWriter::Open {
  hdf5::Handle file;
  std::vector<hdf5::Handle> fields;
  std::vector<hdf5::Handle> ledger;
  std::vector<hdf5::Handle> times;
  std::size_t windows = 0;

  Open(const std::filesystem::path& part, const BoxGrid& grid, const SolidsHeader& header)
      : file(create_file(part)) {
    write_root(header);
    write_grid(grid);
    create_windows();
    for (const layout::Field& field : layout::fields) {
      fields.push_back(hdf5::create_rows(file.get(), field.name, row_dimensions(grid, field.vector),
                                         H5T_NATIVE_DOUBLE, field.units));
    }
    const hdf5::Handle group = hdf5::create_group(file.get(), "ledger");
    for (const layout::LedgerColumn& column : layout::ledger) {
      ledger.push_back(hdf5::create_rows(group.get(), column.name, {}, H5T_NATIVE_DOUBLE, "m3"));
    }
  }

  void write_root(const SolidsHeader& header) const {
    const hid_t root = file.get();
    hdf5::write_attribute(root, "format", std::string(layout::format));
    hdf5::write_attribute(root, "version", solids_version);
    hdf5::write_attribute(root, "complete", 0);
    hdf5::write_attribute(root, "time0", header.time0);
    hdf5::write_attribute(root, "timestep", header.timestep);
    hdf5::write_attribute(root, "whole_run", header.whole_run ? 1 : 0);
  }

  void write_grid(const BoxGrid& grid) const {
    const hdf5::Handle group = hdf5::create_group(file.get(), "grid");
    hdf5::write_attribute(group.get(), "kind", std::string("box"));
    hdf5::write_attribute(group.get(), "lower",
                          std::vector<double>(grid.lower().begin(), grid.lower().end()));
    hdf5::write_attribute(group.get(), "upper",
                          std::vector<double>(grid.upper().begin(), grid.upper().end()));
    hdf5::write_attribute(group.get(), "shape", std::vector<int>(grid.shape().begin(), grid.shape().end()));
    hdf5::write_attribute(group.get(), "periodic", as_ints(grid.periodic()));
  }

  void create_windows() {
    const hdf5::Handle group = hdf5::create_group(file.get(), "window");
    times.push_back(hdf5::create_rows(group.get(), "begin", {}, H5T_NATIVE_DOUBLE, "s"));
    times.push_back(hdf5::create_rows(group.get(), "end", {}, H5T_NATIVE_DOUBLE, "s"));
    times.push_back(hdf5::create_rows(group.get(), "records", {}, H5T_NATIVE_LLONG, "1"));
  }

  void append(const WindowAverage& window) {
    for (std::size_t f = 0; f < fields.size(); ++f) {
      hdf5::append_row(fields[f], layout::fields[f].of(window).data());
    }
    for (std::size_t c = 0; c < ledger.size(); ++c) {
      hdf5::append_row(ledger[c], &(window.ledger.*layout::ledger[c].value));
    }
    hdf5::append_row(times[0], &window.time.begin);
    hdf5::append_row(times[1], &window.time.end);
    hdf5::append_row(times[2], window.time.records);
    flush();
    ++windows;
  }

  void flush() const { hdf5::check(H5Fflush(file.get(), H5F_SCOPE_GLOBAL), "write to disk (is it full?)"); }

  void finish() {
    flush();
    hdf5::overwrite_attribute(file.get(), "complete", 1);
    flush();
    fields.clear();
    ledger.clear();
    times.clear();
    file.close("close the file");
  }
};

SolidsWriter::SolidsWriter(const std::filesystem::path& path, const BoxGrid& grid, const SolidsHeader& header)
    : path_(path), part_(path.string() + ".part"), cells_(grid.size()) {
  // Where a full disk kept a file from being flushed, HDF5 1.10's handler at exit crashes on what is left of
  // it. All that is opened here is closed by its handle, so that the handler has no work.
  H5dont_atexit();
  hdf5::naming_file<SolidsFileError>(part_, [&] { open_ = std::make_unique<Open>(part_, grid, header); });
}

SolidsWriter::~SolidsWriter() {
  const hdf5::QuietErrors quiet;
  open_.reset();
}

void SolidsWriter::append(const WindowAverage& window) {
  for (const layout::Field& field : layout::fields) {
    const std::size_t expected = cells_ * (field.vector ? 3 : 1);
    if (field.of(window).size() != expected) {
      throw SolidsFileError(part_.string() + ": " + field.name + " has " +
                            std::to_string(field.of(window).size()) + " values, the grid needs " +
                            std::to_string(expected));
    }
  }
  hdf5::naming_file<SolidsFileError>(part_, [&] { open_->append(window); });
}

void SolidsWriter::finish() {
  if (open_->windows == 0) throw SolidsFileError(part_.string() + ": no window was written");
  hdf5::naming_file<SolidsFileError>(part_, [&] { open_->finish(); });
  std::error_code failure;
  std::filesystem::rename(part_, path_, failure);
  if (failure) {
    throw SolidsFileError(part_.string() + ": cannot rename it to '" + path_.string() +
                          "': " + failure.message());
  }
}

}  // namespace millfoam::averaging
