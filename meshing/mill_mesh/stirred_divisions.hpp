// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "meshing/mill/mill.hpp"

namespace millfoam::meshing {

/// A block of cells, from one line of the grid to another, that an impeller's part takes.
struct LineSpan {
  int first = 0;  ///< number of the line at which it begins
  int last = 0;   ///< of that at which it ends
};

/// The lines of a stirred mill's rings of cells: radii, heights, and columns around the axis.
struct StirredDivisions {
  std::vector<double> radii;        ///< m, of the lines around the axis, from the shaft to the shell
  std::vector<double> heights;      ///< m, from the base to the lid
  int around = 0;                   ///< columns of cells, a multiple of four
  int core_layers = 0;              ///< of cells between the O-grid's core and the shaft's radius
  int across_pin = 0;               ///< columns of cells that a pin takes, even
  int up_pin = 0;                   ///< rows of cells that a pin takes, even
  int shaft_end = 0;                ///< number of the height of the shaft's end
  std::vector<LineSpan> pin_rows;   ///< of each level of pins, numbers of heights
  std::vector<int> pin_tips;        ///< of each level of pins, number of the tips' radius
  std::vector<LineSpan> disc_rows;  ///< of each disc, numbers of heights
  std::vector<int> disc_rims;       ///< of each disc, number of its radius
};

/// Half the width of the block that a pin takes, across its axis and horizontally, over the pin's radius: the
/// block's four edges lie on the pin's circle, and its cells' sides take equal arcs of it.
double pin_half_width(const StirredDivisions& divisions);

/// The same along z.
double pin_half_height(const StirredDivisions& divisions);

/// Divisions whose cells are about `cell_size` (m) wide between shaft and tips.
StirredDivisions stirred_divisions(const Geometry& geometry, double cell_size);

}  // namespace millfoam::meshing
