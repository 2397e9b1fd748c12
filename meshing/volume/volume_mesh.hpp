// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

namespace millfoam::meshing {

/// Four point indices; the normal is right-handed about their order.
using Quad = std::array<int, 4>;

/// Faces at the mesh's boundary, one after the other.
struct Patch {
  std::string name;       ///< as in OpenFOAM's `boundary`
  int start = 0;          ///< index of the first face
  int size = 0;           ///< number of faces, which may be 0
  std::string neighbour;  ///< name of the patch that this one is joined to periodically; empty for a wall
  bool open = false;      ///< fluid may pass: not a wall
};

/// Cells or faces between two cells that the flow treats alike.
struct Zone {
  std::string name;          ///< as in OpenFOAM's cellZones and faceZones
  std::vector<int> members;  ///< indices, ascending
};

/// Cells bounded by faces of type `Face`, a list of point indices, in the order that OpenFOAM needs: first
/// the faces between two cells, sorted by owner and then by neighbour, with owner < neighbour; then the
/// patches' faces. A face's normal points out of its owner. In a pair of periodic patches face i matches face
/// i, and their first points match.
template <typename Face>
struct MeshOf {
  std::vector<Eigen::Vector3d> points;  ///< m
  std::vector<Face> faces;              ///< indices in `points`
  std::vector<int> owner;               ///< cell of each face
  std::vector<int> neighbour;           ///< other cell of each face between two
  std::vector<Patch> patches;           ///< in the order of their faces
  int cells = 0;                        ///< number of cells
  std::vector<Zone> cell_zones;         ///< members are cells
  std::vector<Zone> face_zones;         ///< members are faces
};

/// A mesh whose faces are quadrilaterals.
using VolumeMesh = MeshOf<Quad>;

/// A mesh whose faces are polygons of any number of points.
using PolyMesh = MeshOf<std::vector<int>>;

/// The same mesh turned by `angle` (rad, right-handed) about the z axis.
VolumeMesh turned(VolumeMesh mesh, double angle);

}  // namespace millfoam::meshing
