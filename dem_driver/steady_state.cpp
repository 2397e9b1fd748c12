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

/// Means of ten batches of the values from `begin` on.
std::vector<double> batch_means(const std::vector<double>& values, std::size_t begin) {
  const std::size_t count = values.size() - begin;
  std::vector<double> means;
  for (std::size_t b = 0; b < batches; ++b)
    means.push_back(mean_of(values, begin + b * count / batches, begin + (b + 1) * count / batches));
  return means;
}

/// Standard error of the mean of batch means, from their differences from a straight line, so that a drift
/// does not hide itself in the error.
double error_about_line(const std::vector<double>& means) {
  const std::size_t count = means.size();
  const double mean = mean_of(means, 0, count);
  const double middle = static_cast<double>(count - 1) / 2;
  double moment = 0;
  double spread = 0;
  for (std::size_t b = 0; b < count; ++b) {
    const double place = static_cast<double>(b) - middle;
    moment += place * means[b];
    spread += place * place;
  }
  const double slope = moment / spread;
  double squares = 0;
  for (std::size_t b = 0; b < count; ++b) {
    const double rest = means[b] - mean - slope * (static_cast<double>(b) - middle);
    squares += rest * rest;
  }
  return std::sqrt(squares / static_cast<double>(count * (count - 2)));
}

/// Means of a series between places that need not be at its values; each value is that of the time since the
/// one before.
class Means {
 public:
  explicit Means(const std::vector<double>& values) {
    for (const double value : values) sums_.push_back(sums_.back() + value);
  }
  /// @param from, to  in values
  double between(double from, double to) const { return (up_to(to) - up_to(from)) / (to - from); }

 private:
  double up_to(double place) const {
    const double last = static_cast<double>(sums_.size()) - 2;
    const double below = std::clamp(std::floor(place), 0.0, last);
    const auto i = static_cast<std::size_t>(below);
    return sums_[i] + (place - below) * (sums_[i + 1] - sums_[i]);
  }
  std::vector<double> sums_ = {0};
};

/// The last whole turns of a series.
SteadyMean mean_of_turns(const std::vector<double>& values, double turn, std::size_t turns) {
  const std::size_t in_batch = std::max<std::size_t>(turns / batches, 1), count = turns / in_batch;
  const auto end = static_cast<double>(values.size());
  const double length = static_cast<double>(in_batch) * turn;
  const double start = std::max(end - static_cast<double>(count) * length, 0.0);
  const Means means(values);
  std::vector<double> of_batches;
  for (std::size_t b = count; b-- > 0;) {
    const double to = end - static_cast<double>(b) * length;
    of_batches.push_back(means.between(std::max(to - length, 0.0), to));
  }
  const std::size_t turns_in_half = count * in_batch / 2;
  const double half = static_cast<double>(turns_in_half) * turn;
  constexpr double round_off = 1e-6;
  return {static_cast<std::size_t>(start + round_off), mean_of(of_batches, 0, count),
          error_about_line(of_batches), means.between(end - half, end) - means.between(start, start + half)};
}

}  // namespace

SteadyMean mean_since(const std::vector<double>& values, std::size_t begin, double turn) {
  const std::size_t count = values.size() - begin;
  // Records are a rounded part of a turn
  const double turns = turn > 0 ? std::floor(static_cast<double>(count) / turn + 0.005) : 0;
  if (turns >= fewest_turns) return mean_of_turns(values, turn, static_cast<std::size_t>(turns));
  const double mean = mean_of(values, begin, values.size());
  if (count < batches) return {begin, mean, std::numeric_limits<double>::quiet_NaN(), 0};
  const std::size_t middle = (begin + values.size()) / 2;
  return {begin, mean, error_about_line(batch_means(values, begin)),
          mean_of(values, middle, values.size()) - mean_of(values, begin, middle)};
}

Steadiness judge_steadiness(const std::vector<double>& values, double turn) {
  Steadiness result;
  if (values.empty()) return result;
  if (values.size() < fewest_values) {
    result.mean = mean_of(values, 0, values.size());
    return result;
  }
  const std::size_t cut = end_of_transient(values);
  const SteadyMean found = mean_since(values, cut, turn);
  result.begin = found.begin;
  result.mean = found.mean;
  result.standard_error = found.standard_error;
  result.drift = found.drift;
  const auto [lowest, highest] =
      std::minmax_element(values.begin() + static_cast<std::ptrdiff_t>(cut), values.end());
  const double scale = std::max(std::abs(result.mean), *highest - *lowest);
  // The difference of two halves has twice the error of the whole's mean.
  const double allowed = std::max(3 * 2 * result.standard_error, allowed_drift * scale);
  result.steady = cut < values.size() / 2 && std::abs(result.drift) <= allowed;
  return result;
}

}  // namespace millfoam::dem_driver
