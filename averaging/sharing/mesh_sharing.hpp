// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "averaging/mesh/moving_mesh.hpp"
#include "averaging/overlap/sphere_template.hpp"
#include "averaging/sharing/cell_sharing.hpp"
#include "averaging/sharing/superquadric_points.hpp"

namespace millfoam::averaging {

/// What both ways of sharing balls between the cells of a mesh have in common: the mesh at the time of the
/// record, the way into its frame, its repeats along z, and superquadrics by sampling.
class MeshSharing : public CellSharing {
 public:
  void begin_record(double time) override { mesh_->begin_record(time); }
  const std::vector<double>& volumes() const override { return mesh_->geometry().volumes(); }

  void share(const Particle& sphere, std::vector<Share>& shares) override;
  void share(const Particle& particle, const Superquadric& shape, std::vector<Share>& shares) override;

 protected:
  /// @param mesh                 begin_record is called on it before it is used
  /// @param points_per_diameter  of the lattice for sampling (`SphereTemplate`, `SuperquadricTemplate`)
  /// @param period_z  length after which the mesh repeats along the z axis of its frame, m: a ball that
  ///                  reaches over an end of the mesh comes in on the other side; without it the mesh ends
  ///                  there. Throws std::invalid_argument when the mesh's extent along z differs from it.
  MeshSharing(std::unique_ptr<MovingMesh> mesh, int points_per_diameter, std::optional<double> period_z);
  MeshSharing(const MeshSharing& other);

  /// Adds the shares of the cells that a sphere in the mesh's frame meets. It is called for each image of a
  /// ball that may meet the mesh.
  virtual void share_image(const Eigen::Vector3d& centre, double radius, std::vector<Share>& shares) = 0;

  /// The cell that holds a point of the mesh's frame, or its image where the mesh repeats; -1 outside.
  int locate(Eigen::Vector3d point, int hint) const;

  /// A cell that a ball meets, while the ball is shared.
  struct Part {
    int cell = 0;
    double volume = 0;
    bool whole = false;  ///< the ball holds all of the cell
  };

  /// Begins with no cells met.
  void clear_parts();

  /// Where in `parts_` a cell is, or -1.
  int find_part(int cell) const {
    const auto c = static_cast<std::size_t>(cell);
    return stamp_[c] == now_ ? place_[c] : -1;
  }

  /// Where in `parts_` a cell is; a new one is put at the end.
  int part_of(int cell);

  /// Turns parts into shares. What rounding left below 1e-15 of the ball, or negative, goes to the largest.
  void hand_over(double ball_volume, std::vector<Share>& shares) const;

  const MovingMesh& mesh() const { return *mesh_; }
  bool is_periodic() const { return period_z_.has_value(); }

  std::vector<Part> parts_;

 private:
  /// The image of a coordinate along z within the mesh, where that repeats.
  double wrapped(double z) const;

  std::unique_ptr<MovingMesh> mesh_;
  std::optional<double> period_z_;
  double begin_z_ = 0;
  std::vector<int> place_;       ///< [cells] in parts_, where the stamp is that of now
  std::vector<unsigned> stamp_;  ///< [cells]
  unsigned now_ = 0;
  SuperquadricPoints superquadrics_;
};

/// Shares spheres exactly: a cell gets the volume of the sphere that lies in it.
///
/// From the cell that holds the centre the search goes on through all facets that the sphere meets; where it
/// meets the boundary, or the centre is outside, the cells around it are looked through. Each facet is worked
/// out once, for both of its cells (`cut_facet`); where that is delicate, all cells around are summed up
/// robustly (`sphere_triangle_volume`). The sum over cells is the sphere's volume to rounding, 1e-12 of it.
class MeshExact : public MeshSharing {
 public:
  /// As MeshSharing.
  explicit MeshExact(std::unique_ptr<MovingMesh> mesh, int points_per_diameter = 12,
                     std::optional<double> period_z = std::nullopt)
      : MeshSharing(std::move(mesh), points_per_diameter, period_z) {}

  std::unique_ptr<CellSharing> clone() const override { return std::make_unique<MeshExact>(*this); }

 private:
  void share_image(const Eigen::Vector3d& centre, double radius, std::vector<Share>& shares) override;
  void add_candidates(const Eigen::Vector3d& centre, double radius);
  int meet(int cell, const Eigen::Vector3d& centre, double radius);
  bool share_quickly(const Eigen::Vector3d& centre, double radius);
  bool cut_cell(std::size_t number, const Eigen::Vector3d& centre, double radius, bool& at_boundary);
  void share_robustly(const Eigen::Vector3d& centre, double radius);

  std::vector<int> candidates_;
};

/// Shares spheres by the points of a `SphereTemplate`, along the axes of the mesh's frame.
class MeshSampling : public MeshSharing {
 public:
  /// As MeshSharing.
  explicit MeshSampling(std::unique_ptr<MovingMesh> mesh, int points_per_diameter = 12,
                        std::optional<double> period_z = std::nullopt);

  std::unique_ptr<CellSharing> clone() const override { return std::make_unique<MeshSampling>(*this); }

 private:
  void share_image(const Eigen::Vector3d& centre, double radius, std::vector<Share>& shares) override;
  bool is_in_one_cell(int cell, const Eigen::Vector3d& centre, double radius) const;

  std::shared_ptr<const std::vector<Eigen::Vector3d>> points_;  ///< of the template, in radii
};

}  // namespace millfoam::averaging
