// SPDX-License-Identifier: GPL-3.0-or-later
#include "slurry_writer.hpp"

#include <map>

#include "averaging/files/grid_io.hpp"
#include "averaging/files/hdf5_file.hpp"
#include "averaging/files/hdf5_io.hpp"

namespace millfoam::dem_driver::tests {

namespace hdf5 = averaging::hdf5;

namespace {

/// Values of all voxels by the names of data sets.
std::map<std::string, std::vector<double>> sample(const averaging::BoxGrid& grid,
                                                  const std::function<FlowAtPoint(const Vector&)>& flow) {
  std::map<std::string, std::vector<double>> fields;
  const auto [nx, ny, nz] = grid.shape();
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) {
        const FlowAtPoint at = flow(grid.centre({i, j, k}));
        fields["insideFraction"].push_back(at.inside);
        fields["exchange"].push_back(at.exchange);
        fields["solidity"].push_back(at.solidity);
        fields["diameter"].push_back(at.diameter);
        for (const double v : at.pressure_force) fields["pressure_force"].push_back(v);
        for (const double v : at.drag_force) fields["drag_force"].push_back(v);
      }
  return fields;
}

std::vector<hsize_t> row(const averaging::BoxGrid& grid, const std::string& name) {
  const auto [nx, ny, nz] = grid.shape();
  std::vector<hsize_t> sizes{static_cast<hsize_t>(nz), static_cast<hsize_t>(ny), static_cast<hsize_t>(nx)};
  if (name.find("_force") != std::string::npos) sizes.push_back(3);
  return sizes;
}

void write_times(hid_t root, std::size_t windows) {
  const hdf5::Handle group = hdf5::create_group(root, "window");
  std::vector<double> begin, end;
  for (std::size_t i = 0; i < windows; ++i) {
    begin.push_back(static_cast<double>(i));
    end.push_back(static_cast<double>(i + 1));
  }
  hdf5::write_array(group.get(), "begin", begin, {windows}, "s");
  hdf5::write_array(group.get(), "end", end, {windows}, "s");
}

void write_windows(hid_t root, hid_t grid_group, hid_t balls, const SlurryContent& content) {
  write_times(root, content.windows.size());
  std::map<std::string, hdf5::Handle> sets;
  for (const auto& window : content.windows)
    for (const auto& [name, values] : sample(content.grid, window)) {
      const hid_t parent = name == "insideFraction" ? grid_group : balls;
      if (sets.count(name) == 0)
        sets.emplace(name, hdf5::create_rows(parent, name, row(content.grid, name), H5T_NATIVE_DOUBLE, "SI"));
      hdf5::append_row(sets.at(name), values.data());
    }
}

void write_mean(hid_t root, const SlurryContent& content) {
  const hdf5::Handle mean = hdf5::create_group(root, "mean");
  hdf5::write_attribute(mean.get(), "begin", 0.0);
  hdf5::write_attribute(mean.get(), "end", 1.0);
  const hdf5::Handle balls = hdf5::create_group(mean.get(), "balls");
  for (const auto& [name, values] : sample(content.grid, content.mean))
    hdf5::write_array(name == "insideFraction" ? mean.get() : balls.get(), name, values,
                      row(content.grid, name), "SI");
}

}  // namespace

void write_slurry(const std::filesystem::path& path, const SlurryContent& content) {
  const hdf5::Handle file = hdf5::create_file(path);
  const hid_t root = file.get();
  hdf5::write_attribute(root, "format", std::string("millfoam-slurry"));
  hdf5::write_attribute(root, "version", content.version);
  hdf5::write_attribute(root, "complete", content.complete);
  if (!content.mill_flow.empty()) hdf5::write_attribute(root, "mill_flow", content.mill_flow);
  const hdf5::Handle grid = hdf5::create_group(root, "grid");
  hdf5::write_grid(grid.get(), content.grid);
  if (!content.balls) return;
  const hdf5::Handle balls = hdf5::create_group(root, "balls");
  hdf5::write_attribute(balls.get(), "law", std::string("Beetstra"));
  hdf5::write_attribute(balls.get(), "polydispersity", content.polydispersity ? 1 : 0);
  hdf5::write_attribute(balls.get(), "slurry_density", 1000.0);
  write_windows(root, grid.get(), balls.get(), content);
  if (content.mean) write_mean(root, content);
}

}  // namespace millfoam::dem_driver::tests
