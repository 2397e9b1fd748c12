// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/tools/options.hpp"

#include <glob.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "averaging/dumps/text_lines.hpp"
#include "averaging/run/program.hpp"
#include "meshing/mill/mill_voxels.hpp"

namespace millfoam::averaging {

namespace {

constexpr char usual_frame[] = "lab";
constexpr char usual_method[] = "exact";
constexpr int usual_template = 12;

/// Seconds, or nothing for the whole run.
std::optional<double> window_length(const std::string& text) {
  if (text == "whole") return std::nullopt;
  const std::optional<double> length = as_number<double>(text);
  if (!length || !(*length >= 0)) {
    throw std::invalid_argument("--window is '" + text + "', expected a time in s or 'whole'");
  }
  return *length == 0 ? std::nullopt : length;
}

/// The output itself for a single length; for several NAME_LENGTH.h5 of NAME.h5.
std::vector<WindowsRequest> windows(const Options& options) {
  std::vector<WindowsRequest> result;
  for (const std::string& text : options.windows) {
    std::filesystem::path output = options.output;
    if (options.windows.size() > 1) {
      if (output.extension() != ".h5")
        throw std::invalid_argument("-o: '" + output.string() +
                                    "': with several windows expected a name that ends in .h5");
      output.replace_filename(output.stem().string() + '_' + text + output.extension().string());
    }
    if (std::filesystem::is_directory(output)) {
      throw std::invalid_argument("-o: '" + output.string() + "' is a folder, expected the name of a file");
    }
    result.push_back({window_length(text), output});
    const auto same = [&](const WindowsRequest& other) { return other.length == result.back().length; };
    if (std::count_if(result.begin(), result.end(), same) > 1) {
      throw std::invalid_argument("--window has '" + text + "' twice");
    }
  }
  return result;
}

std::array<bool, 3> periodic_axes(const Options& options) {
  std::array<bool, 3> periodic{};
  for (const std::string& axis : options.periodic) periodic[static_cast<std::size_t>(axis[0] - 'x')] = true;
  return periodic;
}

/// Throws without three numbers, or where they give more voxels than a mill's own may have.
void require_shape(const Options& options, const char* meaning) {
  if (options.shape.size() != 3)
    throw std::invalid_argument(std::string("--shape is missing, expected ") + meaning);
  double voxels = 1;
  for (const int along : options.shape) voxels *= std::abs(static_cast<double>(along));
  if (voxels <= meshing::most_voxels) return;
  std::ostringstream message;
  message << "--shape gives " << voxels << " voxels, expected at most " << meshing::most_voxels;
  throw std::invalid_argument(message.str());
}

BoxGrid box_grid(const Options& options) {
  require_shape(options, "numbers of voxels nx ny nz");
  const std::vector<double>& b = options.box;
  return {{b[0], b[1], b[2]},
          {b[3], b[4], b[5]},
          {options.shape[0], options.shape[1], options.shape[2]},
          periodic_axes(options)};
}

CylinderRequest cylinder_request(const Options& options) {
  require_shape(options, "numbers of voxels nr ntheta nz");
  const std::array<bool, 3> periodic = periodic_axes(options);
  if (periodic[0] || periodic[1]) {
    throw std::invalid_argument("--periodic is x or y, expected z: a cylinder repeats along its axis only");
  }
  const std::vector<double>& c = options.cylinder;
  CylinderRequest cylinder(CylinderGrid({c[0], c[1]}, {c[2], c[3]},
                                        {options.shape[0], options.shape[1], options.shape[2]}, periodic[2]));
  cylinder.turning = options.frame.value_or(usual_frame) == "turning";
  if (cylinder.turning && options.components == "cartesian") {
    throw std::invalid_argument("--components is cartesian, expected cylindrical with --frame turning");
  }
  cylinder.cylindrical = cylinder.turning || options.components == "cylindrical";
  return cylinder;
}

/// Metres, or 0 for the usual width.
double smoothing_width(const std::string& text) {
  if (text.empty()) return 0;
  const std::optional<double> width = as_number<double>(text);
  if (!width || !(*width > 0) || !std::isfinite(*width)) {
    throw std::invalid_argument("--smooth is '" + text + "', expected a length above 0 in m, or none");
  }
  return *width;
}

MeshRequest mesh_request(const Options& options) {
  if (!options.shape.empty() || !options.periodic.empty()) {
    throw std::invalid_argument(
        "--shape and --periodic are for --box and --cylinder; a mesh has its own cells, and --period LENGTH");
  }
  if (options.period && !(*options.period > 0 && std::isfinite(*options.period))) {
    std::ostringstream message;
    message << "--period is " << *options.period << ", expected a length above 0 in m";
    throw std::invalid_argument(message.str());
  }
  MeshRequest mesh;
  mesh.file = options.mesh;
  mesh.at_rest = options.motion == std::vector<std::string>{"none"};
  if (!mesh.at_rest) mesh.motion = options.motion;
  mesh.period_z = options.period;
  if (options.smoothing) {
    mesh.smoothed = true;
    mesh.smoothing = smoothing_width(*options.smoothing);
  }
  return mesh;
}

GridRequest grid(const Options& options) {
  const int kinds =
      (options.box.empty() ? 0 : 1) + (options.cylinder.empty() ? 0 : 1) + (options.mesh.empty() ? 0 : 1);
  if (kinds != 1) {
    throw std::invalid_argument(std::string(kinds == 0 ? "none" : "more than one") +
                                " of --box, --cylinder and --mesh is given, expected one of them");
  }
  if (options.cylinder.empty() &&
      (options.frame.value_or(usual_frame) != usual_frame || !options.components.empty())) {
    throw std::invalid_argument("--frame and --components are for --cylinder");
  }
  if (!options.mesh.empty()) return mesh_request(options);
  if (!options.motion.empty() || options.period || options.smoothing) {
    throw std::invalid_argument("--motion, --period and --smooth are for --mesh; voxels do not move");
  }
  if (!options.box.empty()) return box_grid(options);
  return cylinder_request(options);
}

/// The files that patterns match. A shell that has expanded a pattern already gives plain names.
std::vector<std::filesystem::path> matching_files(const std::vector<std::string>& patterns) {
  std::vector<std::filesystem::path> files;
  for (const std::string& pattern : patterns) {
    glob_t found{};
    if (glob(pattern.c_str(), GLOB_TILDE, nullptr, &found) == 0) {
      files.insert(files.end(), found.gl_pathv, found.gl_pathv + found.gl_pathc);
    } else {
      globfree(&found);
      throw std::invalid_argument("--inside '" + pattern + "' matches no file");
    }
    globfree(&found);
  }
  return files;
}

void declare_mill(CLI::App& app, Options& options) {
  app.set_version_flag("--version", program());
  meshing::add_mill_options(app, options.mill);
  app.add_option(
         "--case", options.case_folder,
         "folder with dumps/ and walls/ of the mill, which receives solids.h5; the mill's averages are "
         "made unless the options below change them. --shape, --frame, --components and --periodic need "
         "--box or --cylinder")
      ->capture_default_str();
}

void declare_files(CLI::App& app, Options& options) {
  app.add_option("--dumps", options.dumps, "pattern of the dumps' names, in quotes: 'post/dump*.txt'");
  app.add_option("--dt", options.timestep,
                 "DEM time-step, s; unless given, from run.json in the folder of the dumps");
  app.add_option("--speed", options.speed, "of the mill about z, rad/s; unless given, from run.json");
}

void declare_output(CLI::App& app, Options& options) {
  app.add_option("-o,--output", options.output,
                 "file to write; with several windows NAME_LENGTH.h5 for NAME.h5");
  app.add_option("--tolerance", options.tolerance,
                 "fail when more than this share of the balls' volume is outside or above the cap [0.01 with "
                 "--report, otherwise none]");
}

void declare_cells(CLI::App& app, Options& options) {
  app.add_option("--box", options.box, "voxels of a box: two corners x0 y0 z0 x1 y1 z1, m")->expected(6);
  app.add_option("--cylinder", options.cylinder,
                 "voxels of a cylinder about z: radii r0 r1 and ends z0 z1, m")
      ->expected(4);
  app.add_option("--frame", options.frame,
                 "of the cylinder: lab, or turning with the mill, whose balls are then in one place on it")
      ->check(CLI::IsMember({"lab", "turning"}))
      ->default_str(usual_frame);
  app.add_option("--components", options.components,
                 "of velocities on the cylinder: cartesian or cylindrical [cartesian in the lab's frame, "
                 "cylindrical in the turning one]")
      ->check(CLI::IsMember({"cartesian", "cylindrical"}));
  app.add_option("--shape", options.shape, "numbers of voxels nx ny nz, or nr ntheta nz")->expected(3);
  app.add_option("--periodic", options.periodic, "axes along which the grid repeats: x, y, z")
      ->check(CLI::IsMember({"x", "y", "z"}));
  app.add_option(
      "--inside", options.walls,
      "STL files of the mill's walls at DEM time 0, or a mesh file: voxels count by their volume inside");
  app.add_option("--mesh", options.mesh, "cells of a mesh file, as foamMeshToH5 writes it");
  app.add_option("--motion", options.motion,
                 "of the mesh: 'rotation speed W', 'rotation table FILE', 'translation velocity X Y Z', "
                 "'translation table FILE', 'none'; several are applied in turn [the mill's rotation]");
  app.add_option("--period", options.period, "length along z after which the mesh repeats, m");
  app.add_option(
         "--smooth", options.smoothing,
         "width of the conservative diffusion on the mesh, m; without a number 2.5 Sauter diameters of the "
         "balls [no smoothing]")
      ->expected(0, 1);
}

void declare_method(CLI::App& app, Options& options) {
  app.add_option("--method", options.method, "how balls are shared between cells: exact or sample")
      ->check(CLI::IsMember({"exact", "sample"}))
      ->default_str(usual_method);
  app.add_option("--template", options.template_points, "points along a sphere's diameter, to sample")
      ->default_str(std::to_string(usual_template));
  app.add_option("--cap", options.solidity_cap,
                 "largest solidity; the volume above it moves to neighbours [none]");
}

void declare_windows(CLI::App& app, Options& options) {
  app.add_option("--window", options.windows,
                 "lengths of the time windows, s, or 'whole' for one over the run; several in one pass");
  app.add_option("--start", options.start, "DEM time at which the first window begins, s [first dump]");
  app.add_option("--end", options.end, "DEM time from which dumps are left out, s [none]");
}

void declare_run(CLI::App& app, Options& options) {
  app.add_option("--threads", options.threads, "of this process [OMP_NUM_THREADS or all cores]")
      ->check(CLI::Range(1, 1024));
  app.add_option("--checkpoint", options.checkpoint_interval, "time between checkpoints of the run, s")
      ->capture_default_str();
  CLI::Option* const report =
      app.add_option("--report", options.report, "only print the ledger and summary of this solids file");
  app.add_option("--json", options.json, "with --report: also write them to this file")->needs(report);
}

}  // namespace

void declare(CLI::App& app, Options& options) {
  declare_mill(app, options);
  declare_files(app, options);
  declare_averages(app, options);
  declare_run(app, options);
}

void parse(CLI::App& app, const Options& options, int argc, const char* const* argv) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::ExtrasError&) {
    const std::vector<std::string> others = app.remaining();
    if (options.dumps.empty() || !std::filesystem::exists(options.dumps) ||
        !std::filesystem::exists(others.front()))
      throw;
    throw std::invalid_argument(
        "--dumps " + options.dumps + ": " + std::to_string(others.size()) + " more files follow (" +
        others.front() + (others.size() > 1 ? ", …" : "") +
        "); put the pattern in quotes, so that the shell leaves it: --dumps 'dumps/dump.*.txt'");
  }
}

void declare_averages(CLI::App& app, Options& options) {
  declare_cells(app, options);
  declare_method(app, options);
  declare_windows(app, options);
  declare_output(app, options);
}

double tolerance(const Options& options, double usual) {
  const double value = options.tolerance.value_or(usual);
  if (value >= 0 && value <= 1) return value;
  throw std::invalid_argument("--tolerance is " + std::to_string(value) +
                              ", expected a share between 0 and 1");
}

AverageRequest as_request(const Options& options) {
  const std::array<std::pair<const char*, bool>, 2> required{
      {{"--window", options.windows.empty()}, {"-o", options.output.empty()}}};
  for (const auto& [name, missing] : required) {
    if (missing) throw std::invalid_argument(std::string(name) + " is missing");
  }
  if (options.solidity_cap && !(*options.solidity_cap > 0 && *options.solidity_cap < 1)) {
    throw std::invalid_argument("--cap is " + std::to_string(*options.solidity_cap) +
                                ", expected a solidity between 0 and 1");
  }
  const int template_points = options.template_points.value_or(usual_template);
  if (template_points < 2 || template_points > 200) {
    throw std::invalid_argument("--template is " + std::to_string(template_points) +
                                ", expected 2 to 200 points along a diameter");
  }
  if (!(options.checkpoint_interval >= 0)) {
    throw std::invalid_argument("--checkpoint is " + std::to_string(options.checkpoint_interval) +
                                ", expected a time in s");
  }
  AverageRequest request(grid(options));
  request.dumps = options.dumps;
  request.whole_run_dumped = options.whole_run_dumped;
  request.timestep = options.timestep;
  request.angular_velocity = options.speed;
  request.method =
      options.method.value_or(usual_method) == "exact" ? DepositionMethod::exact : DepositionMethod::sample;
  request.template_points = template_points;
  request.walls = matching_files(options.walls);
  request.solidity_cap = options.solidity_cap;
  request.windows = windows(options);
  request.start = options.start;
  request.end = options.end;
  request.largest_outside = std::max(request.largest_outside, tolerance(options, 0));
  request.threads = options.threads;
  request.checkpoint_interval = options.checkpoint_interval;
  return request;
}

}  // namespace millfoam::averaging
