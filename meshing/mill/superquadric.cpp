// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/mill/superquadric.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

#include "meshing/surface/pi.hpp"

namespace millfoam::meshing {
namespace {

using Vector = std::array<double, 3>;

double beta(double x, double y) {
  return std::tgamma(x) * std::tgamma(y) / std::tgamma(x + y);
}

/// A point of the surface in coordinates over the half axes, on the ray of a direction; all positive.
Vector on_surface(const Superquadric& body, const Vector& direction) {
  double sum = 0;
  for (const double u : direction) sum += std::pow(std::abs(u), body.blockiness);
  assert(sum > 0);
  const double length = std::pow(sum, -1 / body.blockiness);
  return {std::abs(direction[0]) * length, std::abs(direction[1]) * length, std::abs(direction[2]) * length};
}

Vector direction(double polar, double azimuth) {
  return {std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), std::cos(polar)};
}

struct Node {
  double at = 0;      ///< from 0 to pi/2
  double weight = 0;  ///< of this node
};

/// Nodes of a rule for functions that are smooth but for their ends: the middles of equal parts, drawn to the
/// ends by x = s^2 (3 - 2 s) twice.
std::vector<Node> quarter_nodes() {
  constexpr int parts = 80;
  std::vector<Node> nodes(parts);
  for (int i = 0; i < parts; ++i) {
    const double s = (i + 0.5) / parts;
    const double x = s * s * (3 - 2 * s), slope = 6 * s * (1 - s);
    nodes[static_cast<std::size_t>(i)] = {pi / 2 * x * x * (3 - 2 * x),
                                          pi / 2 * 6 * x * (1 - x) * slope / parts};
  }
  return nodes;
}

/// Support function of the body, its largest x·v: the dual norm, with exponent N/(N - 1); and its slope where
/// v turns with the velocity `turn`.
struct Support {
  double value = 0;  ///< m
  double slope = 0;  ///< m per radian
};

Support support(const Superquadric& body, const Vector& v, const Vector& turn) {
  const double dual = body.blockiness / (body.blockiness - 1);
  double sum = 0, slope = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double part = body.half_axes[i] * std::abs(v[i]);
    sum += std::pow(part, dual);
    if (part > 0) slope += std::pow(part, dual - 1) * std::copysign(body.half_axes[i], v[i]) * turn[i];
  }
  return {std::pow(sum, 1 / dual), std::pow(sum, 1 / dual - 1) * slope};
}

Vector cross(const Vector& u, const Vector& v) {
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

Vector unit(const Vector& v) {
  const double length = std::hypot(v[0], v[1], v[2]);
  assert(length > 0);
  return {v[0] / length, v[1] / length, v[2] / length};
}

double equal_radius(const Superquadric& body) {
  return std::cbrt(volume(body) * 3 / (4 * pi));
}

}  // namespace

double volume(const Superquadric& body) {
  const auto& [a, b, c] = body.half_axes;
  const double n = 2 / body.blockiness;
  return 2 * a * b * c * n * n * beta(n / 2, n + 1) * beta(n / 2, n / 2 + 1);
}

std::array<double, 3> inertia_over_mass(const Superquadric& body) {
  const double part = 1 / body.blockiness;
  const double mean =
      std::tgamma(3 * part) * std::tgamma(3 * part + 1) / (std::tgamma(part) * std::tgamma(5 * part + 1));
  Vector square;
  for (std::size_t i = 0; i < 3; ++i) square[i] = mean * body.half_axes[i] * body.half_axes[i];
  return {square[1] + square[2], square[2] + square[0], square[0] + square[1]};
}

double surface(const Superquadric& body) {
  // The cone over a part of the surface has a third of its area times the distance of its plane from the
  // centre: in coordinates over the half axes, with the point's distance t, dA = a b c t^3 |∇S|/N dω.
  static const std::vector<Node> nodes = quarter_nodes();
  const double n = body.blockiness;
  double sum = 0;
  for (const Node& polar : nodes)
    for (const Node& azimuth : nodes) {
      const Vector p = on_surface(body, direction(polar.at, azimuth.at));
      double gradient = 0;
      for (std::size_t i = 0; i < 3; ++i) gradient += std::pow(std::pow(p[i], n - 1) / body.half_axes[i], 2);
      const double distance = std::hypot(p[0], p[1], p[2]);
      sum += polar.weight * azimuth.weight * std::sin(polar.at) * std::pow(distance, 3) * std::sqrt(gradient);
    }
  const auto& [a, b, c] = body.half_axes;
  return 8 * a * b * c * sum;
}

double sphericity(const Superquadric& body) {
  const double radius = equal_radius(body);
  // No body has less surface than the sphere; the quadrature of one may
  return std::min(4 * pi * radius * radius / surface(body), 1.0);
}

double cross_section(const Superquadric& body, const std::array<double, 3>& along) {
  const Vector w = unit(along);
  const std::size_t least = static_cast<std::size_t>(
      std::min_element(w.begin(), w.end(), [](double u, double v) { return std::abs(u) < std::abs(v); }) -
      w.begin());
  Vector axis = {};
  axis[least] = 1;
  const Vector e = unit(cross(w, axis)), f = cross(w, e);
  // Half a turn, cut where a coordinate of the normal is 0 and the support function's slope has a kink
  std::vector<double> cuts = {0, pi};
  for (std::size_t i = 0; i < 3; ++i) {
    const double angle = std::atan2(-e[i], f[i]);
    if (std::hypot(e[i], f[i]) > 1e-12) cuts.push_back(angle < 0 ? angle + pi : angle);
  }
  std::sort(cuts.begin(), cuts.end());
  static const std::vector<Node> nodes = quarter_nodes();
  double sum = 0;
  for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
    const double scale = (cuts[k + 1] - cuts[k]) / (pi / 2);
    for (const Node& node : nodes) {
      const double t = cuts[k] + scale * node.at, cosine = std::cos(t), sine = std::sin(t);
      Vector v, turn;
      for (std::size_t i = 0; i < 3; ++i) {
        v[i] = cosine * e[i] + sine * f[i];
        turn[i] = -sine * e[i] + cosine * f[i];
      }
      const Support h = support(body, v, turn);
      sum += scale * node.weight * (h.value * h.value - h.slope * h.slope);
    }
  }
  return sum;  // twice the half turn's half of the integral
}

double mean_curvature(const Superquadric& body, const std::array<double, 3>& direction) {
  const double n = body.blockiness;
  const Vector p = on_surface(body, direction);
  Vector gradient, hessian;  // The Hessian is diagonal
  double square = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    gradient[i] = n * std::pow(p[i], n - 1) / body.half_axes[i];
    hessian[i] = n * (n - 1) * std::pow(p[i], n - 2) / (body.half_axes[i] * body.half_axes[i]);
    square += gradient[i] * gradient[i];
  }
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) sum += hessian[i] * (square - gradient[i] * gradient[i]);
  return sum / (2 * std::pow(square, 1.5));
}

double least_radius_of_curvature(const Superquadric& body) {
  const auto curvature = [&](double polar, double azimuth) {
    return mean_curvature(body, direction(polar, azimuth));
  };
  // The best of a grid over an eighth of the directions, refined around it
  constexpr int parts = 24;
  constexpr double smallest_step = 1e-9;
  double step = pi / 2 / parts, polar = 0, azimuth = 0, best = curvature(0, 0);
  const auto try_at = [&](double p, double a) {
    p = std::clamp(p, 0.0, pi / 2);
    a = std::clamp(a, 0.0, pi / 2);
    const double here = curvature(p, a);
    if (here <= best) return false;
    best = here, polar = p, azimuth = a;
    return true;
  };
  for (int i = 0; i <= parts; ++i)
    for (int k = 0; k <= parts; ++k) try_at(i * step, k * step);
  while (step > smallest_step) {
    bool better = false;
    for (const int dp : {-1, 0, 1})
      for (const int da : {-1, 0, 1}) better = try_at(polar + dp * step, azimuth + da * step) || better;
    if (!better) step /= 2;
  }
  return 1 / best;
}

double bounding_radius(const Superquadric& body) {
  const double largest = *std::max_element(body.half_axes.begin(), body.half_axes.end());
  const double n = body.blockiness;
  if (n - 2 < 1e-9) return largest;
  double sum = 0;
  for (const double axis : body.half_axes) sum += std::pow(axis / largest, 2 * n / (n - 2));
  return largest * std::pow(sum, (n - 2) / (2 * n));
}

Superquadric scaled_to(const Superquadric& body, double diameter) {
  const double factor = diameter / 2 / equal_radius(body);
  Superquadric scaled = body;
  for (double& axis : scaled.half_axes) axis *= factor;
  return scaled;
}

}  // namespace millfoam::meshing
