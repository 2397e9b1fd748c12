// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <memory>
#include <utility>
#include <vector>

#include "averaging/deposition/cylinder_deposition.hpp"
#include "averaging/overlap/sphere_template.hpp"

namespace millfoam::averaging {

/// Deposits spheres in the voxels of a cylinder by sampling: a voxel gets the same fraction of a sphere's
/// volume as of the template's points.
///
/// The template's columns along z are located once each, and their points counted by layers.
class SampledCylinderDeposition : public CylinderDeposition {
 public:
  /// @param grid             where balls are deposited; it is copied
  /// @param template_points  along a diameter. Throws as SphereTemplate.
  explicit SampledCylinderDeposition(const CylinderGrid& grid, int template_points = 12);

  std::unique_ptr<Deposition> clone() const override {
    return std::make_unique<SampledCylinderDeposition>(*this);
  }

  using CylinderDeposition::deposit;
  void deposit(const Particle& sphere, std::vector<Deposit>& deposits) override;

 private:
  /// A column of the template along z.
  struct Column {
    double x;  ///< in radii from the centre
    double y;
    int begin;  ///< its points are the layers [begin, n - begin) of the lattice
  };

  /// Neighbouring layers of the lattice in one layer of the grid.
  struct Run {
    int layer;
    int begin;
    int end;
  };

  void cut_layers(double centre, double radius);
  int* counts_of(int ring, int sector);

  std::shared_ptr<const SphereTemplate> points_;
  std::shared_ptr<const std::vector<Column>> columns_;
  std::vector<Run> runs_;
  std::vector<std::array<int, 2>> cells_;  ///< ring and sector of the cells met
  std::vector<int> counts_;                ///< [cells met][runs] points
};

}  // namespace millfoam::averaging
