// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/walls/wall_files.hpp"

#include <Eigen/Geometry>

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

bool is_wall(const WallPart& part, Ends ends) {
  const bool is_end = part.name == "feedEnd" || part.name == "dischargeEnd";
  return !part.triangles.empty() && !(is_end && ends == Ends::periodic);
}

}  // namespace

std::vector<std::filesystem::path> write_walls(const WallSurface& surface, Ends ends,
                                               const std::filesystem::path& folder) {
  const auto point = [&](int p) -> const Vector3d& { return surface.points[static_cast<std::size_t>(p)]; };
  std::vector<std::filesystem::path> files;
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

}  // namespace millfoam::meshing
