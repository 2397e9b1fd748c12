// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "averaging/overlap/sphere_box.hpp"
#include "averaging/sharing/box_sharing.hpp"

namespace millfoam::averaging {

/// Shares spheres between the voxels of a box by their exact volumes in them (`SphereBoxes`): a sphere's
/// shares add up to its volume within a few roundings, and a voxel that it does not meet gets none.
class BoxExact : public BoxSharing {
 public:
  /// @param template_points  points along a diameter for superquadrics, which are sampled
  explicit BoxExact(const BoxGrid& grid, int template_points = 12) : BoxSharing(grid, template_points) {}

  std::unique_ptr<CellSharing> clone() const override { return std::make_unique<BoxExact>(*this); }

  /// Throws as `CellAxis::cut`.
  using BoxSharing::share;
  void share(const Particle& sphere, std::vector<Share>& shares) override;

 private:
  SphereBoxes boxes_;
  std::array<std::vector<double>, 3> planes_;  ///< between the voxels met, relative to the centre
  std::array<std::vector<int>, 3> voxels_;     ///< voxels met along each axis
};

}  // namespace millfoam::averaging
