// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "meshing/mill_mesh/cross_section.hpp"

namespace millfoam::meshing {

// The O-grid inside a closed ring of points about the axis. The core's corners lie at 0.75 of the ring's
// smallest radius and its sides are arcs that turn by 30 degrees, so that each corner has 120 degrees, like
// the two cells of the ring that meet there. Points inside the core are a Coons patch of its sides, those of
// the ring lie on straight lines (W. J. Gordon and C. A. Hall, Int. J. Numer. Methods Eng. 7, 461 (1973)).

/// Distances between the core and a ring.
struct RingThickness {
  double least = 0;  ///< m, at the core's corners
  double most = 0;   ///< m, at the middles of the core's sides
};

/// The thickness of the ring whose smallest radius is `radius`, m.
RingThickness ring_thickness(double radius);

/// Layers of cells between core and ring that would make them as thick as they are wide. `radius` is the
/// ring's smallest, m, `side` the number of cells along a side of the core.
double ring_layers(double radius, int side);

/// Radius, m, inside the row that halves the `around` columns inside a circle of `radius`, m. The row is
/// twice as thick as its cells are wide at the circle.
double radius_inside_halving(double radius, int around);

/// Adds the row of cells that halves the columns inside a closed ring of points, six for every four columns.
/// `outer` are the indices of the ring's points, anticlockwise, a multiple of eight. Returns those of the
/// ring inside the row: one opposite each second point, the first opposite `outer[first]`. The columns of the
/// row are -1.
std::vector<int> add_halving(CrossSection& section, const std::vector<int>& outer, int first);

/// Adds core and ring to a section. `rim` are the indices of the ring's points, anticlockwise, four times as
/// many as the core has cells along a side; the first corner of the core is opposite `rim[first_corner]`.
/// `layers` are the ring's.
void add_o_grid(CrossSection& section, const std::vector<int>& rim, int first_corner, int layers);

/// Adds the cells between two closed rings of points to a section, in `layers` layers: points on straight
/// lines between `inner[p]` and `outer[p]`, indices of points in `section`. The p-th of the columns is
/// numbered `first_column` + p.
void add_band(CrossSection& section, const std::vector<int>& inner, const std::vector<int>& outer, int layers,
              int first_column);

}  // namespace millfoam::meshing
