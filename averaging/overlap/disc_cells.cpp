// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/overlap/disc_cells.hpp"

#include <algorithm>
#include <cmath>

#include "meshing/surface/pi.hpp"

namespace millfoam::averaging {

namespace {

/// x - sin(x), also for small x.
double less_sine(double x) {
  if (std::abs(x) > 0.7) return x - std::sin(x);
  const double x2 = x * x;
  double term = x * x2 / 6, sum = term;
  for (int n = 4; std::abs(term) > 1e-17 * std::abs(sum); n += 2) {
    term *= -x2 / (n * (n + 1));
    sum += term;
  }
  return sum;
}

double root(double square) {
  return square > 0 ? std::sqrt(square) : 0.0;
}

}  // namespace

void DiscCells::place(double distance, const std::vector<double>& circles, const std::vector<double>& rays) {
  distance_ = distance;
  circles_.clear();
  for (const double radius : circles) circles_.push_back({radius, radius - distance});
  rays_.clear();
  for (const double angle : rays) {
    const double half = std::sin(angle / 2);
    // A ray at 0 counts as one below it also where the sign of its offset decides.
    const double offset = std::copysign(distance * std::sin(angle), angle > 0 ? 1.0 : -1.0);
    rays_.push_back({angle, offset, -2 * distance * half * half, std::abs(angle) < pi / 2});
  }
  ahead_ = static_cast<std::size_t>(std::upper_bound(rays.begin(), rays.end(), 0.0) - rays.begin());
}

void DiscCells::areas(double rho, std::vector<double>& result) {
  result.assign(rings() * sectors(), 0.0);
  crossings_.clear();
  add_circles(rho, result);
  add_rays(rho, result);
  add_edge(rho, result);
}

void DiscCells::add_circles(double rho, std::vector<double>& result) {
  for (std::size_t n = 0; n < circles_.size(); ++n) {
    const auto [radius, beyond] = circles_[n];
    if (std::abs(beyond) < rho && radius + distance_ > rho) {
      const double inner = (rho - beyond) * (rho + beyond);
      const double outer = (radius + distance_ - rho) * (radius + distance_ + rho);
      add_circle(n, 2 * std::atan2(std::sqrt(inner), std::sqrt(outer)), result);
      // The same half angle, seen from the disc's centre.
      const double psi = 2 * std::atan2(root((rho - beyond) * (distance_ + rho + radius)),
                                        root((rho + beyond) * (radius + distance_ - rho)));
      crossings_.push_back({-psi, 1, 0});
      crossings_.push_back({psi, -1, 0});
    } else if (radius + distance_ <= rho) {
      add_circle(n, pi, result);
    }
  }
}

void DiscCells::add_circle(std::size_t n, double reach, std::vector<double>& result) const {
  const auto [radius, beyond] = circles_[n];
  const double slope = radius * beyond / 2, bend = distance_ * radius / 2;
  const auto moment = [&](double phi) { return slope * phi + bend * less_sine(phi); };
  double before = -moment(reach);
  for (std::size_t m = 0; m < sectors(); ++m) {
    const double end = m < rays_.size() ? rays_[m].angle : pi;
    if (end <= -reach) continue;
    const double after = moment(std::min(end, reach));
    result[n * sectors() + m] += after - before;
    result[(n + 1) * sectors() + m] -= after - before;
    before = after;
    if (end >= reach) break;
  }
}

void DiscCells::add_rays(double rho, std::vector<double>& result) {
  for (std::size_t m = 0; m < rays_.size(); ++m) {
    const Ray& ray = rays_[m];
    if (std::abs(ray.offset) >= rho || (!ray.ahead && rho <= distance_)) continue;
    const double half = std::sqrt((rho - ray.offset) * (rho + ray.offset));
    const double last = ray.foot + half, origin = -distance_;
    crossings_.push_back({ray.angle + std::atan2(ray.offset, half), 0, 1});
    double first = origin;
    if (rho <= distance_) {
      first = std::max(origin, ray.foot - half);
      crossings_.push_back({ray.angle + std::atan2(ray.offset, -half), 0, -1});
    }
    for (std::size_t n = 0; n < rings() && first < last; ++n) {
      const double end = n < circles_.size() ? std::min(circles_[n].beyond, last) : last;
      if (end <= first) continue;
      const double moment = ray.offset * (end - first) / 2;
      result[n * sectors() + m] += moment;
      result[n * sectors() + m + 1] -= moment;
      first = end;
    }
  }
}

void DiscCells::add_edge(double rho, std::vector<double>& result) {
  const auto by_angle = [](const Crossing& a, const Crossing& b) { return a.angle < b.angle; };
  std::sort(crossings_.begin(), crossings_.end(), by_angle);
  // At psi = -pi the edge is at its point nearest to the origin or, with the origin in the disc, at phi =
  // -pi.
  std::size_t ring = 0, sector = rho > distance_ ? 0 : ahead_;
  for (const Circle& circle : circles_) {
    if (circle.beyond <= -rho || circle.radius + distance_ <= rho) ++ring;
  }
  double angle = -pi;
  const auto add_until = [&](double end) {
    if (end != angle) result[ring * sectors() + sector] += rho * rho / 2 * (end - angle);
    angle = end;
  };
  for (const Crossing& crossing : crossings_) {
    add_until(crossing.angle);
    ring += static_cast<std::size_t>(crossing.ring);
    sector += static_cast<std::size_t>(crossing.sector);
  }
  add_until(pi);
}

}  // namespace millfoam::averaging
