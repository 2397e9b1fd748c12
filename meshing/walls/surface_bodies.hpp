// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "meshing/faces/face_geometry.hpp"
#include "meshing/surface/face_edges.hpp"

namespace millfoam::meshing {

/// Faces that are connected by edges with two faces.
struct Body {
  std::vector<int> faces;  ///< indices
  bool closed = true;      ///< no edge with one face, nor with more than two
  double volume = 0;       ///< m^3, signed, as its faces are oriented; without meaning unless closed
  int inside_of = 0;       ///< number of other bodies that contain it
  bool two_sided = true;   ///< false for a surface like Moebius' strip
};

/// The bodies of a surface.
struct Bodies {
  std::vector<Body> bodies;             ///< in the order of their first faces
  std::vector<int> against_neighbours;  ///< faces that were turned to face as the most of their body
};

/// Finds the bodies and orients each in itself: `faces` whose normal disagrees with the most of their body
/// are reversed.
Bodies find_bodies(const Points& points, const surface::EdgeTable& edges, std::vector<Face>& faces);

}  // namespace millfoam::meshing
