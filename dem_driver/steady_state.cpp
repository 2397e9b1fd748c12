// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/steady_state.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace millfoam::dem_driver {

namespace {

constexpr std::size_t batches = 10;

double mean_of(const std::vector<double>& values, std::size_t from, std::size_t to) {
  const auto at = [&](std::size_t i) { return values.begin() + static_cast<std::ptrdiff_t>(i); };
  return std::accumulate(at(from), at(to), 0.0) / static_cast<double>(to - from);
}

/// The index from which on the sum of squares about the mean, over the number of values squared, is least.
std::size_t end_of_transient(const std::vector<double>& values) {
  // From the back, so that one pass does (B. P. Welford's update of the sum of squares).
  double mean = 0;
  double squares = 0;
  double least = std::numeric_limits<double>::infinity();
  std::size_t best = 0;
  const std::size_t half = values.size() / 2;
  for (std::size_t i = values.size(); i-- > 0;) {
    const auto count = static_cast<double>(values.size() - i);
    const double before = values[i] - mean;
    mean += before / count;
    squares += before * (values[i] - mean);
    if (i > half) continue;
    const double error = squares / (count * count);
    if (error <= least) {
      least = error;
      best = i;
    }
  }
  return best;
}

/// Standard error of the mean of the values from `begin` on, from batch means about their straight line, so
/// that a drift does not hide itself in the error.
double batch_error(const std::vector<double>& values, std::size_t begin) {
  const std::size_t count = values.size() - begin;
  std::vector<double> means;
  for (std::size_t b = 0; b < batches; ++b)
    means.push_back(mean_of(values, begin + b * count / batches, begin + (b + 1) * count / batches));
  const double mean = mean_of(means, 0, batches);
  const double middle = static_cast<double>(batches - 1) / 2;
  double moment = 0;
  double spread = 0;
  for (std::size_t b = 0; b < batches; ++b) {
    const double place = static_cast<double>(b) - middle;
    moment += place * means[b];
    spread += place * place;
  }
  const double slope = moment / spread;
  double squares = 0;
  for (std::size_t b = 0; b < batches; ++b) {
    const double rest = means[b] - mean - slope * (static_cast<double>(b) - middle);
    squares += rest * rest;
  }
  return std::sqrt(squares / static_cast<double>(batches * (batches - 2)));
}

}  // namespace

Steadiness judge_steadiness(const std::vector<double>& values) {
  Steadiness result;
  if (values.empty()) return result;
  if (values.size() < fewest_values) {
    result.mean = mean_of(values, 0, values.size());
    return result;
  }
  result.begin = end_of_transient(values);
  result.mean = mean_of(values, result.begin, values.size());
  result.standard_error = batch_error(values, result.begin);
  const std::size_t middle = (result.begin + values.size()) / 2;
  result.drift = mean_of(values, middle, values.size()) - mean_of(values, result.begin, middle);
  const auto [lowest, highest] =
      std::minmax_element(values.begin() + static_cast<std::ptrdiff_t>(result.begin), values.end());
  const double scale = std::max(std::abs(result.mean), *highest - *lowest);
  // The difference of two halves has twice the error of the whole's mean.
  const double allowed = std::max(3 * 2 * result.standard_error, allowed_drift * scale);
  result.steady = result.begin < values.size() / 2 && std::abs(result.drift) <= allowed;
  return result;
}

}  // namespace millfoam::dem_driver
