// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/overlap/gauss_legendre.hpp"

#include <cassert>
#include <cmath>
#include <utility>

#include "meshing/surface/pi.hpp"

namespace millfoam::averaging {

namespace {

/// Value and slope of the Legendre polynomial of degree n at x.
std::pair<double, double> legendre(int n, double x) {
  double value = 1, before = 0;
  for (int k = 1; k <= n; ++k) {
    const double next = ((2 * k - 1) * x * value - (k - 1) * before) / k;
    before = value;
    value = next;
  }
  return {value, n * (x * value - before) / (x * x - 1)};
}

}  // namespace

std::vector<QuadratureNode> gauss_legendre(int n) {
  assert(n > 0);
  std::vector<QuadratureNode> nodes;
  for (int i = 0; i < n; ++i) {
    double x = -std::cos(pi * (i + 0.75) / (n + 0.5));
    double slope = 1;
    for (int step = 0; step < 8; ++step) {
      const auto [value, derivative] = legendre(n, x);
      slope = derivative;
      x -= value / slope;
    }
    nodes.push_back({x, 2 / ((1 - x * x) * slope * slope)});
  }
  return nodes;
}

std::vector<QuadratureNode> gauss_legendre_with_roots(int n) {
  std::vector<QuadratureNode> nodes = gauss_legendre(n);
  for (auto& [u, weight] : nodes) {
    weight *= 1.5 * (1 - u) * (1 + u);
    u = (3 - u * u) * u / 2;
  }
  return nodes;
}

}  // namespace millfoam::averaging
