// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cassert>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "averaging/deposition/deposition.hpp"
#include "averaging/overlap/superquadric.hpp"

namespace millfoam::averaging {

/// Deposits superquadrics in cells by sampling: the points of a lattice in the body are turned and shifted
/// with it and located one by one, each carrying an equal part of the volume. The lattices of earlier shapes
/// are kept.
class SuperquadricSampling {
 public:
  /// @param points_per_diameter  of the lattice, along each axis of the body
  explicit SuperquadricSampling(int points_per_diameter) : points_per_diameter_(points_per_diameter) {}

  /// Deposits one ball.
  /// @param particle  gives the place of its centre, m
  /// @param shape     half-axes, blockiness and orientation
  /// @param locate    std::optional<std::size_t>(const Vector3&): the cell that holds a point of the lab, m
  /// @param deposits  overwritten; neighbouring points in one cell make one deposit
  ///
  /// Throws as `superquadric_volume`.
  template <typename Locate>
  void deposit(const Particle& particle, const Superquadric& shape, Locate&& locate,
               std::vector<Deposit>& deposits) {
    deposits.clear();
    const std::vector<Vector3>& points = of_blockiness(shape.blockiness).points();
    const double volume = superquadric_volume(shape), count = static_cast<double>(points.size());
    const Eigen::Matrix3d turn = turn_and_stretch(shape);
    const Eigen::Vector3d centre(particle.position[0], particle.position[1], particle.position[2]);
    for (const Vector3& point : points) {
      const Eigen::Vector3d place = centre + turn * Eigen::Vector3d(point[0], point[1], point[2]);
      const std::optional<std::size_t> cell = locate(Vector3{place.x(), place.y(), place.z()});
      if (!cell) continue;
      if (deposits.empty() || deposits.back().cell != *cell) deposits.push_back({*cell, 0});
      deposits.back().volume += 1;
    }
    for (Deposit& part : deposits) part.volume = volume * (part.volume / count);
  }

  /// Deposits one ball in the voxels of a grid. Throws as above.
  template <typename Voxels>
  void deposit_in(const Voxels& grid, const Particle& particle, const Superquadric& shape,
                  std::vector<Deposit>& deposits) {
    const auto locate = [&grid](const Vector3& point) -> std::optional<std::size_t> {
      const auto voxel = grid.locate(point);
      if (!voxel) return std::nullopt;
      return grid.offset(*voxel);
    };
    deposit(particle, shape, locate, deposits);
  }

 private:
  static Eigen::Matrix3d turn_and_stretch(const Superquadric& shape) {
    const auto& [w, x, y, z] = shape.quaternion;
    const Eigen::Quaterniond quaternion(w, x, y, z);
    assert(quaternion.squaredNorm() > 0);
    const auto& [a, b, c] = shape.half_axes;
    return quaternion.normalized().toRotationMatrix() * Eigen::Vector3d(a, b, c).asDiagonal();
  }

  const SuperquadricTemplate& of_blockiness(const std::array<double, 2>& blockiness) {
    for (const auto& [known, points] : templates_) {
      if (known == blockiness) return *points;
    }
    templates_.emplace_back(blockiness,
                            std::make_shared<const SuperquadricTemplate>(blockiness, points_per_diameter_));
    return *templates_.back().second;
  }

  int points_per_diameter_;
  std::vector<std::pair<std::array<double, 2>, std::shared_ptr<const SuperquadricTemplate>>> templates_;
};

}  // namespace millfoam::averaging
