// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "averaging/deposition/deposition.hpp"
#include "averaging/deposition/superquadric_sampling.hpp"
#include "averaging/mesh/moving_mesh.hpp"

namespace millfoam::averaging {

/// The common part of all ways to deposit balls in the cells of a mesh: the mesh at the time of the record,
/// the way into its frame, its repeats along z, and superquadrics by sampling.
class MeshDeposition : public Deposition {
 public:
  void begin_record(double time) override { mesh_->begin_record(time); }
  const std::vector<double>& volumes() const override { return mesh_->geometry().volumes(); }

  void deposit(const Particle& sphere, std::vector<Deposit>& deposits) override;
  void deposit(const Particle& particle, const Superquadric& shape, std::vector<Deposit>& deposits) override;

 protected:
  /// @param mesh                 begin_record is called on it before it is used
  /// @param points_per_diameter  of the lattice for sampling (`SphereTemplate`, `SuperquadricTemplate`)
  /// @param period_z  length after which the mesh repeats along the z axis of its frame, m: a ball that
  ///                  reaches over an end of the mesh enters on the other side; without it the mesh ends
  ///                  there. Throws std::invalid_argument when the mesh's extent along z differs from it.
  MeshDeposition(std::unique_ptr<MovingMesh> mesh, int points_per_diameter, std::optional<double> period_z);
  /// A copy for another thread, with a clone of the mesh.
  MeshDeposition(const MeshDeposition& other);

  /// Adds the deposits in the cells that a sphere in the mesh's frame meets; centre and radius in m. It is
  /// called for each image of a ball that may meet the mesh.
  virtual void deposit_image(const Eigen::Vector3d& centre, double radius,
                             std::vector<Deposit>& deposits) = 0;

  /// The cell that holds a point of the mesh's frame, or its image where the mesh repeats; -1 outside.
  int locate(Eigen::Vector3d point, int hint) const;

  /// A cell that the present image of a ball meets.
  struct MetCell {
    int cell = 0;        ///< number of the cell
    double volume = 0;   ///< of the ball in the cell, m^3; sampling counts points in it
    bool whole = false;  ///< the ball holds all of the cell
  };

  /// Begins another image of a ball, with no cells met.
  void clear_met_cells();

  /// Where in `met_cells_` a cell is, or -1.
  int find_met_cell(int cell) const {
    const auto c = static_cast<std::size_t>(cell);
    return met_by_[c] == image_ ? met_place_[c] : -1;
  }

  /// Where in `met_cells_` a cell is; a new one is put at the end.
  int add_met_cell(int cell);

  /// Appends the deposits in the cells met. What rounding left below 1e-15 of the ball, or negative, goes to
  /// the largest.
  /// @param ball_volume  m^3
  /// @param deposits     what is in it stays
  void append_deposits(double ball_volume, std::vector<Deposit>& deposits) const;

  const MovingMesh& mesh() const { return *mesh_; }           ///< at the time of the record
  bool is_periodic() const { return period_z_.has_value(); }  ///< along z

  std::vector<MetCell> met_cells_;  ///< by the present image

 private:
  /// The image of a coordinate along z within the mesh, where that repeats.
  double wrapped(double z) const;

  std::unique_ptr<MovingMesh> mesh_;
  std::optional<double> period_z_;
  double begin_z_ = 0;
  std::vector<int> met_place_;    ///< [cells] in met_cells_, where the present image meets the cell
  std::vector<unsigned> met_by_;  ///< [cells] number of the last image that met the cell
  unsigned image_ = 0;            ///< number of the present image
  SuperquadricSampling superquadrics_;
};

}  // namespace millfoam::averaging
