// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace millfoam::meshing {

/// A file of polygons that cannot be read, or whose polygons do not bound cells. The message has one sentence
/// a line, each with the file, the line where it is known, and coordinates.
struct PolygonError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// One polygon of a PolygonSet.
struct Polygon {
  std::vector<int> points;  ///< indices in the order around it; the orientation has no meaning
  int group = 0;            ///< index of its group
  int line = 0;             ///< in the file, from 1; 0 where lines have no meaning (binary files)
  int number = 0;           ///< in its file, from 1; 0 where that is the number in the set
};

/// Polygons in space, as a file gives them: no cells, no order, any orientation.
struct PolygonSet {
  std::string source;                   ///< the file's name, for messages
  std::vector<Eigen::Vector3d> points;  ///< m
  std::vector<Polygon> polygons;        ///< in the order of the file
  std::vector<std::string> groups;      ///< names, in the order in which the file gives them
  std::set<std::string> open;           ///< groups whose patches are of the type `patch`, not walls
  std::vector<std::string> files;       ///< of each group, where each comes from its own; otherwise empty
};

/// The group of a polygon that has none in its file.
inline constexpr const char* default_group = "walls";
/// The group whose polygons lie between two cells. It makes no patch; one at the boundary is an error.
inline constexpr const char* internal_group = "internal";

/// The place of a polygon, as in `faces.obj:12` or `faces.ply: face 3`.
std::string place(const PolygonSet& set, int polygon);

/// The index of the group of a name, which is added if it is new.
int group_index(PolygonSet& set, const std::string& name);

}  // namespace millfoam::meshing
