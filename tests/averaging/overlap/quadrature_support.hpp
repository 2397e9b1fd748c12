// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace millfoam::averaging {

/// Integral over [from, to] of a function that is smooth within and may have roots at the ends, by the
/// tanh-sinh rule (Takahasi & Mori 1974).
template <typename Function>
double integral(const Function& function, double from, double to) {
  if (!(to > from)) return 0;
  constexpr double step = 1.0 / 32, reach = 3.2, half_pi = 1.57079632679489662;
  const double middle = (from + to) / 2, half = (to - from) / 2;
  double sum = 0;
  for (double t = -reach; t <= reach; t += step) {
    const double u = half_pi * std::sinh(t), cosh = std::cosh(u);
    sum += function(middle + half * std::tanh(u)) * half_pi * std::cosh(t) / (cosh * cosh);
  }
  return sum * half * step;
}

/// The same, in pieces: the function may also have roots or bends at `breaks`.
template <typename Function>
double integral(const Function& function, double from, double to, std::vector<double> breaks) {
  for (double& x : breaks) x = std::isfinite(x) ? std::clamp(x, from, to) : from;
  breaks.push_back(to);
  std::sort(breaks.begin(), breaks.end());
  double sum = 0;
  for (const double x : breaks) {
    sum += integral(function, from, x);
    from = x;
  }
  return sum;
}

/// Area of the disc of radius r about the origin in {x < a, y < b}.
inline double disc_corner_area(double r, double a, double b) {
  if (!(r > 0)) return 0;
  const double end = std::clamp(a, -r, r), chord = std::sqrt(std::max(0.0, r * r - b * b));
  const auto height = [&](double x) {
    const double half = std::sqrt(std::max(0.0, r * r - x * x));
    return std::clamp(b, -half, half) + half;
  };
  return integral(height, -r, end, {-chord, chord});
}

/// Volume of the unit sphere about the origin in {x < a, y < b, z < c}, by quadrature over z and over x.
inline double corner_volume_by_quadrature(double a, double b, double c) {
  const auto level = [](double x) { return std::sqrt(std::max(0.0, 1 - x * x)); };
  const double corner = level(std::sqrt(std::min(1.0, a * a + b * b)));
  const auto area = [&](double z) { return disc_corner_area(level(z), a, b); };
  return integral(area, -1, std::clamp(c, -1.0, 1.0),
                  {-level(a), level(a), -level(b), level(b), -corner, corner});
}

}  // namespace millfoam::averaging
