// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "meshing/mill/mill.hpp"
#include "meshing/mill_mesh/cross_section.hpp"
#include "meshing/volume/volume_mesh.hpp"

namespace millfoam::meshing {

/// Cell zone of the pulp lifters, which balls do not reach.
inline constexpr const char* pulp_lifters_zone = "pulpLifters";

/// z of the ends of a mill's layers, m, `layers` + 1 numbers from 0 to `length`. The last layer is `last`
/// thick, at most length / layers, and each layer is the same number of times as thick as the next; 0: all
/// are equal.
std::vector<double> layer_ends(double length, int layers, double last);

/// Hexahedra that fill the mill at DEM time 0: its cross-section drawn along z in `layers` layers, whose ends
/// are layer_ends(), and on through the pulp lifters. The patches are, in this order,
/// - shell, lifters (without faces in a smooth drum), feedEnd (z = 0) and dischargeEnd (z = length); the two
///   ends are joined periodically where the mill's ends are periodic;
/// - inlet, the opening of the feed end;
/// - grates, those of the discharge end, or, with pulp lifters behind them, outlet (their end inside the
///   discharge radius) and pulpLifters (their other walls). The radial walls between them, and the discharge
///   end, then are pairs of faces, one for each side, with points of their own.
///
/// With pulp lifters the face zone `grates` holds the faces through which alone mill and compartments are
/// joined, and the cell zone `pulpLifters` holds all cells of the compartments. Throws KeyError for more than
/// most_cells.
VolumeMesh make_mill_mesh(const CrossSection& section, const Geometry& geometry, int layers,
                          double last_layer = 0);

}  // namespace millfoam::meshing
