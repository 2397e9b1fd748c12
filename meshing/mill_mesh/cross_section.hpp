// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace millfoam::meshing {

/// How many cells each block of a CrossSection has along its sides.
struct Divisions {
  int lifter = 0;          ///< along a lifter's top; 0 for a smooth drum
  int gap = 0;             ///< along the shell between two lifters; 0 for a smooth drum
  int height = 0;          ///< along a lifter's side; 0 for a smooth drum
  int core = 0;            ///< along a side of the core: a quarter of the perimeter, or an eighth
  std::vector<int> bands;  ///< between the core and the lifters' tops: in each band between two circles
                           ///< (opening_circles), from the core outwards
  bool halved = false;     ///< an eighth: a row of cells inside the smallest circle halves the columns
};

/// Quadrilaterals that fill the mill's cross-section at DEM time 0, the lifters left out.
///
/// Three blocks, from the axis outwards: a square core with bulging sides; a ring of cells from the core to
/// the lifters' tops (an O-grid: the core's corners are its four irregular points); and between each two
/// lifters a block up to the shell whose outer lines end at the lifters' sides. A smooth drum has no such
/// blocks: its ring ends at the shell.
///
/// Where the mill has openings, the ring consists of bands between their circles (opening_circles), and the
/// core lies inside the smallest. The points of a circle are equally spaced and lie so far outside it that
/// their polygon has the circle's area. Inside a small circle all columns would make cells much smaller than
/// elsewhere. A row of cells may halve their number there.
struct CrossSection {
  /// What a side on a wall belongs to.
  enum class Part { shell, lifters };
  /// A side of one quadrilateral that lies on a wall; the interior is to the left of the way from the first
  /// point to the second.
  struct WallEdge {
    std::array<int, 2> points;  ///< indices in `points`
    Part part;                  ///< of the wall
  };

  std::vector<Eigen::Vector2d> points;    ///< m; those on the shell lie on its circle
  std::vector<std::array<int, 4>> quads;  ///< anticlockwise
  std::vector<int> columns;     ///< of each quadrilateral: its column around the axis, between the lines
                                ///< `column` and `column` + 1; -1 in the core,
                                ///< and inside the smallest circle of halved columns
  std::vector<WallEdge> walls;  ///< all sides on shell and lifters
  Divisions divisions;          ///< from which the quadrilaterals were made

  /// Number of columns.
  int around() const { return (divisions.halved ? 8 : 4) * divisions.core; }
  /// Angle, rad, of line 0 on the openings' circles; the line ends at lifter 1's first corner.
  double first_line_angle() const;
};

}  // namespace millfoam::meshing
