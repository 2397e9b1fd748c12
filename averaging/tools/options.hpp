// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "averaging/run/average_request.hpp"
#include "meshing/tools/mill_options.hpp"

namespace millfoam::averaging {

/// The options of millAverage as they are typed.
struct Options {
  meshing::MillOptions mill;             ///< no file: without a mill
  std::string case_folder = ".";         ///< of the mill
  std::string dumps;                     ///< pattern of their names
  bool whole_run_dumped = false;         ///< set by `take_from_mill`: all dumps of the run are expected
  std::optional<double> timestep;        ///< of the DEM run, s
  std::optional<double> speed;           ///< of the mill about z, rad/s
  std::vector<double> box;               ///< [6] two corners, m
  std::vector<double> cylinder;          ///< [4] two radii and two ends, m
  std::optional<std::string> frame;      ///< of the cylinder: lab (also without it) or turning
  std::string components;                ///< on it: cartesian or cylindrical; empty: those of the frame
  std::string mesh;                      ///< mesh file
  std::vector<int> shape;                ///< [3] numbers of voxels
  std::vector<std::string> periodic;     ///< x, y, z
  std::vector<std::string> motion;       ///< of the mesh, for `parse_motion`, or `none`
  std::optional<double> period;          ///< of the mesh along z, m
  std::optional<std::string> smoothing;  ///< width, m; empty: the usual one
  std::optional<std::string> method;     ///< exact (also without it) or sample
  std::optional<int> template_points;    ///< along a sphere's diameter; without it 12
  std::vector<std::string> walls;        ///< patterns of STL files, or a mesh file
  std::optional<double> solidity_cap;    ///< largest solidity
  std::vector<std::string> windows;      ///< lengths, s, or `whole`
  std::optional<double> start;           ///< DEM time, s
  std::optional<double> end;             ///< DEM time, s
  int threads = 0;                       ///< of this process; 0: as many as OpenMP gives
  double checkpoint_interval = 10;       ///< s
  std::optional<double> tolerance;       ///< largest share of the volume outside or clipped
  std::string report;                    ///< solids file that is only reported
  std::string json;                      ///< where that report goes too
  std::string output;                    ///< the solids file
};

/// Declares them, with their help.
void declare(CLI::App& app, Options& options);

/// Parses a command line into declared options. Throws as CLI::App::parse, and std::invalid_argument where
/// the shell has put the names of dumps in the place of a pattern without quotes.
void parse(CLI::App& app, const Options& options, int argc, const char* const* argv);

/// Declares those that hold for averages of a run under way, too: cells, method, windows, tolerance and file.
void declare_averages(CLI::App& app, Options& options);

/// The share that --tolerance gives, or the usual one. Throws as `as_request`.
double tolerance(const Options& options, double usual);

/// Checks that they go together, but for --dumps, which may be empty. Throws std::invalid_argument naming the
/// option, its value and what was expected.
AverageRequest as_request(const Options& options);

}  // namespace millfoam::averaging
