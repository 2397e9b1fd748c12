// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "meshing/mill/mill.hpp"
#include "meshing/mill_mesh/cross_section.hpp"

namespace millfoam::meshing {

/// The cross-section of a mill whose lifters do not overlap (as read_mill makes sure), by cell size or
/// counts.
CrossSection make_cross_section(const Geometry& geometry, const Resolution& resolution);

}  // namespace millfoam::meshing
