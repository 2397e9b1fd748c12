// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/fields/time_spline.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
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

std::vector<double> TimeSpline::unbounded(const std::vector<double>& means) const {
  std::vector<double> result = means;
  const double tolerance = 1e-16 * *std::max_element(means.begin(), means.end());
  // Gauss-Seidel. Each pass leaves at most half of the error: a window's neighbours count at most half as
  // much as it
  for (int pass = 0; pass < 60; ++pass) {
    double change = 0;
    for (std::size_t k = 0; k < size(); ++k) {
      // Means of the parabolas (1 - x)^2 and x^2 are 1/3; a window that is its own neighbour counts as itself
      const auto [first, last] = outer_shares(k);
      const double left = before(k) == k ? 0 : first / 3;
      const double right = after(k) == k ? 0 : last / 3;
      const double better =
          (means[k] - left * result[before(k)] - right * result[after(k)]) / (1 - left - right);
      change = std::max(change, std::abs(better - result[k]));
      result[k] = better;
    }
    if (change <= tolerance) break;
  }
  return result;
}

std::vector<double> TimeSpline::integrals() const {
  std::vector<double> result(size(), 0);
  for (std::size_t k = 0; k < size(); ++k) {
    const auto [first, last] = outer_shares(k);
    result[before(k)] += lengths_[k] * first / 3;
    result[k] += lengths_[k] * (1 - (first + last) / 3);
    result[after(k)] += lengths_[k] * last / 3;
  }
  return result;
}

std::vector<double> TimeSpline::coefficients(const std::vector<double>& means, double largest) const {
  const std::vector<double> wanted = unbounded(means);
  const std::vector<double> weights = integrals();
  // What goes from each window to the one after it, integrated in time
  std::vector<double> given(size(), 0);
  double sum = 0;
  for (std::size_t k = 0; k < size(); ++k) {
    sum += lengths_[k] * means[k] - weights[k] * wanted[k];
    given[k] = sum;
  }
  if (repeats_) {
    const double mean = std::accumulate(given.begin(), given.end(), 0.0) / static_cast<double>(size());
    for (double& each : given) each -= mean;
  } else {
    given.back() = 0;
  }

  // The share of what a window gives and of what it takes for which it stays within the bounds
  std::vector<double> may_give(size(), 1);
  std::vector<double> may_take(size(), 1);
  for (std::size_t k = 0; k < size(); ++k) {
    const double content = lengths_[k] * means[k];
    // A window without the quantity takes none: what else it knows of the quantity, as its velocity, is not
    // known
    const double room = content > 0 ? std::max(largest * weights[k] - content, 0.0) : 0.0;
    const double from_before = given[(k + size() - 1) % size()];
    const double gives = std::max(given[k], 0.0) + std::max(-from_before, 0.0);
    const double takes = std::max(-given[k], 0.0) + std::max(from_before, 0.0);
    if (gives > content) may_give[k] = content / gives;
    if (takes > room) may_take[k] = room / takes;
  }

  std::vector<double> result(size());
  for (std::size_t k = 0; k < size(); ++k) result[k] = lengths_[k] * means[k] / weights[k];
  for (std::size_t k = 0; k < size(); ++k) {
    const std::size_t next = (k + 1) % size();
    const double share =
        given[k] > 0 ? std::min(may_give[k], may_take[next]) : std::min(may_give[next], may_take[k]);
    result[k] -= share * given[k] / weights[k];
    result[next] += share * given[k] / weights[next];
  }
  for (double& each : result) each = std::max(each, 0.0);  // of round-off
  return result;
}

}  // namespace millfoam::averaging
