// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/deposition/exact_cylinder_deposition.hpp"

#include <algorithm>
#include <cmath>

#include "meshing/surface/pi.hpp"

namespace millfoam::averaging {

namespace {

/// A rounding of the sphere's volume; less than that is not deposited.
constexpr double nothing = 1e-15;

/// The angle's image in (-pi, pi].
double wrapped_angle(double angle) {
  return angle > pi ? angle - 2 * pi : (angle <= -pi ? angle + 2 * pi : angle);
}

}  // namespace

ExactCylinderDeposition::ExactCylinderDeposition(const CylinderGrid& grid, int template_points)
    : CylinderDeposition(grid, template_points),
      rules_(std::make_shared<const std::array<std::vector<QuadratureNode>, 3>>(
          std::array<std::vector<QuadratureNode>, 3>{
              gauss_legendre_with_roots(20), gauss_legendre_with_roots(40), gauss_legendre_with_roots(64)})) {
}

void ExactCylinderDeposition::deposit(const Particle& sphere, std::vector<Deposit>& deposits) {
  deposits.clear();
  const Vector3 centre = grid().wrapped(sphere.position);
  const double distance = std::hypot(centre[0], centre[1]), radius = sphere.radius;
  z_axis().cut(centre[2], radius, sphere.id, layers_, planes_);
  place_circles(distance, radius);
  place_rays(distance, std::atan2(centre[1], centre[0]), radius);
  const double volume = 4.0 / 3.0 * pi * radius * radius * radius;
  discs_.place(distance, circles_, rays_);
  if (layers_.size() * discs_.rings() * discs_.sectors() == 1) {
    volumes_met_.assign(1, volume);
  } else {
    find_breaks(distance, radius);
    integrate(radius);
  }
  collect(volume, deposits);
}

void ExactCylinderDeposition::place_circles(double distance, double radius) {
  circles_.clear();
  first_ring_ = -1;
  for (int i = 0; i <= grid().shape()[0]; ++i) {
    const double circle = grid().radii()[0] + i * grid().spacing()[0];
    if (circle <= distance - radius || circle == 0) {
      first_ring_ = i;
    } else if (circle < distance + radius) {
      circles_.push_back(circle);
    }
  }
}

void ExactCylinderDeposition::place_rays(double distance, double azimuth, double radius) {
  const double reach = radius < distance ? std::asin(radius / distance) : pi;
  const int count = grid().shape()[1];
  std::vector<std::pair<double, int>> met;
  for (int j = 0; j < count; ++j) {
    const double angle = wrapped_angle(j * grid().spacing()[1] - azimuth);
    if (std::abs(angle) <= reach) met.push_back({angle, j});
  }
  std::sort(met.begin(), met.end());
  rays_.clear();
  sectors_.clear();
  for (const auto& [angle, j] : met) {
    if (sectors_.empty()) sectors_.push_back((j + count - 1) % count);
    rays_.push_back(angle);
    sectors_.push_back(j);
  }
  if (sectors_.empty()) {
    const double place = (azimuth < 0 ? azimuth + 2 * pi : azimuth) / grid().spacing()[1];
    sectors_.push_back(std::min(static_cast<int>(place), count - 1));
  }
}

void ExactCylinderDeposition::find_breaks(double distance, double radius) {
  breaks_.assign({0.0, radius});
  const auto add = [&](double disc) {
    if (disc < radius) breaks_.push_back(std::sqrt((radius - disc) * (radius + disc)));
  };
  add(distance);
  for (const double circle : circles_) {
    add(std::abs(circle - distance));
    add(circle + distance);
  }
  for (const double angle : rays_) {
    add(distance * std::abs(std::sin(angle)));
    const double half = std::sin(angle / 2);
    for (const double circle : circles_) {
      const double beyond = circle - distance;
      add(std::sqrt(beyond * beyond + 4 * circle * distance * half * half));
    }
  }
  for (const double plane : planes_) {
    if (std::abs(plane) < radius) breaks_.push_back(std::abs(plane));
  }
  std::sort(breaks_.begin(), breaks_.end());
}

void ExactCylinderDeposition::integrate(double radius) {
  volumes_met_.assign(layers_.size() * discs_.rings() * discs_.sectors(), 0.0);
  for (std::size_t n = 1; n < breaks_.size(); ++n) {
    if (breaks_[n] > breaks_[n - 1]) integrate_between(breaks_[n - 1], breaks_[n], radius);
  }
}

void ExactCylinderDeposition::integrate_between(double from, double to, double radius) {
  const double middle = (from + to) / 2, half = (to - from) / 2;
  slab_.assign(discs_.rings() * discs_.sectors(), 0.0);
  const std::size_t rule = half < 0.01 * radius ? 0 : (half < 0.1 * radius ? 1 : 2);
  for (const auto& [place, weight] : (*rules_)[rule]) {
    const double height = middle + half * place;
    discs_.areas(std::sqrt((radius - height) * (radius + height)), areas_);
    for (std::size_t cell = 0; cell < slab_.size(); ++cell) slab_[cell] += weight * half * areas_[cell];
  }
  for (const double height : {middle, -middle}) {
    const auto layer =
        static_cast<std::size_t>(std::upper_bound(planes_.begin(), planes_.end(), height) - planes_.begin());
    for (std::size_t cell = 0; cell < slab_.size(); ++cell) {
      volumes_met_[layer * slab_.size() + cell] += slab_[cell];
    }
  }
}

void ExactCylinderDeposition::collect(double sphere_volume, std::vector<Deposit>& deposits) const {
  const double* volume = volumes_met_.data();
  for (const int layer : layers_) {
    for (int ring = first_ring_; ring < first_ring_ + static_cast<int>(discs_.rings()); ++ring) {
      for (const int sector : sectors_) {
        const double part = *volume++;
        const bool inside = layer != GridAxis::outside && ring >= 0 && ring < grid().shape()[0];
        if (inside && part > nothing * sphere_volume) {
          deposits.push_back({grid().offset({ring, sector, layer}), part});
        }
      }
    }
  }
}

}  // namespace millfoam::averaging
