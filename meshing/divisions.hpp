// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "meshing/mill.hpp"

namespace millfoam::meshing {

/// How many cells each block of a CrossSection has along its sides.
struct Divisions {
  int lifter = 0;  ///< along a lifter's top; 0 for a smooth drum
  int gap = 0;     ///< along the shell between two lifters; 0 for a smooth drum
  int height = 0;  ///< along a lifter's side; 0 for a smooth drum
  int core = 0;    ///< along a side of the core: a quarter of the perimeter
  int ring = 0;    ///< between the core and the lifters' tops
};

/// Divisions whose cells are about `cell_size` (m) wide on the lifters and the shell. The perimeter is a
/// multiple of four, as the core needs, and no cell spans more than a fortieth of the shell, so that the
/// facets of the shell stay within 0.42 % of the circle's area.
Divisions choose_divisions(const Geometry& geometry, double cell_size);

}  // namespace millfoam::meshing
