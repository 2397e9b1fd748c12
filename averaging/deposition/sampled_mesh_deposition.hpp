// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "averaging/deposition/mesh_deposition.hpp"

namespace millfoam::averaging {

/// Deposits spheres by the points of a `SphereTemplate`, along the axes of the mesh's frame: a cell gets the
/// same fraction of the volume as of the points.
class SampledMeshDeposition : public MeshDeposition {
 public:
  /// @param mesh, period_z       as of MeshDeposition, with its errors
  /// @param points_per_diameter  for spheres and superquadrics. Throws as SphereTemplate.
  explicit SampledMeshDeposition(std::unique_ptr<MovingMesh> mesh, int points_per_diameter = 12,
                                 std::optional<double> period_z = std::nullopt);

  std::unique_ptr<Deposition> clone() const override {
    return std::make_unique<SampledMeshDeposition>(*this);
  }

 private:
  void deposit_image(const Eigen::Vector3d& centre, double radius, std::vector<Deposit>& deposits) override;
  bool is_in_one_cell(int cell, const Eigen::Vector3d& centre, double radius) const;

  std::shared_ptr<const std::vector<Eigen::Vector3d>> points_;  ///< of the template, in radii
};

}  // namespace millfoam::averaging
