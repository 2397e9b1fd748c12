// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "averaging/deposition/mesh_deposition.hpp"

namespace millfoam::averaging {

/// Deposits spheres exactly: a cell gets the volume of the sphere that lies in it.
///
/// The search begins in the cell with the centre and continues through all facets that the sphere meets. If
/// the sphere meets the boundary, or the centre is outside, all cells around it are searched. Each facet is
/// computed once, for both of its cells (`cut_facet`). Where that is not robust, all cells around are summed
/// with a robust method (`sphere_triangle_volume`). The sum over cells is the sphere's volume to 1e-12 of it.
class ExactMeshDeposition : public MeshDeposition {
 public:
  /// @param mesh, period_z       as of MeshDeposition, with its errors
  /// @param points_per_diameter  for superquadrics, which are sampled
  explicit ExactMeshDeposition(std::unique_ptr<MovingMesh> mesh, int points_per_diameter = 12,
                               std::optional<double> period_z = std::nullopt)
      : MeshDeposition(std::move(mesh), points_per_diameter, period_z) {}

  std::unique_ptr<Deposition> clone() const override { return std::make_unique<ExactMeshDeposition>(*this); }

 private:
  void deposit_image(const Eigen::Vector3d& centre, double radius, std::vector<Deposit>& deposits) override;
  void add_candidates(const Eigen::Vector3d& centre, double radius);
  int meet_cell(int cell, const Eigen::Vector3d& centre, double radius);
  bool deposit_by_facet_cuts(const Eigen::Vector3d& centre, double radius);
  bool cut_cell(std::size_t number, const Eigen::Vector3d& centre, double radius, bool& at_boundary);
  void deposit_by_cones(const Eigen::Vector3d& centre, double radius);

  std::vector<int> candidates_;
};

}  // namespace millfoam::averaging
