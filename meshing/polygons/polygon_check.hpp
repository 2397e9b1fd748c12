// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "meshing/polygons/face_shells.hpp"
#include "meshing/polygons/polygon_set.hpp"
#include "meshing/surface/face_edges.hpp"

namespace millfoam::meshing {

/// Sentences about what is wrong, of each kind at most ten and then their number.
class Problems {
 public:
  /// Adds a sentence; those of one `kind` are kept together.
  void add(const std::string& kind, const std::string& sentence);
  /// All sentences, kinds in the order in which they were first added.
  std::vector<std::string> sentences() const;
  /// Throws PolygonError with all sentences, one a line, if there are any.
  void stop() const;

 private:
  std::vector<std::string> kinds_;
  std::map<std::string, std::vector<std::string>> sentences_of_;
  std::map<std::string, std::size_t> count_;
};

/// A set of polygons after welding: its faces are the polygons in their order.
struct WeldedSet {
  const PolygonSet& set;    ///< before welding
  Points points;            ///< those that are kept, m
  std::vector<Face> faces;  ///< indices in `points`
};

// Each of these adds what it finds to the problems; assemble() says what they look for.

/// Names of groups that cannot name a patch.
void check_groups(const PolygonSet& set, Problems& problems);

/// Polygons that are not faces. Returns their indices.
std::set<int> check_faces(const WeldedSet& welded, Problems& problems);

/// Polygons with the same points.
void check_doubled(const WeldedSet& welded, Problems& problems);

/// One pair of such polygons.
void add_doubled(const WeldedSet& welded, int face, int other, Problems& problems);

/// Edges with one face, and T-junctions, which explain most of those.
void check_closed(const WeldedSet& welded, const surface::EdgeTable& edges, Problems& problems);

/// Faces that overlap at an edge, or cross.
void check_crossings(const WeldedSet& welded, const surface::EdgeTable& edges,
                     const std::vector<Overlap>& overlaps, Problems& problems);

/// Faces with the same cell on both sides. `cell_of_side` has two entries a face, see FaceSideNumber.
void check_dangling(const WeldedSet& welded, const std::vector<int>& cell_of_side, Problems& problems);

/// Edges around which the same cell, or the outside, appears more than once.
void check_manifold(const WeldedSet& welded, const surface::EdgeTable& edges,
                    const std::vector<int>& cell_of_side, Problems& problems);

/// Polygons of the group `internal` with a cell on one side only.
void check_internal(const WeldedSet& welded, const std::vector<int>& cell_of_side, Problems& problems);

// No errors, but what a missing face looks like.

/// Faces at the boundary of groups that have more faces between two cells, unless one group holds the whole
/// boundary.
void warn_of_rare_boundary(const WeldedSet& welded, const std::vector<int>& cell_of_side, Problems& warnings);

/// Cells with several faces between them.
void warn_of_shared_faces(const WeldedSet& welded, const std::vector<int>& cell_of_side, Problems& warnings);

/// Cells with more faces than the others, where 99 % of the cells have the same number.
void warn_of_merged_cells(const WeldedSet& welded, const std::vector<int>& cell_of_side, Problems& warnings);

/// Numbers of faces with the same points, in groups of two or more; those passed over are in none.
std::vector<std::vector<int>> faces_of_equal_points(const std::vector<Face>& faces,
                                                    const std::set<int>& passed_over);

}  // namespace millfoam::meshing
