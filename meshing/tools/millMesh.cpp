// SPDX-License-Identifier: GPL-3.0-or-later
#include <CLI/CLI.hpp>
#include <exception>
#include <fstream>
#include <iostream>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>

#include "meshing/files/standard_output.hpp"
#include "meshing/files/text_numbers.hpp"
#include "meshing/mill/mill_shape.hpp"
#include "meshing/mill/rules.hpp"
#include "meshing/mill_mesh/mill_mesh.hpp"
#include "meshing/mill_mesh/section_blocks.hpp"
#include "meshing/mill_mesh/stirred_mesh.hpp"
#include "meshing/results/mesh_report.hpp"
#include "meshing/results/mesh_results.hpp"
#include "meshing/results/mill_properties.hpp"
#include "meshing/tools/mill_options.hpp"
#include "meshing/tools/polygon_commands.hpp"
#include "meshing/volume/mesh_quality.hpp"
#include "meshing/volume/openfoam_files.hpp"
#include "meshing/walls/stirred_walls.hpp"
#include "meshing/walls/surface_check.hpp"
#include "meshing/walls/wall_files.hpp"

namespace {

using namespace millfoam::meshing;
namespace fs = std::filesystem;

struct Options {
  MillOptions mill;
  std::string case_folder;     // empty: nothing is written
  std::optional<double> time;  // s; else the flow's start
  bool walls_only = false;
};

/// NaN is no time, and after a time that is far too large the angle has no digit left.
const CLI::Validator time_of_run{[](const std::string& word) {
                                   const auto value = millfoam::to_number(word);
                                   return value && *value >= 0 && *value <= longest_time
                                              ? std::string()
                                              : "'" + word + "': expected a DEM time in s, from 0 to 1e5";
                                 },
                                 "TIME"};

/// Content of the files of a folder that are there, by name.
std::map<fs::path, std::string> contents(const fs::path& folder) {
  std::map<fs::path, std::string> found;
  if (!fs::is_directory(folder)) return found;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() != ".stl") continue;
    std::ifstream in(entry.path(), std::ios::binary);
    found[entry.path()] = {std::istreambuf_iterator<char>(in), {}};
  }
  return found;
}

/// Writes the walls and reports which other files they replaced, such as walls from CAD.
void replace_walls(const WallSurface& surface, Ends ends, const fs::path& folder) {
  const auto before = contents(folder);
  write_walls(surface, ends, folder);
  const auto after = contents(folder);
  for (const auto& [file, content] : before) {
    const auto now = after.find(file);
    if (now == after.end())
      std::cout << "removed: " << file.string() << ", which is not a wall of this mill\n";
    if (now != after.end() && now->second != content)
      std::cout << "replaced: " << file.string() << ", which held another surface\n";
  }
}

/// Throws std::runtime_error for walls of another origin, which only --walls may replace.
void keep_unknown_walls(const Options& options, const Mill& mill, const WallSurface& surface) {
  if (options.case_folder.empty() || options.walls_only) return;
  require_known_walls(surface, mill.geometry.ends, fs::path(options.case_folder) / "walls");
}

/// DEM time to which the mesh is turned, s.
double mesh_time(const Options& options, const Mill& mill) {
  if (options.time) return *options.time;
  const FlowBegin start = start_of_flow(mill, options.case_folder);
  if (!start.note.empty()) std::cout << "note: " << start.note << '\n';
  return start.time;
}

/// Writes what the dry run needs: the walls, which enclose a volume (m^3), and the resolved mill. Walls from
/// CAD, with which a dry run may have been made, are replaced only where walls alone are wanted.
void write_for_dry_run(const MillDescription& description, const WallSurface& surface, double volume,
                       const fs::path& folder, bool walls_only) {
  const fs::path walls = folder / "walls";
  if (!walls_only && has_cad_walls(walls)) {
    std::cout << "note: " << walls.string() << " is from CAD and stays; --walls replaces it\n";
  } else {
    replace_walls(surface, description.mill.geometry.ends, walls);
    write_wall_results(description, surface, volume, walls);
  }
  write_resolved_mill(description, "millMesh", folder / resolved_mill_name);
}

/// The mesh of a stirred mill's flow: its quality and, unless walls alone are wanted, its files.
void mesh_stirred(const Options& options, const MillDescription& description) {
  const Mill& mill = description.mill;
  const VolumeMesh mesh = make_stirred_mesh(mill.geometry, mill.resolution.cell_size);
  const MeshQuality q = quality(mesh);
  const Openings none;
  std::cout << mesh_report(mill, mesh, q, none, stirred_limits) << std::flush;
  require_quality(q, flow_volume(mill.geometry), std::numeric_limits<double>::infinity(), stirred_limits);
  if (options.case_folder.empty() || options.walls_only) return;
  const fs::path folder = options.case_folder;
  const double time = mesh_time(options, mill);
  write_poly_mesh(turned(mesh, mill.angular_velocity * time), folder);
  write_mill_properties(description, none, time, folder);
  write_mesh_results(description, mesh, q, none, time, folder, stirred_limits);
}

/// The walls of a stirred mill and, where it has slurry, the mesh of its flow.
void run_stirred(const Options& options, const MillDescription& description) {
  const Mill& mill = description.mill;
  if (!options.walls_only && !mill.has_flow())
    throw std::runtime_error(
        "the mill is stirred and has no slurry: expected --walls, because it has no mesh of a flow");
  const WallSurface surface = make_stirred_walls(mill.geometry);
  const double volume = require_watertight(surface);
  const double closed_form = analytic_volume(mill.geometry);
  std::cout << stirred_lines(description)
            << wall_report(surface, volume, closed_form, allowed_stirred_volume_error) << std::flush;
  require_stirred_volume(volume, closed_form);
  require_no_needles(surface);
  keep_unknown_walls(options, mill, surface);
  // A mesh that is refused shall not cost a dry run
  if (mill.has_flow()) mesh_stirred(options, description);
  if (!options.case_folder.empty())
    write_for_dry_run(description, surface, volume, options.case_folder, options.walls_only);
}

void run(const Options& options, const MillDescription& description) {
  const Mill& mill = description.mill;
  if (mill.machine() == Machine::stirred) {
    run_stirred(options, description);
    return;
  }
  const CrossSection section = make_cross_section(mill.geometry, mill.resolution);
  const Openings openings = find_openings(section, mill.geometry);
  const VolumeMesh mesh =
      make_mill_mesh(section, mill.geometry, mill.resolution.layers, mill.resolution.last_layer);
  const MeshQuality q = quality(mesh);
  std::cout << mill_lines(description) << mesh_report(mill, mesh, q, openings) << std::flush;
  require_quality(q, flow_volume(mill.geometry), mill.geometry.length);
  const WallSurface surface = make_wall_surface(section, mill.geometry.length);
  const double of_walls = require_watertight(surface);
  const double of_mesh = chamber_volume(mesh, mill.geometry.length);
  std::cout << wall_report(surface, of_walls, of_mesh) << std::flush;
  require_same_volume(of_walls, of_mesh);
  require_no_needles(surface);
  if (options.case_folder.empty()) return;

  keep_unknown_walls(options, mill, surface);
  const fs::path folder = options.case_folder;
  write_for_dry_run(description, surface, of_walls, folder, options.walls_only);
  if (options.walls_only) return;
  const double time = mesh_time(options, mill);
  write_poly_mesh(turned(mesh, mill.angular_velocity * time), folder);
  write_mill_properties(description, openings, time, folder);
  write_mesh_results(description, mesh, q, openings, time, folder);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Writes a mill's walls for LIGGGHTS, and its mesh and numbers for OpenFOAM, from mill.yaml."};
  Options options;
  add_mill_options(app, options.mill);
  add_version(app, "millMesh");
  app.add_option("--case", options.case_folder,
                 "folder that receives walls/, constant/, mill.json (the resolved mill) and mesh.json");
  auto* quality =
      app.add_flag("--quality", "print the mesh's quality against its limits; writes with --case only");
  app.add_flag("--walls", options.walls_only,
               "write walls/ and mill.json only, which the dry run needs; replaces walls from CAD, which "
               "stay otherwise, and walls of unknown origin, which are refused otherwise");
  app.add_option(
         "--at-time", options.time,
         "DEM time in s that the flow's mesh is turned to [time0_s of DIR/solids.json, or averages.start]; "
         "the walls stay at 0")
      ->check(time_of_run);
  add_polygon_commands(app);
  app.require_subcommand(0, 1);
  app.callback([&] {
    if (!app.get_subcommands().empty()) return;
    if (options.mill.file.empty()) throw CLI::RequiredError("mill");
    if (!options.mill.resolved.empty()) {
      write_resolved_mill(options.mill.read(), "millMesh", options.mill.resolved);
      return;
    }
    if (options.case_folder.empty() && quality->empty())
      throw std::runtime_error("expected --case DIR, --quality or --resolved FILE");
    const MillDescription description = options.mill.read();
    naming_case(options.case_folder, [&] { naming_place(description, [&] { run(options, description); }); });
  });
  try {
    CLI11_PARSE(app, argc, argv);
    millfoam::require_printed();
  } catch (const std::exception& error) {
    std::cerr << "millMesh: error: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
