// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "meshing/walls/wall_surface.hpp"

namespace millfoam::meshing {

/// What CGAL finds of all parts together.
struct SurfaceCheck {
  bool closed = false;             ///< a manifold without boundary
  bool outward = false;            ///< bounds a volume, with normals pointing out of it
  bool self_intersecting = false;  ///< some triangles cross
  double volume = 0;               ///< enclosed, m^3; 0 when not closed
};

/// Checks the parts together with CGAL.
SurfaceCheck check_surface(const WallSurface& surface);

/// Checks that the parts together are closed, outward oriented and without self-intersection; throws
/// std::runtime_error saying which is not so. Returns the enclosed volume, m^3.
double require_watertight(const WallSurface& surface);

/// A triangle whose height over its longest side is less than this is a needle: LIGGGHTS computes contacts
/// with it badly.
inline constexpr double needle_ratio = 1e-3;

/// Height over the longest side of a triangle: 0.87 for an equal-sided one, 0 without area.
double flatness(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c);

/// The needles of all parts.
struct Needles {
  int count = 0;                                    ///< triangles flatter than needle_ratio
  double smallest_ratio = 1;                        ///< of all triangles, needles or not
  Eigen::Vector3d where = Eigen::Vector3d::Zero();  ///< middle of the triangle that has it, m
};

/// Looks for needles in all parts.
Needles find_needles(const WallSurface& surface);

/// Throws std::runtime_error with the worst triangle's place for a surface with needles.
void require_no_needles(const WallSurface& surface);

/// Largest relative difference between the volumes of walls and mesh.
inline constexpr double allowed_volume_difference = 1e-6;

/// Throws std::runtime_error when the walls enclose another volume than the flow's mesh, m^3, by more than
/// that.
void require_same_volume(double of_walls, double of_mesh);

}  // namespace millfoam::meshing
