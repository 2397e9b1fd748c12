// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "meshing/wall_surface.hpp"

namespace millfoam::meshing {

/// What CGAL finds of all parts together.
struct SurfaceCheck {
  bool closed = false;             ///< a manifold without boundary
  bool outward = false;            ///< bounds a volume, with normals pointing out of it
  bool self_intersecting = false;  ///< some triangles cross
  double volume = 0;               ///< enclosed, m^3; 0 when not closed
};
SurfaceCheck check_surface(const WallSurface& surface);

/// Checks that the parts together are closed, outward oriented and without self-intersection; throws
/// std::runtime_error saying which is not so. Returns the enclosed volume, m^3.
double require_watertight(const WallSurface& surface);

}  // namespace millfoam::meshing
