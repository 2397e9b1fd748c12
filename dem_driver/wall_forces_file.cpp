// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/wall_forces_file.hpp"

#include <functional>
#include <ostream>
#include <string>
#include <vector>

namespace millfoam::dem_driver {

namespace {

constexpr int digits = 8;

/// One field of the cells; `write` writes the numbers of a cell.
void write_field(std::ostream& out, const char* type, const std::string& name, int components,
                 std::size_t cells, const std::function<void(std::size_t)>& write) {
  out << "<DataArray type=\"" << type << "\" Name=\"" << name << "\" NumberOfComponents=\"" << components
      << "\" format=\"ascii\">\n";
  for (std::size_t cell = 0; cell < cells; ++cell) {
    write(cell);
    out << '\n';
  }
  out << "</DataArray>\n";
}

void write_geometry(std::ostream& out, const std::vector<Triangle>& corners) {
  const std::size_t cells = corners.size();
  out << "<Points>\n";
  write_field(out, "Float64", "Points", 3, 3 * cells, [&](std::size_t point) {
    const auto& at = corners[point / 3][point % 3];
    out << at[0] << ' ' << at[1] << ' ' << at[2];
  });
  out << "</Points>\n<Polys>\n";
  write_field(out, "Int64", "connectivity", 1, cells,
              [&](std::size_t cell) { out << 3 * cell << ' ' << 3 * cell + 1 << ' ' << 3 * cell + 2; });
  write_field(out, "Int64", "offsets", 1, cells, [&](std::size_t cell) { out << 3 * cell + 3; });
  out << "</Polys>\n";
}

}  // namespace

void write_wall_forces(std::ostream& out, const WallCells& cells, const WallSums& sums, long begin, long end,
                       double timestep) {
  const std::vector<Triangle> corners = cells.corners();
  const std::vector<int> parts = cells.part_of_cells();
  const auto steps = static_cast<double>(end - begin);
  const double time = steps * timestep;
  out.precision(digits);
  out << "<?xml version=\"1.0\"?>\n<!-- parts:";
  for (const auto& part : cells.parts()) out << ' ' << part.name;
  out << "; DEM time " << static_cast<double>(begin) * timestep << " to "
      << static_cast<double>(end) * timestep
      << " s -->\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\">\n<PolyData>\n"
      << "<Piece NumberOfPoints=\"" << 3 * cells.size() << "\" NumberOfPolys=\"" << cells.size() << "\">\n";
  write_geometry(out, corners);
  out << "<CellData Scalars=\"normal_stress_Pa\" Vectors=\"force_N\">\n";
  const auto field = [&](const char* name, const std::function<double(const WallCellSums&, double)>& value) {
    write_field(out, "Float64", name, 1, cells.size(),
                [&](std::size_t cell) { out << value(sums.of(cell), area_of(corners[cell])); });
  };
  write_field(out, "Int32", "part", 1, cells.size(), [&](std::size_t cell) { out << parts[cell]; });
  field("contacts", [&](const WallCellSums& s, double) { return s.contacts / steps; });
  field("normal_force_N", [&](const WallCellSums& s, double) { return s.push / steps; });
  field("tangential_force_N", [&](const WallCellSums& s, double) { return s.shear / steps; });
  field("normal_stress_Pa", [&](const WallCellSums& s, double area) { return s.push / steps / area; });
  field("tangential_stress_Pa", [&](const WallCellSums& s, double area) { return s.shear / steps / area; });
  field("impact_power_W_m2", [&](const WallCellSums& s, double area) { return s.normal_work / time / area; });
  field("sliding_power_W_m2",
        [&](const WallCellSums& s, double area) { return s.tangential_work / time / area; });
  write_field(out, "Float64", "force_N", 3, cells.size(), [&](std::size_t cell) {
    const auto force = sums.of(cell).force;
    out << force[0] / steps << ' ' << force[1] / steps << ' ' << force[2] / steps;
  });
  out << "</CellData>\n</Piece>\n</PolyData>\n</VTKFile>\n";
}

}  // namespace millfoam::dem_driver
