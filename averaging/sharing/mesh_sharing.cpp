// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/sharing/mesh_sharing.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace millfoam::averaging {

namespace {

using Eigen::Vector3d;

void check_period(const Eigen::AlignedBox3d& box, double period) {
  const double extent = box.sizes().z();
  if (std::abs(extent - period) <= 1e-6 * extent) return;
  std::ostringstream message;
  message << "the mesh reaches over " << extent << " m along z, expected exactly one period of " << period
          << " m";
  throw std::invalid_argument(message.str());
}

}  // namespace

MeshSharing::MeshSharing(std::unique_ptr<MovingMesh> mesh, int points_per_diameter,
                         std::optional<double> period_z)
    : mesh_(std::move(mesh)), period_z_(period_z), superquadrics_(points_per_diameter) {
  const MeshGeometry& geometry = mesh_->geometry();
  if (period_z_) check_period(geometry.box(), *period_z_);
  begin_z_ = geometry.box().min().z();
  place_.assign(geometry.cells(), 0);
  stamp_.assign(geometry.cells(), 0);
}

MeshSharing::MeshSharing(const MeshSharing& other)
    : CellSharing(other),
      mesh_(other.mesh_->clone()),
      period_z_(other.period_z_),
      begin_z_(other.begin_z_),
      place_(other.place_.size(), 0),
      stamp_(other.stamp_.size(), 0),
      superquadrics_(other.superquadrics_) {}

void MeshSharing::share(const Particle& sphere, std::vector<Share>& shares) {
  shares.clear();
  const double radius = sphere.radius;
  Vector3d centre = mesh_->into_mesh() * Vector3d::Map(sphere.position.data());
  if (!is_periodic()) return share_image(centre, radius, shares);
  const double period = *period_z_, z = wrapped(centre.z());
  const double first = std::ceil((begin_z_ - radius - z) / period);
  const double last = std::floor((begin_z_ + period + radius - z) / period);
  for (double image = first; image <= last; ++image) {
    centre.z() = z + image * period;
    share_image(centre, radius, shares);
  }
}

void MeshSharing::share(const Particle& particle, const Superquadric& shape, std::vector<Share>& shares) {
  int hint = -1;
  const auto locate_in_lab = [&](const Vector3& point) -> std::optional<std::size_t> {
    const int cell = locate(mesh_->into_mesh() * Vector3d::Map(point.data()), hint);
    if (cell < 0) return std::nullopt;
    hint = cell;
    return static_cast<std::size_t>(cell);
  };
  superquadrics_.share(particle, shape, locate_in_lab, shares);
}

double MeshSharing::wrapped(double z) const {
  return z - *period_z_ * std::floor((z - begin_z_) / *period_z_);
}

int MeshSharing::locate(Vector3d point, int hint) const {
  if (is_periodic()) point.z() = wrapped(point.z());
  return mesh_->search().locate(point, hint);
}

void MeshSharing::clear_parts() {
  parts_.clear();
  if (++now_ != 0) return;
  std::fill(stamp_.begin(), stamp_.end(), 0);
  now_ = 1;
}

int MeshSharing::part_of(int cell) {
  const auto c = static_cast<std::size_t>(cell);
  if (stamp_[c] != now_) {
    stamp_[c] = now_;
    place_[c] = static_cast<int>(parts_.size());
    parts_.push_back({cell, 0, false});
  }
  return place_[c];
}

void MeshSharing::hand_over(double ball_volume, std::vector<Share>& shares) const {
  constexpr double rounding = 1e-15;
  const std::size_t first = shares.size();
  double left_over = 0;
  std::size_t largest = first;
  for (const Part& part : parts_) {
    if (part.volume <= rounding * ball_volume) {
      left_over += part.volume;
      continue;
    }
    if (largest < shares.size() && part.volume > shares[largest].volume) largest = shares.size();
    shares.push_back({static_cast<std::size_t>(part.cell), part.volume});
  }
  if (largest < shares.size()) shares[largest].volume += left_over;
}

}  // namespace millfoam::averaging
