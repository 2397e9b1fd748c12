// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/tools/polygon_commands.hpp"

#include <cstdio>
#include <memory>

#include "meshing/files/text_numbers.hpp"
#include "meshing/mill_mesh/mill_mesh.hpp"
#include "meshing/mill_mesh/section_blocks.hpp"
#include "meshing/polygons/assembly.hpp"
#include "meshing/polygons/face_file.hpp"
#include "meshing/polygons/obj_file.hpp"
#include "meshing/results/mesh_results.hpp"
#include "meshing/tools/mill_options.hpp"
#include "meshing/volume/openfoam_files.hpp"
#include "meshing/walls/cad_surface.hpp"
#include "meshing/walls/wall_files.hpp"

namespace millfoam::meshing {
namespace {

struct AssembleOptions {
  std::string faces;
  std::string case_folder;
  double tolerance = 0;
};

void print(const PolygonSet& set, const Assembly& found) {
  const PolyMesh& mesh = found.mesh;
  std::printf("points    %zu (%zu in the file, %d welded to others, %d in no face", mesh.points.size(),
              set.points.size(), found.points_joined, found.points_unused);
  if (found.baffles > 0) std::printf(", %d for the second sides of baffles", found.points_separated);
  std::printf(")\n");
  std::printf("faces     %zu, %zu between two cells\n", mesh.faces.size(), mesh.neighbour.size());
  if (found.baffles > 0)
    std::printf("baffles   %d pairs of faces that coincide, walls between two cells\n", found.baffles);
  std::printf("cells     %d in %d %s, of %.3g to %.3g m^3\n", mesh.cells, found.bodies,
              found.bodies == 1 ? "body" : "bodies", found.smallest_cell, found.largest_cell);
  std::printf("volume    %.9g m^3\n", found.volume);
  for (const PatchMeasure& patch : found.patches) {
    if (patch.faces > 0) {
      std::printf("patch     %s: %d faces, %.6g m^2", patch.name.c_str(), patch.faces, patch.area);
      if (patch.between_cells > 0)
        std::printf("; %d of its group lie between two cells", patch.between_cells);
      std::printf("\n");
    } else if (patch.between_cells > 0) {
      std::printf("no patch  %s: %d faces, all between two cells\n", patch.name.c_str(), patch.between_cells);
    }
  }
  for (const std::string& warning : found.warnings) std::printf("warning   %s\n", warning.c_str());
}

void run_assemble(const AssembleOptions& options) {
  const PolygonSet set = read_faces(options.faces);
  const Assembly found = assemble(set, options.tolerance);
  write_poly_mesh(found.mesh, options.case_folder);
  print(set, found);
}

struct FacesOptions {
  MillOptions mill;
  std::string file;
};

void run_faces(const FacesOptions& options) {
  if (!has_extension(options.file, ".obj"))
    throw std::runtime_error("-o " + options.file + ": expected a name that ends in .obj");
  const MillDescription description = options.mill.read();
  const Mill& mill = description.mill;
  if (mill.machine() == Machine::stirred)
    throw std::runtime_error(options.mill.file +
                             ": faces of a stirred mill are not written: expected a tumbling one");
  if (mill.geometry.ends == Ends::periodic)
    throw std::runtime_error(
        options.mill.file +
        ": the mill's ends are periodic, and cells out of faces cannot have cyclic patches: "
        "expected 'ends: plain' without 'slice'");
  const CrossSection section = make_cross_section(mill.geometry, mill.resolution);
  VolumeMesh mesh;
  naming_place(description, [&] {
    mesh = make_mill_mesh(section, mill.geometry, mill.resolution.layers, mill.resolution.last_layer);
  });
  write_obj(mesh, options.file);
  std::printf("%s: %zu points, %zu faces, %zu of them in the group %s\n", options.file.c_str(),
              mesh.points.size(), mesh.faces.size(), mesh.neighbour.size(), internal_group);
}

/// CLI11's own check prints the largest double as a limit.
const CLI::Validator above_nought{
    [](const std::string& word) {
      const auto value = to_number(word);
      return value && *value > 0 ? std::string() : "'" + word + "': expected a length in m above 0";
    },
    "LENGTH"};

struct SurfaceOptions {
  std::vector<std::string> parts;
  std::string case_folder;
  double scale = 1;
  double tolerance = 0;
  std::string ends = "plain";
};

PartFile part_file(const std::string& argument) {
  const auto sign = argument.find('=');
  if (sign == std::string::npos)
    throw std::runtime_error("'" + argument + "': expected PART=FILE.stl, as in shell=drum.stl");
  return {argument.substr(0, sign), argument.substr(sign + 1)};
}

void print(const CadReport& report) {
  std::printf("triangles  %d\n", report.triangles);
  std::printf("box        (%g %g %g) to (%g %g %g) m\n", report.low.x(), report.low.y(), report.low.z(),
              report.high.x(), report.high.y(), report.high.z());
  if (report.usable()) std::printf("volume     %.9g m^3\n", report.volume);
  for (const std::string& sentence : report.repairs) std::printf("repaired   %s\n", sentence.c_str());
  for (const std::string& sentence : report.warnings) std::printf("warning    %s\n", sentence.c_str());
  for (const std::string& sentence : report.problems) std::printf("problem    %s\n", sentence.c_str());
}

void run_surface(const SurfaceOptions& options) {
  std::vector<PartFile> parts;
  for (const std::string& argument : options.parts) parts.push_back(part_file(argument));
  const Ends ends = options.ends == "plain" ? Ends::plain : Ends::periodic;
  const CadReport report = examine(parts, options.scale, options.tolerance, ends);
  print(report);
  std::fflush(stdout);
  if (!report.usable())
    throw std::runtime_error("LIGGGHTS cannot use this surface: see the problems above; nothing was written");
  if (options.case_folder.empty()) return;
  const std::filesystem::path folder = std::filesystem::path(options.case_folder) / "walls";
  for (const auto& file : write_walls(report.surface, ends, folder))
    std::printf("written    %s\n", file.string().c_str());
  write_wall_results(std::nullopt, report.surface, report.volume, folder);
}

}  // namespace

void add_polygon_commands(CLI::App& app) {
  CLI::App* assemble =
      app.add_subcommand("assemble", "Finds the cells that polygons enclose and writes their mesh.");
  const auto of_assemble = std::make_shared<AssembleOptions>();
  assemble->add_option("faces", of_assemble->faces, "polygons, OBJ or PLY, in m")->required();
  assemble->add_option("--case", of_assemble->case_folder, "folder that receives constant/polyMesh")
      ->required();
  assemble
      ->add_option("--tolerance", of_assemble->tolerance,
                   "points nearer than this, m, are one; 1e-9 of the bounding box's diagonal unless given")
      ->check(above_nought);
  assemble->callback(
      [of_assemble] { naming_case(of_assemble->case_folder, [&] { run_assemble(*of_assemble); }); });

  CLI::App* faces =
      app.add_subcommand("faces", "Writes a mill's mesh as polygons, for editing and 'assemble'.");
  const auto of_faces = std::make_shared<FacesOptions>();
  add_mill_options(*faces, of_faces->mill)->required();
  faces->remove_option(faces->get_option("--resolved"));
  faces->add_option("-o", of_faces->file, "OBJ file to write: a group for each patch, and 'internal'")
      ->required();
  faces->callback([of_faces] { run_faces(*of_faces); });

  CLI::App* surface =
      app.add_subcommand("surface", "Checks walls from CAD, repairs what is safe, and writes them.");
  const auto of_surface = std::make_shared<SurfaceOptions>();
  surface
      ->add_option("parts", of_surface->parts,
                   "PART=FILE.stl for each of shell, lifters, feedEnd, dischargeEnd that there is")
      ->required();
  surface->add_option("--case", of_surface->case_folder,
                      "folder that receives walls/; only a report without it");
  surface->add_option("--scale", of_surface->scale, "factor on coordinates: 0.001 for millimetres")
      ->capture_default_str();
  surface
      ->add_option("--tolerance", of_surface->tolerance,
                   "corners nearer than this, m, are one; 1e-6 of the bounding box's diagonal unless given")
      ->check(above_nought);
  surface
      ->add_option("--ends", of_surface->ends,
                   "'periodic': walls of a slice, which may be open at its two ends; 'plain': closed walls")
      ->check(CLI::IsMember({"plain", "periodic"}))
      ->capture_default_str();
  surface->callback(
      [of_surface] { naming_case(of_surface->case_folder, [&] { run_surface(*of_surface); }); });
}

}  // namespace millfoam::meshing
