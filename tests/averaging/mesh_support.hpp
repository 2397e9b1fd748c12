// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "averaging/mesh/mesh_geometry.hpp"
#include "averaging/mesh/poly_mesh.hpp"
#include "meshing/surface/pi.hpp"

/// Meshes made in memory.
namespace millfoam::averaging {

struct TestMesh {
  MeshTopology topology;
  MeshPoints points;
};

/// Corners of a face, anticlockwise seen from outside its cell.
using TestFace = std::vector<int>;

/// Names the patch of a boundary face by its mean point.
using PatchNames = std::function<std::string(const Eigen::Vector3d&)>;

inline std::string one_patch(const Eigen::Vector3d&) {
  return "walls";
}

/// Puts cells, each a list of faces, together: faces of the same points are one internal face.
inline TestMesh assemble(const MeshPoints& points, const std::vector<std::vector<TestFace>>& cells,
                         const PatchNames& patch_of = one_patch) {
  struct Found {
    TestFace corners;
    int owner;
    int neighbour = -1;
  };
  std::map<TestFace, Found> found;
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    for (const TestFace& face : cells[cell]) {
      TestFace key = face;
      std::sort(key.begin(), key.end());
      const auto [entry, is_new] = found.try_emplace(key, Found{face, static_cast<int>(cell)});
      if (!is_new) entry->second.neighbour = static_cast<int>(cell);
    }
  }
  std::map<std::string, std::vector<const Found*>> boundary;
  std::vector<const Found*> ordered;
  for (const auto& [key, face] : found) {
    if (face.neighbour >= 0) {
      ordered.push_back(&face);
      continue;
    }
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const int corner : face.corners) mean += points[static_cast<std::size_t>(corner)];
    boundary[patch_of(mean / static_cast<double>(face.corners.size()))].push_back(&face);
  }
  std::sort(ordered.begin(), ordered.end(), [](const Found* a, const Found* b) {
    return std::make_pair(a->owner, a->neighbour) < std::make_pair(b->owner, b->neighbour);
  });
  TestMesh mesh;
  mesh.points = points;
  mesh.topology.points = points.size();
  mesh.topology.cells = cells.size();
  for (const Found* face : ordered) mesh.topology.neighbour.push_back(face->neighbour);
  for (const auto& [name, faces] : boundary) {
    mesh.topology.patches.push_back({name, static_cast<int>(ordered.size()), static_cast<int>(faces.size())});
    ordered.insert(ordered.end(), faces.begin(), faces.end());
  }
  mesh.topology.face_begin.push_back(0);
  for (const Found* face : ordered) {
    mesh.topology.owner.push_back(face->owner);
    mesh.topology.face_points.insert(mesh.topology.face_points.end(), face->corners.begin(),
                                     face->corners.end());
    mesh.topology.face_begin.push_back(static_cast<int>(mesh.topology.face_points.size()));
  }
  return mesh;
}

/// Faces of a hexahedron with corners 0 1 2 3 around its lower end and 4 5 6 7 above them.
inline std::vector<TestFace> hexahedron(const std::array<int, 8>& c) {
  return {{c[0], c[3], c[2], c[1]}, {c[4], c[5], c[6], c[7]}, {c[0], c[1], c[5], c[4]},
          {c[1], c[2], c[6], c[5]}, {c[2], c[3], c[7], c[6]}, {c[3], c[0], c[4], c[7]}};
}

/// The hexahedra over a box grid, in the order of the grid's voxels.
inline TestMesh box_mesh(const Eigen::Vector3d& lower, const Eigen::Vector3d& upper,
                         const std::array<int, 3>& n, const PatchNames& patch_of = one_patch) {
  const auto point = [&](int i, int j, int k) { return (k * (n[1] + 1) + j) * (n[0] + 1) + i; };
  MeshPoints points;
  for (int k = 0; k <= n[2]; ++k) {
    for (int j = 0; j <= n[1]; ++j) {
      for (int i = 0; i <= n[0]; ++i) {
        const Eigen::Vector3d part(double(i) / n[0], double(j) / n[1], double(k) / n[2]);
        points.push_back(lower + part.cwiseProduct(upper - lower));
      }
    }
  }
  std::vector<std::vector<TestFace>> cells;
  for (int k = 0; k < n[2]; ++k) {
    for (int j = 0; j < n[1]; ++j) {
      for (int i = 0; i < n[0]; ++i) {
        cells.push_back(hexahedron({point(i, j, k), point(i + 1, j, k), point(i + 1, j + 1, k),
                                    point(i, j + 1, k), point(i, j, k + 1), point(i + 1, j, k + 1),
                                    point(i + 1, j + 1, k + 1), point(i, j + 1, k + 1)}));
      }
    }
  }
  return assemble(points, cells, patch_of);
}

/// A drum of a radius and length about the z axis from z = 0: n x n cells in its core, `rings` of 4 n cells
/// around it, all extruded into `layers`. Patches: back (z = 0), front, shell.
inline TestMesh drum_mesh(double radius, double length, int n, int rings, int layers) {
  std::vector<Eigen::Vector2d> plane;
  std::map<std::pair<long, long>, int> numbers;
  const auto number = [&](const Eigen::Vector2d& p) {
    const double grain = 1e-7 * radius;
    const auto [entry, is_new] = numbers.try_emplace({std::lround(p.x() / grain), std::lround(p.y() / grain)},
                                                     static_cast<int>(plane.size()));
    if (is_new) plane.push_back(p);
    return entry->second;
  };
  std::vector<std::array<int, 4>> quads;
  const double core = 0.4 * radius;
  const auto square = [&](int i, int j) -> Eigen::Vector2d {
    return core * Eigen::Vector2d(2.0 * i / n - 1, 2.0 * j / n - 1);
  };
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      quads.push_back({number(square(i, j)), number(square(i + 1, j)), number(square(i + 1, j + 1)),
                       number(square(i, j + 1))});
    }
  }
  const double quarter = std::acos(0.0);
  const auto ring = [&](int side, int i, int r) -> Eigen::Vector2d {
    const Eigen::Vector2d inner = square(n, i);
    const double angle = quarter / 2 * (2.0 * i / n - 1);
    const Eigen::Vector2d outer = radius * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    const Eigen::Vector2d p = inner + double(r) / rings * (outer - inner);
    const std::array<Eigen::Vector2d, 4> turned{p, {-p.y(), p.x()}, {-p.x(), -p.y()}, {p.y(), -p.x()}};
    return turned[static_cast<std::size_t>(side)];
  };
  for (int side = 0; side < 4; ++side) {
    for (int i = 0; i < n; ++i) {
      for (int r = 0; r < rings; ++r) {
        quads.push_back({number(ring(side, i, r)), number(ring(side, i, r + 1)),
                         number(ring(side, i + 1, r + 1)), number(ring(side, i + 1, r))});
      }
    }
  }
  MeshPoints points;
  std::vector<std::vector<TestFace>> cells;
  const int per_layer = static_cast<int>(plane.size());
  for (int k = 0; k <= layers; ++k) {
    for (const Eigen::Vector2d& p : plane) points.emplace_back(p.x(), p.y(), length * k / layers);
  }
  for (int k = 0; k < layers; ++k) {
    for (const auto& q : quads) {
      const int b = k * per_layer, t = b + per_layer;
      cells.push_back(
          hexahedron({b + q[0], b + q[1], b + q[2], b + q[3], t + q[0], t + q[1], t + q[2], t + q[3]}));
    }
  }
  return assemble(points, cells, [=](const Eigen::Vector3d& p) -> std::string {
    if (p.z() < 1e-9 * length) return "back";
    return p.z() > (1 - 1e-9) * length ? "front" : "shell";
  });
}

/// Hexagonal prisms, their centres in rows of nx, ny rows, in layers along z.
inline TestMesh honeycomb_mesh(int nx, int ny, int layers, double size) {
  std::vector<Eigen::Vector2d> plane;
  std::map<std::pair<long, long>, int> numbers;
  std::vector<std::array<int, 6>> hexagons;
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i) {
      const Eigen::Vector2d centre(std::sqrt(3.0) * size * (i + 0.5 * (j % 2)), 1.5 * size * j);
      std::array<int, 6> corners{};
      for (std::size_t c = 0; c < 6; ++c) {
        const double angle = pi / 6 + pi / 3 * static_cast<double>(c);
        const Eigen::Vector2d p = centre + size * Eigen::Vector2d(std::cos(angle), std::sin(angle));
        const auto [entry, is_new] = numbers.try_emplace(
            {std::lround(p.x() / size * 1e6), std::lround(p.y() / size * 1e6)}, int(plane.size()));
        if (is_new) plane.push_back(p);
        corners[c] = entry->second;
      }
      hexagons.push_back(corners);
    }
  }
  MeshPoints points;
  const int per_layer = static_cast<int>(plane.size());
  for (int k = 0; k <= layers; ++k) {
    for (const Eigen::Vector2d& p : plane) points.emplace_back(p.x(), p.y(), size * k);
  }
  std::vector<std::vector<TestFace>> cells;
  for (int k = 0; k < layers; ++k) {
    const int b = k * per_layer, t = b + per_layer;
    for (const auto& h : hexagons) {
      std::vector<TestFace> faces(2);
      for (std::size_t c = 0; c < 6; ++c) {
        faces[0].push_back(b + h[5 - c]);
        faces[1].push_back(t + h[c]);
        const int from = h[c], to = h[(c + 1) % 6];
        faces.push_back({b + from, b + to, t + to, t + from});
      }
      cells.push_back(faces);
    }
  }
  return assemble(points, cells);
}

/// The mesh with every point moved by up to `most` along each axis, so that its faces are warped.
inline TestMesh warped(TestMesh mesh, double most, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> shift(-most, most);
  for (Eigen::Vector3d& point : mesh.points) {
    for (Eigen::Index axis = 0; axis < 3; ++axis) point[axis] += shift(random);
  }
  return mesh;
}

/// The mesh with cells joined: `into[cell]` is the number, from 0, of the joined cell that it becomes a part
/// of.
inline TestMesh joined(const TestMesh& mesh, const std::vector<int>& into) {
  const MeshTopology& old = mesh.topology;
  std::vector<std::vector<TestFace>> cells(
      static_cast<std::size_t>(1 + *std::max_element(into.begin(), into.end())));
  for (std::size_t face = 0; face < old.faces(); ++face) {
    TestFace corners(old.face_points.begin() + old.face_begin[face],
                     old.face_points.begin() + old.face_begin[face + 1]);
    const int owner = into[static_cast<std::size_t>(old.owner[face])];
    if (face < old.internal_faces()) {
      const int neighbour = into[static_cast<std::size_t>(old.neighbour[face])];
      if (neighbour == owner) continue;
      cells[static_cast<std::size_t>(neighbour)].emplace_back(corners.rbegin(), corners.rend());
    }
    cells[static_cast<std::size_t>(owner)].push_back(corners);
  }
  return assemble(mesh.points, cells);
}

inline MeshGeometry geometry_of(const TestMesh& mesh) {
  return {mesh.topology, mesh.points};
}

}  // namespace millfoam::averaging
