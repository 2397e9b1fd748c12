// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "averaging/grids/box_grid.hpp"
#include "averaging/grids/cylinder_grid.hpp"

namespace millfoam::averaging {

/// The cells of a mesh, as far as fields on them need to know it: the mesh itself stays in its own file.
struct MeshCells {
  std::vector<double> volumes;  ///< [cells], m^3, at `time`
  std::string file;             ///< name of the mesh file
  std::string motion;           ///< how it moves, in words
  double time = 0;              ///< DEM time, s, at which its points hold

  // For pictures; both empty when they are not wanted.
  std::vector<double> points;       ///< [points][3], m, at `time`
  std::vector<long long> topology;  ///< cells as polyhedra in XDMF's mixed topology
};

/// What fields can live on.
using Grid = std::variant<BoxGrid, CylinderGrid, MeshCells>;

/// Number of cells.
std::size_t cell_count(const Grid& grid);

/// Volume of a cell, m^3.
double cell_volume(const Grid& grid, std::size_t cell);

/// Dimensions of a field on the grid, slowest first: of a box z y x, of a cylinder z theta r, of a mesh its
/// cells.
std::vector<std::size_t> field_shape(const Grid& grid);

/// Where a cell is, for messages: "voxel (1 2 3)" by x y z or r theta z, "cell 17".
std::string cell_name(const Grid& grid, std::size_t cell);

/// The middle of a voxel, m; of a cylinder that turns in its own frame. Nothing for a cell of a mesh.
std::optional<Vector3> voxel_centre(const Grid& grid, std::size_t cell);

}  // namespace millfoam::averaging
