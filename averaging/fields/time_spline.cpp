// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/fields/time_spline.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace millfoam::averaging {

TimeSpline::TimeSpline(std::vector<double> lengths, bool repeats)
    : lengths_(std::move(lengths)), repeats_(repeats) {
  if (lengths_.empty() || !(*std::min_element(lengths_.begin(), lengths_.end()) > 0))
    throw std::invalid_argument("a spline in time needs windows, each with a length above 0 s");
}

std::size_t TimeSpline::before(std::size_t window) const {
  if (window > 0) return window - 1;
  return repeats_ ? size() - 1 : window;
}

std::size_t TimeSpline::after(std::size_t window) const {
  if (window + 1 < size()) return window + 1;
  return repeats_ ? 0 : window;
}

std::array<double, 2> TimeSpline::outer_shares(std::size_t window) const {
  const double own = lengths_[window];
  return {own / (lengths_[before(window)] + own), own / (own + lengths_[after(window)])};
}

SplineMoment TimeSpline::at(std::size_t window, double share) const {
  const auto [first, last] = outer_shares(window);
  const double begin = first * (1 - share) * (1 - share);
  const double end = last * share * share;
  return {{before(window), window, after(window)}, {begin, 1 - begin - end, end}};
}

std::vector<double> TimeSpline::coefficients(const std::vector<double>& means, double largest) const {
  std::vector<double> result = means;
  const double tolerance = 1e-16 * *std::max_element(means.begin(), means.end());
  // Each pass leaves at most half of the error: a window's neighbours count at most half as much as it
  for (int pass = 0; pass < 60; ++pass) {
    double change = 0;
    for (std::size_t k = 0; k < size(); ++k) {
      // Means of the parabolas (1 - x)^2 and x^2 are 1/3
      const auto [first, last] = outer_shares(k);
      const double neighbours = (first * result[before(k)] + last * result[after(k)]) / 3;
      double own = 1 - (first + last) / 3;
      double known = neighbours;
      if (before(k) == k) {
        known -= first * result[k] / 3;
        own += first / 3;
      }
      if (after(k) == k) {
        known -= last * result[k] / 3;
        own += last / 3;
      }
      const double better = std::clamp((means[k] - known) / own, 0.0, std::max(largest, means[k]));
      change = std::max(change, std::abs(better - result[k]));
      result[k] = better;
    }
    if (change <= tolerance) break;
  }
  return result;
}

}  // namespace millfoam::averaging
