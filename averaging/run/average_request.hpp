// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "averaging/grids/box_grid.hpp"
#include "averaging/grids/cylinder_grid.hpp"

namespace millfoam::averaging {

/// Widths of smoothing in Sauter diameters, where none is given.
inline constexpr double usual_smoothing = 2.5;

/// The cells of a mesh file.
struct MeshRequest {
  std::filesystem::path file;       ///< mesh.h5, read by `MeshReader`
  std::vector<std::string> motion;  ///< texts of `parse_motion`; empty: the mill's rotation out of run.json
  bool at_rest = false;             ///< no motion at all
  std::optional<double> period_z;   ///< m; the mesh spans one period along z
  bool smoothed = false;            ///< by conservative diffusion
  double smoothing = 0;             ///< its width, m; 0: `usual_smoothing` Sauter diameters of the first dump
};

/// The voxels of a cylinder.
struct CylinderRequest {
  /// @param voxels  a cylinder at rest
  CylinderRequest(const CylinderGrid& voxels) : grid(voxels) {}

  CylinderGrid grid;         ///< with velocities along x, y and z
  bool cylindrical = false;  ///< velocities along r, theta and z are requested
  bool turning = false;      ///< the cylinder turns with the mill; its velocities are then cylindrical, too
};

/// How balls are deposited in cells.
enum class DepositionMethod {
  exact,  ///< exact volumes of intersection
  sample  ///< points of a template
};

/// Where balls are deposited.
using GridRequest = std::variant<BoxGrid, CylinderRequest, MeshRequest>;

/// A series of windows of one length.
struct WindowsRequest {
  std::optional<double> length;  ///< s; unless given, one window over the whole run
  std::filesystem::path output;  ///< the solids file
};

/// The input of `millAverage`.
struct AverageRequest {
  /// @param cells  where balls are deposited
  explicit AverageRequest(GridRequest cells) : grid(std::move(cells)) {}

  std::string dumps;                       ///< pattern of the dumps' names, see `find_dumps`
  std::optional<double> timestep;          ///< of the DEM run, s; unless given, from the dumps' run.json
  std::optional<double> angular_velocity;  ///< of the mill about z, rad/s; unless given, as above
  GridRequest grid;                        ///< where balls are deposited
  DepositionMethod method = DepositionMethod::exact;  ///< of spheres; superquadrics are always sampled
  /// The records have spheres of equal volume in place of superquadrics, as those of LiveAverages.
  bool superquadrics_as_spheres = false;
  int template_points = 12;  ///< along a sphere's diameter; for sampling and for superquadrics
  std::vector<std::filesystem::path> walls;  ///< STL files, or a mesh file, within which voxels count
  std::optional<double> solidity_cap;        ///< largest solidity that may stay in a cell
  std::vector<WindowsRequest> windows;       ///< all are averaged in one pass over the dumps
  std::optional<double> start;               ///< DEM time, s
  std::optional<double> end;                 ///< DEM time, s
  bool whole_run_dumped = false;             ///< fewer dumps than run.json says, or up to `end`, are refused
  /// Deposit of the balls' volume that may lie outside the grid in the first record and in the last one. A
  /// grid that misses more cannot be meant for these balls.
  double largest_outside = 0.5;
  std::string mill_averages;  ///< fingerprint of the mill and its averages, for the file; empty: not known
  int threads = 0;            ///< of this process; 0: as many as OpenMP gives
  double checkpoint_interval = 10;  ///< s between notes of how far the run has come
};

}  // namespace millfoam::averaging
