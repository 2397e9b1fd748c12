// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace millfoam::averaging {

/// Faces of a mesh on one part of its boundary: [first, first + faces).
struct MeshPatch {
  std::string name;  ///< the boundary condition's
  int first = 0;     ///< its first face
  int faces = 0;     ///< their number
};

/// How the points of a mesh make faces and the faces make polyhedral cells, in OpenFOAM's order: internal
/// faces first; a face's normal, by the right-hand rule about its points, points out of its owner.
struct MeshTopology {
  std::size_t points = 0;          ///< their number
  std::size_t cells = 0;           ///< their number
  std::vector<int> face_begin;     ///< [faces + 1] where a face's points begin in face_points
  std::vector<int> face_points;    ///< point numbers of all faces
  std::vector<int> owner;          ///< [faces] cell
  std::vector<int> neighbour;      ///< [internal faces] cell, higher than the owner
  std::vector<MeshPatch> patches;  ///< of the boundary faces, in their order

  std::size_t faces() const { return owner.size(); }               ///< number of all faces
  std::size_t internal_faces() const { return neighbour.size(); }  ///< between two cells
};

using MeshPoints = std::vector<Eigen::Vector3d>;  ///< [points], m

/// Throws std::invalid_argument, naming the face, cell or patch, for a topology that is not one: numbers out
/// of range, faces of fewer than three points, a neighbour not above its owner, cells of fewer than four
/// faces, patches that do not cover the boundary faces in order.
void check(const MeshTopology& topology);

/// The pairs of cells that share an internal face, [internal faces], owner first.
std::vector<std::array<int, 2>> neighbours(const MeshTopology& topology);

}  // namespace millfoam::averaging
