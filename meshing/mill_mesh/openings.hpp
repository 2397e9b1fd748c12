// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "meshing/mill/mill.hpp"
#include "meshing/mill_mesh/cross_section.hpp"

namespace millfoam::meshing {

/// What the quadrilaterals of a cross-section are in the mill's ends and behind them, and the areas (m^2)
/// that whole quadrilaterals give.
struct Openings {
  std::vector<bool> inlet;       ///< of each quadrilateral: lies in the inlet
  std::vector<bool> grates;      ///< of each quadrilateral: lies in a grate
  std::vector<int> compartment;  ///< of each quadrilateral: its pulp lifter, from 0; -1 inside the discharge
                                 ///< radius, and without pulp lifters
  double inlet_area = 0;         ///< 0 without an inlet
  double grate_area = 0;         ///< of all grates; 0 without
  double outlet_area = 0;        ///< of the pulp lifters' end inside the discharge radius
  double smallest_quad = 0;      ///< of the inlet and of that end; 0 without both
};

/// Largest relative error in area of an inlet that is made of whole quadrilaterals.
inline constexpr double allowed_inlet_error = 0.05;

/// Finds the openings in the mill's own cross-section. An inlet without a circle becomes the quadrilaterals
/// nearest to the axis whose area is nearest to the requested one, those at equal distances together. Sectors
/// and grates begin and end at the mesh's lines nearest to theirs; the numbers of columns in the grates are
/// chosen one after the other so that their sum stays within half a column of the requested area. Throws
/// KeyError where a sector has no column for its grate, and where an inlet without a circle is
/// wrong by more than allowed_inlet_error.
Openings find_openings(const CrossSection& section, const Geometry& geometry);

}  // namespace millfoam::meshing
