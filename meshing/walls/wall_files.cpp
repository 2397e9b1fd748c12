// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/walls/wall_files.hpp"

#include <Eigen/Geometry>
#include <fstream>
#include <iterator>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "meshing/files/file_fingerprint.hpp"
#include "meshing/files/json_object.hpp"
#include "meshing/files/output_file.hpp"
#include "meshing/files/text_numbers.hpp"

namespace millfoam::meshing {
namespace {

using Eigen::Vector3d;

void write_triangle(std::ostream& out, const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const Vector3d normal = (b - a).cross(c - a).normalized();
  out << "  facet normal " << exact(normal) << "\n    outer loop\n";
  for (const Vector3d* point : {&a, &b, &c}) out << "      vertex " << exact(*point) << '\n';
  out << "    endloop\n  endfacet\n";
}

/// The STL file of a part.
std::string stl_of(const WallSurface& surface, const WallPart& part) {
  const auto point = [&](int p) -> const Vector3d& { return surface.points[static_cast<std::size_t>(p)]; };
  std::ostringstream out;
  out << "solid " << part.name << '\n';
  for (const auto& [a, b, c] : part.triangles) write_triangle(out, point(a), point(b), point(c));
  out << "endsolid " << part.name << '\n';
  return out.str();
}

bool is_wall(const WallPart& part, Ends ends) {
  const bool is_end = part.name == "feedEnd" || part.name == "dischargeEnd";
  return !part.triangles.empty() && !(is_end && ends == Ends::periodic);
}

constexpr char advice[] = ": run millMesh again";

[[noreturn]] void refuse(const std::filesystem::path& folder, const std::string& why) {
  throw std::runtime_error((folder / walls_results_name).string() + ": " + why + advice);
}

/// walls.json of a folder, where it is there.
std::optional<JsonObject> read_results(const std::filesystem::path& folder) {
  return JsonObject::read(folder / walls_results_name, advice);
}

bool is_of_cad(const JsonObject& results) {
  return results.find<std::string>("source") == "cad";
}

}  // namespace

std::vector<std::filesystem::path> write_walls(const WallSurface& surface, Ends ends,
                                               const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  write_file(folder / walls_results_name, [](std::ostream& out) { out << R"({"files": null})" << '\n'; });
  for (const WallPart& part : surface.parts) {
    const std::filesystem::path file = folder / (part.name + ".stl");
    if (!is_wall(part, ends)) {
      std::filesystem::remove(file);
      continue;
    }
    write_file(file, [&](std::ostream& out) { out << stl_of(surface, part); });
    files.push_back(file);
  }
  return files;
}

bool has_cad_walls(const std::filesystem::path& folder) {
  const auto results = read_results(folder);
  return results && is_of_cad(*results);
}

void require_walls_of(const std::filesystem::path& folder, const Mill& mill) {
  const auto results = read_results(folder);
  if (!results) return;
  const auto of_mill = results->find_object("mill");
  const std::string found = of_mill ? of_mill->find<std::string>("walls").value_or("") : "";
  if (!is_of_cad(*results) && !found.empty() && found != mill.fingerprint.walls)
    refuse(folder, "the walls are of another mill (walls " + found + ", this mill's are " +
                       mill.fingerprint.walls + ")");
  if (results->contains("files") && !results->find_object("files"))
    refuse(folder, "the walls are not complete, as after an interrupted millMesh");
}

void require_written_walls(const std::filesystem::path& folder) {
  const auto results = read_results(folder);
  if (!results || !results->contains("files")) return;  // of an earlier version
  for (const auto& [part, written] : results->get<std::map<std::string, std::string>>("files")) {
    const std::filesystem::path wall = folder / (part + ".stl");
    if (!std::filesystem::exists(wall) || written != file_fingerprint(wall))
      refuse(folder, wall.filename().string() + " is not the wall that was written with this file");
  }
}

void require_walls_of_run(const std::filesystem::path& folder, const std::map<std::string, std::string>& used,
                          const std::string& source) {
  const auto refuse_wall = [&](const std::string& part, const std::string& why,
                               const std::string& mend = "put them back, or run millDem again") {
    throw std::runtime_error((folder / (part + ".stl")).string() + ": " + why + " (" + source +
                             "); expected the walls of the dry run: " + mend);
  };
  for (const auto& [part, fingerprint] : used) {
    const std::filesystem::path wall = folder / (part + ".stl");
    if (!std::filesystem::exists(wall)) refuse_wall(part, "no such file, but it is a wall of the dry run");
    const std::string found = file_fingerprint(wall);
    if (found != fingerprint)
      refuse_wall(part, "the wall is another one (" + found + ") than that of the dry run, " + fingerprint);
  }
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".stl" && used.count(entry.path().stem().string()) == 0)
      refuse_wall(entry.path().stem().string(), "is not a wall of the dry run",
                  "remove it, averages are cut by all .stl here");
}

void require_known_walls(const WallSurface& surface, Ends ends, const std::filesystem::path& folder) {
  if (std::filesystem::exists(folder / walls_results_name)) return;
  for (const WallPart& part : surface.parts) {
    const std::filesystem::path file = folder / (part.name + ".stl");
    if (!std::filesystem::exists(file)) continue;
    std::ifstream in(file, std::ios::binary);
    const std::string found{std::istreambuf_iterator<char>(in), {}};
    if (is_wall(part, ends) && found == stl_of(surface, part)) continue;
    throw std::runtime_error(
        file.string() + ": millMesh has not written this file, because there is no " + walls_results_name +
        " next to it; expected no file, --walls, which replaces it, or walls from CAD by "
        "'millMesh surface'");
  }
}

}  // namespace millfoam::meshing
