// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <set>
#include <vector>

#include "meshing/polygons/polygon_check.hpp"

namespace millfoam::meshing {

/// Polygons of which pairs that coincide are taken for the two sides of a baffle, a wall without thickness
/// between two cells.
struct FacePairs {
  PolygonSet set;           ///< without the second polygon of each pair; numbers are those of the whole set
  std::vector<Face> faces;  ///< welded, of the polygons in `set`
  std::vector<int> one;     ///< for each polygon in `set`, its index in the whole set
  std::vector<int> other;   ///< and that of the one that coincides with it; -1 for none
};

/// Finds the pairs: two polygons, of groups other than `internal`, whose points are welded to the same but
/// are not the same in the file. All others that coincide are problems; `refused` are passed over.
FacePairs find_pairs(const WeldedSet& whole, const std::set<int>& refused, Problems& problems);

/// The groups of a pair on both sides of the first polygon. A polygon is on the side of the cell with whose
/// other faces it shares more points in the file; that is not known where groups differ and points do not.
struct PairGroups {
  int in_front = 0;   ///< group of the side that the first polygon's normal points into
  int behind = 0;     ///< group of the other side
  bool known = true;  ///< false where the file does not show which group is on which side
};

/// One for each polygon of `pairs.set`; those without another have no meaning. `cell_of_side` has two entries
/// a polygon, see FaceSideNumber.
std::vector<PairGroups> groups_of_sides(const PolygonSet& whole, const FacePairs& pairs,
                                        const std::vector<int>& cell_of_side);

}  // namespace millfoam::meshing
