// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "averaging/grids/box_grid.hpp"

namespace millfoam::averaging {

/// What the velocities on a cylinder are, and whether the cylinder turns.
struct CylinderFrame {
  /// Along r, theta and z at each ball's own place (`to_cylindrical`); otherwise along x, y and z. Both are
  /// velocities of the lab.
  bool cylindrical = false;
  /// rad/s about z, right-handed: the cylinder turns, and is in the lab's place at DEM time 0. Needs
  /// cylindrical velocities. Nothing: it is at rest in the lab.
  std::optional<double> angular_velocity = std::nullopt;
};

/// A cylinder about the lab's z axis (x = y = 0), or the shell between two radii, cut into equal steps of r,
/// theta and z. theta goes from +x towards +y, from 0 to 2 pi. A voxel holds its lower faces and not its
/// upper ones. Along z the cylinder may repeat without end. A cylinder that turns is described in its own
/// frame: all points here are that frame's; `in_own_frame` takes them there.
///
/// Fields on it are stored in C order [z][theta][r]: the voxel (i, j, k) along r, theta, z is entry
/// (k*ntheta + j)*nr + i.
class CylinderGrid {
 public:
  /// @param radii  inner, 0 or more, and outer, m
  /// @param ends   lower and upper z, m
  /// @param shape  voxels along r, theta, z
  /// @param periodic_z  whether it repeats along z
  /// @param frame  of the fields on it
  ///
  /// Throws std::invalid_argument for radii or ends that are not finite or not rising, a negative radius, a
  /// shape that is not positive, or a cylinder that turns without cylindrical velocities or with an angular
  /// velocity that is not finite.
  CylinderGrid(const std::array<double, 2>& radii, const std::array<double, 2>& ends, const VoxelIndex& shape,
               bool periodic_z = false, const CylinderFrame& frame = {});

  const std::array<double, 2>& radii() const { return radii_; }  ///< inner and outer, m
  const std::array<double, 2>& ends() const { return ends_; }    ///< lower and upper z, m
  const VoxelIndex& shape() const { return shape_; }             ///< along r, theta, z
  bool periodic_z() const { return periodic_z_; }                ///< whether it repeats along z
  const CylinderFrame& frame() const { return frame_; }          ///< of the fields on it
  const Vector3& spacing() const { return spacing_; }            ///< steps of r, theta, z: m, rad, m

  std::size_t size() const;                            ///< number of voxels
  double voxel_volume(const VoxelIndex& voxel) const;  ///< m^3

  /// Position of a voxel in a field.
  std::size_t offset(const VoxelIndex& voxel) const;

  /// The point in the middle of a voxel's steps of r, theta and z, as x, y, z, m.
  Vector3 centre(const VoxelIndex& voxel) const;

  /// A point of the lab in the grid's own frame at a DEM time, s: turned back by the grid's angle.
  Vector3 in_own_frame(const Vector3& point, double time) const;

  /// The point's image within the ends where the grid is periodic; other components are left as they are.
  Vector3 wrapped(const Vector3& point) const;

  /// The voxel that holds the point or, where the grid is periodic, its image; nothing when it lies outside.
  std::optional<VoxelIndex> locate(const Vector3& point) const;

 private:
  std::array<double, 2> radii_;
  std::array<double, 2> ends_;
  VoxelIndex shape_;
  bool periodic_z_;
  CylinderFrame frame_;
  Vector3 spacing_{};
};

}  // namespace millfoam::averaging
