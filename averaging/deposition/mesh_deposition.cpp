// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/deposition/mesh_deposition.hpp"

#include <algorithm>
#include <cmath>

#include "averaging/mesh/periodic_faces.hpp"

namespace millfoam::averaging {

namespace {

using Eigen::Vector3d;

}  // namespace

MeshDeposition::MeshDeposition(std::unique_ptr<MovingMesh> mesh, int points_per_diameter,
                               std::optional<double> period_z)
    : mesh_(std::move(mesh)), period_z_(period_z), superquadrics_(points_per_diameter) {
  const MeshGeometry& geometry = mesh_->geometry();
  if (period_z_) require_period(geometry, *period_z_);
  begin_z_ = geometry.box().min().z();
  met_place_.assign(geometry.cells(), 0);
  met_by_.assign(geometry.cells(), 0);
}

MeshDeposition::MeshDeposition(const MeshDeposition& other)
    : Deposition(other),
      mesh_(other.mesh_->clone()),
      period_z_(other.period_z_),
      begin_z_(other.begin_z_),
      met_place_(other.met_place_.size(), 0),
      met_by_(other.met_by_.size(), 0),
      superquadrics_(other.superquadrics_) {}

void MeshDeposition::deposit(const Particle& sphere, std::vector<Deposit>& deposits) {
  deposits.clear();
  const double radius = sphere.radius;
  Vector3d centre = mesh_->into_mesh() * Vector3d::Map(sphere.position.data());
  if (!is_periodic()) return deposit_image(centre, radius, deposits);
  const double period = *period_z_, z = wrapped(centre.z());
  const auto first = static_cast<long>(std::ceil((begin_z_ - radius - z) / period));
  const auto last = static_cast<long>(std::floor((begin_z_ + period + radius - z) / period));
  for (long image = first; image <= last; ++image) {
    centre.z() = z + static_cast<double>(image) * period;
    deposit_image(centre, radius, deposits);
  }
}

void MeshDeposition::deposit(const Particle& particle, const Superquadric& shape,
                             std::vector<Deposit>& deposits) {
  int hint = -1;
  const auto locate_in_lab = [&](const Vector3& point) -> std::optional<std::size_t> {
    const int cell = locate(mesh_->into_mesh() * Vector3d::Map(point.data()), hint);
    if (cell < 0) return std::nullopt;
    hint = cell;
    return static_cast<std::size_t>(cell);
  };
  superquadrics_.deposit(particle, shape, locate_in_lab, deposits);
}

double MeshDeposition::wrapped(double z) const {
  return z - *period_z_ * std::floor((z - begin_z_) / *period_z_);
}

int MeshDeposition::locate(Vector3d point, int hint) const {
  if (is_periodic()) point.z() = wrapped(point.z());
  return mesh_->search().locate(point, hint);
}

void MeshDeposition::clear_met_cells() {
  met_cells_.clear();
  if (++image_ != 0) return;
  std::fill(met_by_.begin(), met_by_.end(), 0);
  image_ = 1;
}

int MeshDeposition::add_met_cell(int cell) {
  const auto c = static_cast<std::size_t>(cell);
  if (met_by_[c] != image_) {
    met_by_[c] = image_;
    met_place_[c] = static_cast<int>(met_cells_.size());
    met_cells_.push_back({cell, 0, false});
  }
  return met_place_[c];
}

void MeshDeposition::append_deposits(double ball_volume, std::vector<Deposit>& deposits) const {
  constexpr double rounding = 1e-15;
  const std::size_t first = deposits.size();
  double left_over = 0;
  std::size_t largest = first;
  for (const MetCell& met : met_cells_) {
    if (met.volume <= rounding * ball_volume) {
      left_over += met.volume;
      continue;
    }
    if (largest < deposits.size() && met.volume > deposits[largest].volume) largest = deposits.size();
    deposits.push_back({static_cast<std::size_t>(met.cell), met.volume});
  }
  if (largest < deposits.size()) deposits[largest].volume += left_over;
}

}  // namespace millfoam::averaging
