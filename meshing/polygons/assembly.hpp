// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "meshing/polygons/polygon_set.hpp"
#include "meshing/volume/volume_mesh.hpp"

namespace millfoam::meshing {

/// The measures of a patch of an assembled mesh.
struct PatchMeasure {
  std::string name;       ///< of the group
  int faces = 0;          ///< at the boundary
  int between_cells = 0;  ///< faces of the same group that lie between two cells, in no patch
  double area = 0;        ///< m^2
};

/// A mesh made of polygons, and what was found on the way.
struct Assembly {
  PolyMesh mesh;                      ///< in OpenFOAM's order
  int points_joined = 0;              ///< points that were welded to another
  int points_unused = 0;              ///< points of no polygon, left out
  int baffles = 0;                    ///< pairs of faces with the same corners, a wall between two cells
  int points_separated = 0;           ///< points that such walls got for their second side
  int bodies = 0;                     ///< sets of cells that are connected by faces
  double volume = 0;                  ///< m^3
  double smallest_cell = 0;           ///< m^3
  double largest_cell = 0;            ///< m^3
  std::vector<std::string> warnings;  ///< sentences on what a missing face looks like
  std::vector<PatchMeasure> patches;  ///< of all groups with faces, `internal` too, which makes no patch
};

/// Finds the cells that polygons enclose.
///
/// Points nearer than `tolerance` (m; 0: 1e-9 of the bounding box's diagonal) become one. The polygons' sides
/// are joined to shells and these to cells (see Shells and ShellCells). Faces with a cell on one side only
/// are the boundary: their group is their patch. Cells are numbered from the first on by neighbourhood, faces
/// in OpenFOAM's order.
///
/// Two polygons that coincide are a baffle when they have points of their own in the set, neither is of the
/// group `internal`, and a cell lies on both sides: each side then has its boundary face, and cells that only
/// baffles part have points of their own.
///
/// Throws PolygonError that lists, with place and coordinates: faces with fewer than three points, repeated
/// points, no area or crossing sides; other doubled faces; holes (an edge with one face); T-junctions; faces
/// that overlap or cross; dangling faces (both sides in the same cell); non-manifold edges, around which the
/// same cell or the outside appears twice (bodies that touch in an edge only); shells that enclose nothing;
/// faces of the group `internal` at the boundary; groups whose name cannot name a patch.
Assembly assemble(const PolygonSet& set, double tolerance = 0);

}  // namespace millfoam::meshing
