// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "meshing/mill/mill.hpp"
#include "meshing/walls/wall_surface.hpp"

namespace millfoam::meshing {

/// The STL file of one part of a mill's walls.
struct PartFile {
  std::string part;            ///< shell, lifters, feedEnd or dischargeEnd
  std::filesystem::path file;  ///< STL, text or binary
};

/// What a surface from CAD is like, and what became of it. Each sentence names files, lines where they have a
/// meaning, and coordinates in m.
struct CadReport {
  int triangles = 0;                               ///< left after the repairs
  Eigen::Vector3d low = Eigen::Vector3d::Zero();   ///< of the bounding box, m
  Eigen::Vector3d high = Eigen::Vector3d::Zero();  ///< m
  double volume = 0;                               ///< enclosed, m^3; 0 unless closed
  std::vector<std::string> problems;               ///< why LIGGGHTS cannot use it
  std::vector<std::string> repairs;                ///< what was changed
  std::vector<std::string> warnings;               ///< what may be meant otherwise
  WallSurface surface;  ///< repaired, with all four parts, those not given without triangles

  /// Whether LIGGGHTS can use the repaired surface.
  bool usable() const { return problems.empty(); }
};

/// Reads the parts, coordinates times `scale`, and checks them together.
///
/// The walls of a periodic slice (`ends`) have no end parts, and are open at both: edges with one triangle
/// that lie at the smallest z or at the largest, to `tolerance`, and make closed rims, are allowed. The
/// volume is that between the rims' planes.
///
/// Repaired: corners nearer than `tolerance` (m; 0: 1e-6 of the bounding box's diagonal) become one;
/// triangles that lose a side by that are left out; triangles that face against their neighbours are turned;
/// so is each body whose normals point the wrong way: out of the mill's interior they must point, so out of
/// the outermost body, and into one inside another, as a lifter is.
///
/// Problems: edges with one triangle (also T-junctions) or more than two, doubled triangles, triangles
/// without area, a surface with one side only, triangles that cross (CGAL), a bounding box above 20 m, a part
/// of which the tolerance leaves no triangle.
///
/// Warnings: needles (see needle_ratio), several bodies, a tolerance above 1e-3 of the bounding box's
/// diagonal, a bounding box below 1 cm, one whose middle is off the axis x = y = 0 by more than a hundredth
/// of its width, or that does not begin at z = 0 to a hundredth of its length.
///
/// Throws PolygonError for a file that cannot be read, and std::runtime_error for a part that is unknown or
/// given twice, an end of a periodic slice, or a scale that is not above 0.
CadReport examine(const std::vector<PartFile>& parts, double scale = 1, double tolerance = 0,
                  Ends ends = Ends::plain);

}  // namespace millfoam::meshing
