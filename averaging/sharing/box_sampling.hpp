// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "averaging/overlap/sphere_template.hpp"
#include "averaging/sharing/box_sharing.hpp"

namespace millfoam::averaging {

/// Shares spheres between the voxels of a box by sampling: a voxel gets the share of a sphere's volume that
/// the share of the template's points in it is; a sphere wholly in one voxel gives it exactly its volume.
///
/// The template's coordinates along an axis do not depend on those along the others, so the points in a voxel
/// are a block of the lattice, counted by a table: the cost is a few look-ups per voxel met, whatever the
/// template's size.
class BoxSampling : public BoxSharing {
 public:
  /// @param template_points  along a diameter. Throws as SphereTemplate.
  explicit BoxSampling(const BoxGrid& grid, int template_points = 12);

  std::unique_ptr<CellSharing> clone() const override { return std::make_unique<BoxSampling>(*this); }

  using BoxSharing::share;
  void share(const Particle& sphere, std::vector<Share>& shares) override;

 private:
  /// Neighbouring layers of the template's lattice that fall into one voxel along an axis.
  struct Run {
    int voxel;  ///< number along the axis, negative outside
    SphereTemplate::Layers layers;
  };

  void cut_layers(std::size_t axis, double centre, double radius);

  std::shared_ptr<const SphereTemplate> points_;
  std::array<std::vector<Run>, 3> runs_;
};

}  // namespace millfoam::averaging
