// SPDX-License-Identifier: GPL-3.0-or-later
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <iostream>

#include "meshing/mesh_quality.hpp"
#include "meshing/mill_mesh.hpp"
#include "meshing/mill_shape.hpp"
#include "meshing/openfoam_files.hpp"
#include "meshing/surface_check.hpp"
#include "meshing/tools/polygon_commands.hpp"
#include "meshing/wall_files.hpp"

namespace {

using namespace millfoam::meshing;
namespace fs = std::filesystem;

struct Options {
  std::string mill;
  std::string case_folder;
  double time = 0;
};

void print_table(const Mill& mill, const VolumeMesh& mesh, const MeshQuality& q) {
  const double analytic = analytic_volume(mill.geometry);
  double largest_ball = 0;
  for (const SizeClass& size : mill.charge.classes) largest_ball = std::max(largest_ball, size.diameter);
  std::printf("cells                    %d\n", mesh.cells);
  std::printf("faces                    %zu\n", mesh.faces.size());
  std::printf("volume                   %.6g m^3 (closed form %.6g, relative error %.2e)\n", q.volume,
              analytic, q.volume / analytic - 1);
  std::printf("max non-orthogonality    %.1f degrees\n", q.max_non_orthogonality);
  std::printf("max skewness             %.2f\n", q.max_skewness);
  std::printf("edges                    %.3g to %.3g mm\n", 1e3 * q.smallest_edge, 1e3 * q.largest_edge);
  std::printf("largest ball             %.3g mm, %.2g cells of %.3g mm\n", 1e3 * largest_ball,
              largest_ball / mill.resolution.cell_size, 1e3 * mill.resolution.cell_size);
}

void run(const Options& options) {
  const Mill mill = read_mill(options.mill);
  const CrossSection section = make_cross_section(mill.geometry, mill.resolution.cell_size);
  const VolumeMesh mesh = make_mill_mesh(section, mill.geometry, mill.resolution.layers);
  const MeshQuality q = quality(mesh);
  require_quality(q, analytic_volume(mill.geometry));
  const WallSurface surface = make_wall_surface(section, mill.geometry.length);
  require_same_volume(require_watertight(surface), q.volume);
  require_no_needles(surface);

  const fs::path folder = options.case_folder;
  write_walls(surface, mill.geometry.ends, folder / "walls");
  write_poly_mesh(turned(mesh, mill.angular_velocity * options.time), folder);
  write_mill_properties(mill, options.time, folder);
  print_table(mill, mesh, q);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Writes a mill's walls for LIGGGHTS, and its mesh and numbers for OpenFOAM, from mill.yaml."};
  Options options;
  app.add_option("mill", options.mill, "the mill's description, mill.yaml");
  app.add_option("--case", options.case_folder, "folder that receives walls/ and constant/");
  app.add_option("--at-time", options.time,
                 "DEM time in s that the flow's mesh is turned to; the walls stay at 0")
      ->capture_default_str();
  add_polygon_commands(app);
  app.require_subcommand(0, 1);
  app.callback([&] {
    if (!app.get_subcommands().empty()) return;
    if (options.mill.empty()) throw CLI::RequiredError("mill");
    if (options.case_folder.empty()) throw CLI::RequiredError("--case");
    run(options);
  });
  try {
    CLI11_PARSE(app, argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "millMesh: error: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
