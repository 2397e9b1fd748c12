// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "averaging/deposition/cylinder_deposition.hpp"
#include "averaging/overlap/disc_cells.hpp"
#include "averaging/overlap/gauss_legendre.hpp"

namespace millfoam::averaging {

/// Deposits in each voxel of a cylinder the volume of a sphere in it: the integral over z of the closed-form
/// areas of the sphere's discs in the cells of the polar grid (`DiscCells`).
///
/// The areas are smooth in z but for roots where a disc's edge touches a circle or a ray or passes a corner;
/// between these heights and the grid's own, Gauss-Legendre nodes that bear roots at the ends give the
/// volumes to 1e-12 of the sphere's. All cells use the same nodes, so the deposits add up to the sphere's
/// volume.
class ExactCylinderDeposition : public CylinderDeposition {
 public:
  /// @param grid             where balls are deposited; it is copied
  /// @param template_points  points along a diameter for superquadrics, which are sampled
  explicit ExactCylinderDeposition(const CylinderGrid& grid, int template_points = 12);

  std::unique_ptr<Deposition> clone() const override {
    return std::make_unique<ExactCylinderDeposition>(*this);
  }

  /// Throws as `GridAxis::cut`.
  using CylinderDeposition::deposit;
  void deposit(const Particle& sphere, std::vector<Deposit>& deposits) override;

 private:
  void place_circles(double distance, double radius);
  void place_rays(double distance, double azimuth, double radius);
  void find_breaks(double distance, double radius);
  void integrate(double radius);
  void integrate_between(double from, double to, double radius);
  void collect(double sphere_volume, std::vector<Deposit>& deposits) const;

  std::shared_ptr<const std::array<std::vector<QuadratureNode>, 3>>
      rules_;  ///< for short, middling, long pieces
  DiscCells discs_;
  int first_ring_ = 0;           ///< of the grid, within the first circle; -1 in front of the inner radius
  std::vector<double> circles_;  ///< radii that the sphere meets
  std::vector<double> rays_;     ///< angles from the sphere's azimuth
  std::vector<int> sectors_;     ///< [sectors met] of the grid
  std::vector<int> layers_;      ///< [layers met] of the grid or `GridAxis::outside`
  std::vector<double> planes_;   ///< [layers met - 1] between them, relative to the centre
  std::vector<double> breaks_;   ///< distances from the centre along z between which areas are smooth
  std::vector<double> areas_;    ///< of one disc
  std::vector<double> slab_;     ///< areas integrated over a part of the height
  std::vector<double> volumes_met_;  ///< [layers met][rings met][sectors met]
};

}  // namespace millfoam::averaging
