// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/files/grid_io.hpp"

#include <cmath>

#include "averaging/files/hdf5_io.hpp"

namespace millfoam::averaging::hdf5 {

namespace {

constexpr const char* box_kind = "box";
constexpr const char* cylinder_kind = "cylinder";
constexpr const char* cells_kind = "cells";

constexpr const char* cartesian = "cartesian";
constexpr const char* cylindrical = "cylindrical";
constexpr const char* lab = "lab";
constexpr const char* turning = "turning";

void write(hid_t group, const BoxGrid& grid) {
  write_attribute(group, "kind", std::string(box_kind));
  write_attribute(group, "lower", std::vector<double>(grid.lower().begin(), grid.lower().end()));
  write_attribute(group, "upper", std::vector<double>(grid.upper().begin(), grid.upper().end()));
  write_attribute(group, "shape", std::vector<int>(grid.shape().begin(), grid.shape().end()));
  const auto& periodic = grid.periodic();
  write_attribute(group, "periodic", std::vector<int>(periodic.begin(), periodic.end()));
}

/// Only of fields that files without these attributes do not have.
void write(hid_t group, const CylinderFrame& frame) {
  if (!frame.cylindrical) return;
  write_attribute(group, "components", std::string(cylindrical));
  write_attribute(group, "frame", std::string(frame.angular_velocity ? turning : lab));
  if (frame.angular_velocity) write_attribute(group, "angular_velocity", *frame.angular_velocity);
}

void write(hid_t group, const CylinderGrid& grid) {
  write_attribute(group, "kind", std::string(cylinder_kind));
  write_attribute(group, "radii", std::vector<double>(grid.radii().begin(), grid.radii().end()));
  write_attribute(group, "ends", std::vector<double>(grid.ends().begin(), grid.ends().end()));
  write_attribute(group, "shape", std::vector<int>(grid.shape().begin(), grid.shape().end()));
  write_attribute(group, "periodic", grid.periodic_z() ? 1 : 0);
  write(group, grid.frame());
  const auto [nr, ntheta, nz] = grid.shape();
  const Vector3& step = grid.spacing();
  std::vector<double> points;
  for (int k = 0; k <= nz; ++k) {
    for (int j = 0; j <= ntheta; ++j) {
      for (int i = 0; i <= nr; ++i) {
        const double r = grid.radii()[0] + i * step[0], theta = j * step[1];
        points.insert(points.end(), {r * std::cos(theta), r * std::sin(theta), grid.ends()[0] + k * step[2]});
      }
    }
  }
  const auto corners = [](int voxels) { return static_cast<hsize_t>(voxels) + 1; };
  write_array(group, "points", points, {corners(nz), corners(ntheta), corners(nr), 3}, "m");
}

void write(hid_t group, const MeshCells& mesh) {
  write_attribute(group, "kind", std::string(cells_kind));
  write_attribute(group, "cells", static_cast<int>(mesh.volumes.size()));
  write_attribute(group, "mesh", mesh.file);
  write_attribute(group, "motion", mesh.motion);
  write_attribute(group, "mesh_time", mesh.time);
  write_array(group, "volume", mesh.volumes, {mesh.volumes.size()}, "m3");
  if (mesh.topology.empty()) return;
  write_array(group, "points", mesh.points, {mesh.points.size() / 3, 3}, "m");
  write_array(group, "topology", mesh.topology, "1");
}

BoxGrid read_box(hid_t group) {
  const auto lower = read_double_attribute(group, "lower", 3);
  const auto upper = read_double_attribute(group, "upper", 3);
  const auto shape = read_int_attribute(group, "shape", 3);
  const auto periodic = read_int_attribute(group, "periodic", 3);
  return {{lower[0], lower[1], lower[2]},
          {upper[0], upper[1], upper[2]},
          {shape[0], shape[1], shape[2]},
          {periodic[0] != 0, periodic[1] != 0, periodic[2] != 0}};
}

/// Whether an attribute is the second of two words; where it is not there it counts as the first.
bool is_second(hid_t group, const char* name, const char* first, const char* second) {
  if (!has_attribute(group, name)) return false;
  const std::string found = read_text_attribute(group, name);
  if (found != first && found != second) {
    throw Error(std::string("the grid's ") + name + " is '" + found + "', expected '" + first + "' or '" +
                second + "'");
  }
  return found == second;
}

CylinderFrame read_frame(hid_t group) {
  CylinderFrame frame{is_second(group, "components", cartesian, cylindrical), std::nullopt};
  if (is_second(group, "frame", lab, turning)) {
    frame.angular_velocity = read_double_attribute(group, "angular_velocity", 1)[0];
  }
  return frame;
}

CylinderGrid read_cylinder(hid_t group) {
  const auto radii = read_double_attribute(group, "radii", 2);
  const auto ends = read_double_attribute(group, "ends", 2);
  const auto shape = read_int_attribute(group, "shape", 3);
  return {{radii[0], radii[1]},
          {ends[0], ends[1]},
          {shape[0], shape[1], shape[2]},
          read_int_attribute(group, "periodic", 1)[0] != 0,
          read_frame(group)};
}

MeshCells read_cells(hid_t group) {
  MeshCells mesh;
  mesh.file = read_text_attribute(group, "mesh");
  mesh.motion = read_text_attribute(group, "motion");
  mesh.time = read_double_attribute(group, "mesh_time", 1)[0];
  mesh.volumes = read_all(group, "volume");
  const auto cells = static_cast<std::size_t>(read_int_attribute(group, "cells", 1)[0]);
  if (mesh.volumes.size() != cells) {
    throw Error("/grid/volume has " + std::to_string(mesh.volumes.size()) + " values, expected " +
                std::to_string(cells));
  }
  for (std::size_t c = 0; c < cells; ++c) {
    if (mesh.volumes[c] > 0 && std::isfinite(mesh.volumes[c])) continue;
    throw Error("/grid/volume is " + std::to_string(mesh.volumes[c]) + " of cell " + std::to_string(c) +
                ", expected a volume above 0 m3");
  }
  return mesh;
}

}  // namespace

void write_grid(hid_t group, const Grid& grid) {
  std::visit([group](const auto& kind) { write(group, kind); }, grid);
}

Grid read_grid(hid_t group) {
  const std::string kind = read_text_attribute(group, "kind");
  try {
    if (kind == box_kind) return read_box(group);
    if (kind == cylinder_kind) return read_cylinder(group);
    if (kind == cells_kind) return read_cells(group);
  } catch (const std::invalid_argument& error) {
    throw Error(std::string("/grid: ") + error.what());
  }
  throw Error("the grid's kind is '" + kind + "', expected 'box', 'cylinder' or 'cells'");
}

}  // namespace millfoam::averaging::hdf5
