// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "averaging/values/vector3.hpp"

namespace millfoam::averaging {

/// Numbers of a voxel along x, y, z, each from 0 to the shape along that axis minus one.
using VoxelIndex = std::array<int, 3>;

/// A box, fixed in the lab frame, cut into equal voxels. A voxel holds its lower faces and not its upper
/// ones, so every point of [lower, upper) lies in exactly one voxel. Along a periodic axis the box repeats
/// without end.
///
/// Fields on it are stored in C order [z][y][x]: the voxel (i, j, k) is entry (k*ny + j)*nx + i.
class BoxGrid {
 public:
  /// @param lower, upper  corners, m
  /// @param shape         voxels along x, y, z
  /// @param periodic      axes along which the box repeats
  ///
  /// Throws std::invalid_argument when a corner is not finite, `upper` is not above `lower`, or a shape is
  /// not positive.
  BoxGrid(const Vector3& lower, const Vector3& upper, const VoxelIndex& shape,
          const std::array<bool, 3>& periodic = {false, false, false});

  const Vector3& lower() const { return lower_; }                    ///< corner, m
  const Vector3& upper() const { return upper_; }                    ///< corner, m
  const VoxelIndex& shape() const { return shape_; }                 ///< voxels along x, y, z
  const std::array<bool, 3>& periodic() const { return periodic_; }  ///< along x, y, z
  const Vector3& spacing() const { return spacing_; }                ///< edges of a voxel, m

  std::size_t size() const;     ///< number of voxels
  double voxel_volume() const;  ///< m^3

  /// Position of a voxel in a field.
  std::size_t offset(const VoxelIndex& voxel) const;

  /// Centre of a voxel, m.
  Vector3 centre(const VoxelIndex& voxel) const;

  /// The point's image within [lower, upper) along the periodic axes; other components are left as they are.
  Vector3 wrapped(const Vector3& point) const;

  /// The voxel that holds the point or, along periodic axes, its image; nothing when the point lies outside.
  std::optional<VoxelIndex> locate(const Vector3& point) const;

 private:
  Vector3 lower_;
  Vector3 upper_;
  VoxelIndex shape_;
  std::array<bool, 3> periodic_;
  Vector3 spacing_{};
};

}  // namespace millfoam::averaging
