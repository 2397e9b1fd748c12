// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "averaging/deposition/box_deposition.hpp"
#include "averaging/overlap/sphere_template.hpp"

namespace millfoam::averaging {

/// Deposits spheres in the voxels of a box by sampling: a voxel gets the same fraction of a sphere's
/// volume as of the template's points; a sphere wholly in one voxel gives it exactly its volume.
///
/// The template's coordinates along an axis do not depend on those along the others, so the points in a voxel
/// are a block of the lattice, counted by a table: the cost is a few look-ups per voxel met,
/// independent of the template's size.
class SampledBoxDeposition : public BoxDeposition {
 public:
  /// @param grid             where balls are deposited; it is copied
  /// @param template_points  along a diameter. Throws as SphereTemplate.
  explicit SampledBoxDeposition(const BoxGrid& grid, int template_points = 12);

  std::unique_ptr<Deposition> clone() const override { return std::make_unique<SampledBoxDeposition>(*this); }

  using BoxDeposition::deposit;
  void deposit(const Particle& sphere, std::vector<Deposit>& deposits) override;

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
