// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/volume/hexahedra.hpp"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

namespace millfoam::meshing {
namespace {

using Eigen::Vector3d;

std::size_t at(int number) {
  return static_cast<std::size_t>(number);
}

/// A face of a cell: numbers of the cell and of the face.
using Side = std::pair<int, int>;

/// Faces of a cell, whose normals point out of it, in the order of Hexahedron::parts.
std::array<Quad, 6> faces_of(const Hexahedron& cell) {
  const auto& c = cell.points;
  return {{{c[0], c[3], c[2], c[1]},
           {c[4], c[5], c[6], c[7]},
           {c[0], c[1], c[5], c[4]},
           {c[1], c[2], c[6], c[5]},
           {c[2], c[3], c[7], c[6]},
           {c[3], c[0], c[4], c[7]}}};
}

/// The points that the cells have, which get their numbers among these.
std::vector<Vector3d> used_points(const std::vector<Vector3d>& points, std::vector<Hexahedron>& cells) {
  std::vector<int> numbers(points.size(), -1);
  for (const Hexahedron& cell : cells)
    for (const int point : cell.points) numbers[at(point)] = 0;
  std::vector<Vector3d> kept;
  for (std::size_t p = 0; p < numbers.size(); ++p) {
    if (numbers[p] < 0) continue;
    numbers[p] = static_cast<int>(kept.size());
    kept.push_back(points[p]);
  }
  for (Hexahedron& cell : cells)
    for (int& point : cell.points) point = numbers[at(point)];
  return kept;
}

/// Adds the faces between two cells; returns those of one cell.
std::vector<Side> add_inner_faces(const std::vector<Hexahedron>& cells, VolumeMesh& mesh) {
  std::map<Quad, Side> open;  // by their points in ascending order
  std::vector<std::tuple<int, int, Quad>> inner;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const auto faces = faces_of(cells[c]);
    for (int f = 0; f < 6; ++f) {
      Quad key = faces[at(f)];
      std::sort(key.begin(), key.end());
      const auto [other, is_new] = open.emplace(key, Side(static_cast<int>(c), f));
      if (is_new) continue;
      const auto [cell, number] = other->second;
      inner.emplace_back(cell, static_cast<int>(c), faces_of(cells[at(cell)])[at(number)]);
      open.erase(other);
    }
  }
  std::sort(inner.begin(), inner.end());
  for (const auto& [owner, neighbour, face] : inner) {
    mesh.faces.push_back(face);
    mesh.owner.push_back(owner);
    mesh.neighbour.push_back(neighbour);
  }
  std::vector<Side> sides;
  sides.reserve(open.size());
  for (const auto& [key, side] : open) sides.push_back(side);
  std::sort(sides.begin(), sides.end());
  return sides;
}

}  // namespace

VolumeMesh mesh_of_hexahedra(const std::vector<Vector3d>& points, std::vector<Hexahedron> cells,
                             const std::vector<std::string>& patches) {
  VolumeMesh mesh;
  mesh.points = used_points(points, cells);
  mesh.cells = static_cast<int>(cells.size());
  const std::vector<Side> sides = add_inner_faces(cells, mesh);
  for (std::size_t patch = 0; patch < patches.size(); ++patch) {
    const int start = static_cast<int>(mesh.faces.size());
    for (const auto& [cell, number] : sides) {
      if (cells[at(cell)].parts[at(number)] != static_cast<int>(patch)) continue;
      mesh.faces.push_back(faces_of(cells[at(cell)])[at(number)]);
      mesh.owner.push_back(cell);
    }
    mesh.patches.push_back({patches[patch], start, static_cast<int>(mesh.faces.size()) - start, ""});
  }
  return mesh;
}

}  // namespace millfoam::meshing
