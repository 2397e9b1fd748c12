// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/mesh/poly_mesh.hpp"

#include <stdexcept>

namespace millfoam::averaging {

namespace {

[[noreturn]] void refuse(const std::string& what) {
  throw std::invalid_argument("mesh: " + what);
}

std::string face_name(std::size_t face) {
  return "face " + std::to_string(face);
}

void check_sizes(const MeshTopology& topology) {
  const std::size_t faces = topology.faces();
  if (topology.cells == 0) refuse("there is no cell in it");
  if (topology.face_begin.size() != faces + 1) {
    refuse(std::to_string(faces) + " faces have owners, but face_begin has " +
           std::to_string(topology.face_begin.size()) + " entries, expected one more than faces");
  }
  if (topology.internal_faces() > faces) {
    refuse(std::to_string(topology.internal_faces()) + " faces have neighbours, but there are only " +
           std::to_string(faces) + " faces");
  }
  if (topology.face_begin.front() != 0 ||
      topology.face_begin.back() != static_cast<long long>(topology.face_points.size())) {
    refuse("face_begin goes from " + std::to_string(topology.face_begin.front()) + " to " +
           std::to_string(topology.face_begin.back()) + ", expected 0 to " +
           std::to_string(topology.face_points.size()));
  }
}

void check_corners(const MeshTopology& topology) {
  for (std::size_t face = 0; face < topology.faces(); ++face) {
    const int corners = topology.face_begin[face + 1] - topology.face_begin[face];
    if (topology.face_begin[face] < 0 || corners < 3) {
      refuse(face_name(face) + " has " + std::to_string(corners) + " points, expected 3 or more");
    }
  }
  for (std::size_t face = 0; face < topology.faces(); ++face) {
    for (int i = topology.face_begin[face]; i < topology.face_begin[face + 1]; ++i) {
      const int point = topology.face_points[static_cast<std::size_t>(i)];
      if (point < 0 || static_cast<std::size_t>(point) >= topology.points) {
        refuse(face_name(face) + " has the point " + std::to_string(point) + ", expected 0 to " +
               std::to_string(topology.points - 1));
      }
    }
  }
}

void check_cell_number(const MeshTopology& topology, std::size_t face, const char* role, int cell) {
  if (cell >= 0 && static_cast<std::size_t>(cell) < topology.cells) return;
  refuse(face_name(face) + " has the " + role + " cell " + std::to_string(cell) + ", expected 0 to " +
         std::to_string(topology.cells - 1));
}

void check_cells(const MeshTopology& topology) {
  std::vector<int> faces_of(topology.cells, 0);
  for (std::size_t face = 0; face < topology.faces(); ++face) {
    const int owner = topology.owner[face];
    check_cell_number(topology, face, "owner", owner);
    ++faces_of[static_cast<std::size_t>(owner)];
    if (face >= topology.internal_faces()) continue;
    const int neighbour = topology.neighbour[face];
    check_cell_number(topology, face, "neighbour", neighbour);
    if (neighbour <= owner) {
      refuse(face_name(face) + " has the owner " + std::to_string(owner) + " and the neighbour " +
             std::to_string(neighbour) + ", expected a neighbour above the owner");
    }
    ++faces_of[static_cast<std::size_t>(neighbour)];
  }
  for (std::size_t cell = 0; cell < topology.cells; ++cell) {
    if (faces_of[cell] < 4) {
      refuse("cell " + std::to_string(cell) + " has " + std::to_string(faces_of[cell]) +
             " faces, expected 4 or more");
    }
  }
}

void check_patches(const MeshTopology& topology) {
  std::size_t next = topology.internal_faces();
  for (const MeshPatch& patch : topology.patches) {
    if (patch.faces < 0 || patch.first < 0 || static_cast<std::size_t>(patch.first) != next) {
      refuse("patch '" + patch.name + "' has " + std::to_string(patch.faces) + " faces from " +
             std::to_string(patch.first) + ", expected to begin at face " + std::to_string(next));
    }
    next += static_cast<std::size_t>(patch.faces);
  }
  if (next != topology.faces()) {
    refuse("its patches end at face " + std::to_string(next) + ", expected to end at " +
           std::to_string(topology.faces()) + ", the number of faces");
  }
}

}  // namespace

void check(const MeshTopology& topology) {
  check_sizes(topology);
  check_corners(topology);
  check_cells(topology);
  check_patches(topology);
}

std::vector<std::array<int, 2>> neighbours(const MeshTopology& topology) {
  std::vector<std::array<int, 2>> pairs;
  pairs.reserve(topology.internal_faces());
  for (std::size_t face = 0; face < topology.internal_faces(); ++face) {
    pairs.push_back({topology.owner[face], topology.neighbour[face]});
  }
  return pairs;
}

}  // namespace millfoam::averaging
