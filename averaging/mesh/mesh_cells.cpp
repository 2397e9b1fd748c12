// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/mesh/mesh_cells.hpp"

namespace millfoam::averaging {

namespace {

/// The mark of a polyhedron in XDMF's mixed topology; its number of faces follows, then each face.
constexpr long long polyhedron = 16;

void append_face(const MeshTopology& topology, std::size_t face, std::vector<long long>& list) {
  const int begin = topology.face_begin[face], end = topology.face_begin[face + 1];
  list.push_back(end - begin);
  for (int p = begin; p < end; ++p) list.push_back(topology.face_points[static_cast<std::size_t>(p)]);
}

}  // namespace

MeshCells mesh_cells(const MeshGeometry& mesh) {
  MeshCells cells;
  cells.volumes = mesh.volumes();
  for (std::size_t p = 0; p < mesh.topology().points; ++p) {
    const Eigen::Vector3d& point = mesh.points()[p];
    cells.points.insert(cells.points.end(), {point.x(), point.y(), point.z()});
  }
  for (std::size_t c = 0; c < mesh.cells(); ++c) {
    const auto [first, last] = mesh.faces_of(static_cast<int>(c));
    cells.topology.push_back(polyhedron);
    cells.topology.push_back(last - first);
    for (const int* face = first; face != last; ++face) {
      append_face(mesh.topology(), static_cast<std::size_t>(*face), cells.topology);
    }
  }
  return cells;
}

}  // namespace millfoam::averaging
