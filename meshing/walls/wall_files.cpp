// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/walls/wall_files.hpp"

#include <Eigen/Geometry>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

#include "meshing/files/file_fingerprint.hpp"
#include "meshing/files/output_file.hpp"
#include "meshing/files/text_numbers.hpp"

namespace millfoam::meshing {
namespace {

using Eigen::Vector3d;
using Json = nlohmann::json;

void write_triangle(std::ostream& out, const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const Vector3d normal = (b - a).cross(c - a).normalized();
  out << "  facet normal " << exact(normal) << "\n    outer loop\n";
  for (const Vector3d* point : {&a, &b, &c}) out << "      vertex " << exact(*point) << '\n';
  out << "    endloop\n  endfacet\n";
}

bool is_wall(const WallPart& part, Ends ends) {
  const bool is_end = part.name == "feedEnd" || part.name == "dischargeEnd";
  return !part.triangles.empty() && !(is_end && ends == Ends::periodic);
}

[[noreturn]] void refuse(const std::filesystem::path& folder, const std::string& why) {
  throw std::runtime_error((folder / walls_results_name).string() + ": " + why + ": run millMesh again");
}

/// walls.json of a folder, where it is there.
std::optional<Json> read_results(const std::filesystem::path& folder) {
  std::ifstream in(folder / walls_results_name);
  if (!in) return std::nullopt;
  Json json = Json::parse(in, nullptr, false);
  if (!json.is_object()) refuse(folder, "is not a JSON object; expected what millMesh writes");
  return json;
}

}  // namespace

std::vector<std::filesystem::path> write_walls(const WallSurface& surface, Ends ends,
                                               const std::filesystem::path& folder) {
  const auto point = [&](int p) -> const Vector3d& { return surface.points[static_cast<std::size_t>(p)]; };
  std::vector<std::filesystem::path> files;
  write_file(folder / walls_results_name, [](std::ostream& out) { out << R"({"files": null})" << '\n'; });
  for (const WallPart& part : surface.parts) {
    const std::filesystem::path file = folder / (part.name + ".stl");
    if (!is_wall(part, ends)) {
      std::filesystem::remove(file);
      continue;
    }
    write_file(file, [&](std::ostream& out) {
      out << "solid " << part.name << '\n';
      for (const auto& [a, b, c] : part.triangles) write_triangle(out, point(a), point(b), point(c));
      out << "endsolid " << part.name << '\n';
    });
    files.push_back(file);
  }
  return files;
}

bool has_cad_walls(const std::filesystem::path& folder) {
  const auto json = read_results(folder);
  return json && json->value("source", Json()) == "cad";
}

void require_walls_of(const std::filesystem::path& folder, const Mill& mill) {
  const auto json = read_results(folder);
  if (!json) return;
  const Json of_mill = json->value("mill", Json::object());
  const std::string found = of_mill.is_object() ? of_mill.value("walls", std::string()) : std::string();
  if (json->value("source", Json()) != "cad" && !found.empty() && found != mill.fingerprint.walls)
    refuse(folder, "the walls are of another mill (walls " + found + ", this mill's are " +
                       mill.fingerprint.walls + ")");
  if (json->contains("files") && !(*json)["files"].is_object())
    refuse(folder, "the walls are not complete, as after an interrupted millMesh");
}

void require_written_walls(const std::filesystem::path& folder) {
  const auto json = read_results(folder);
  if (!json || !json->contains("files")) return;  // of an earlier version
  for (const auto& [part, written] : (*json)["files"].items()) {
    const std::filesystem::path wall = folder / (part + ".stl");
    if (!std::filesystem::exists(wall) || written != file_fingerprint(wall))
      refuse(folder, wall.filename().string() + " is not the wall that was written with this file");
  }
}

}  // namespace millfoam::meshing
