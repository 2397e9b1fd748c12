// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/statistics/window_moments.hpp"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <functional>

#include "averaging/values/solids_window.hpp"

namespace millfoam::averaging {

WindowMoments::WindowMoments(std::size_t cells)
    : cells_(cells), sums_(cells * RecordSums::columns, 0.0), spreads_(cells * spreads, 0.0) {}

void WindowMoments::clear() {
  totals_ = {};
  std::fill(sums_.begin(), sums_.end(), 0.0);
  std::fill(spreads_.begin(), spreads_.end(), 0.0);
}

void WindowMoments::add_to_spread(const RecordSums& record, std::size_t cell) {
  double* const s = &spreads_[cell * spreads];
  const double volume = record.at(cell, RecordSums::volume), cell_volume = record.cell_volumes[cell];
  s[inside_volume] += cell_volume;
  const double solidity = cell_volume > 0 ? volume / cell_volume : 0;
  const double difference = solidity - s[solidity_mean];
  s[solidity_mean] += difference / totals_.records;
  s[solidity_squares] += difference * (solidity - s[solidity_mean]);
  if (volume == 0) return;
  if (volume >= least_solidity * cell_volume) totals_.occupied += 1;
  totals_.balls += record.at(cell, RecordSums::balls);
  const double share = volume / sum(cell, RecordSums::volume);
  for (std::size_t a = 0; a < 3; ++a) {
    const double velocity = record.at(cell, RecordSums::momentum + a) / volume;
    const double from_mean = velocity - s[velocity_mean + a];
    s[velocity_mean + a] += share * from_mean;
    s[velocity_squares + a] += volume * from_mean * (velocity - s[velocity_mean + a]);
  }
}

void WindowMoments::add(const RecordSums& record) {
  assert(record.cells() == cells_);
  totals_.records += 1;
  totals_.ledger += record.ledger;
  std::transform(sums_.begin(), sums_.end(), record.values.begin(), sums_.begin(), std::plus<>());
  for (std::size_t cell = 0; cell < cells_; ++cell) add_to_spread(record, cell);
}

void WindowMoments::merge(const WindowMoments& later) {
  assert(later.cells_ == cells_);
  if (later.totals_.records == 0) return;
  const double records = totals_.records + later.totals_.records;
  const double later_share = later.totals_.records / records;
  for (std::size_t cell = 0; cell < cells_; ++cell) {
    double* const s = &spreads_[cell * spreads];
    const double* const l = later.spread(cell);
    s[inside_volume] += l[inside_volume];
    const double step = l[solidity_mean] - s[solidity_mean];
    s[solidity_mean] += step * later_share;
    s[solidity_squares] += l[solidity_squares] + step * step * totals_.records * later_share;
    const double volume = sum(cell, RecordSums::volume), added = later.sum(cell, RecordSums::volume);
    if (added == 0) continue;
    const double share = added / (volume + added);
    for (std::size_t a = 0; a < 3; ++a) {
      const double jump = l[velocity_mean + a] - s[velocity_mean + a];
      s[velocity_mean + a] += jump * share;
      s[velocity_squares + a] += l[velocity_squares + a] + jump * jump * volume * share;
    }
  }
  std::transform(sums_.begin(), sums_.end(), later.sums_.begin(), sums_.begin(), std::plus<>());
  totals_.records = records;
  totals_.occupied += later.totals_.occupied;
  totals_.balls += later.totals_.balls;
  totals_.ledger += later.totals_.ledger;
}

double WindowMoments::solidity_variance(std::size_t cell) const {
  return std::max(0.0, spread(cell)[solidity_squares] / totals_.records);
}

double WindowMoments::velocity_variance(std::size_t cell, std::size_t component) const {
  const double volume = sum(cell, RecordSums::volume);
  return volume > 0 ? std::max(0.0, spread(cell)[velocity_squares + component] / volume) : 0;
}

std::size_t WindowMoments::packed_size(std::size_t cells) {
  return totals_count + cells * (RecordSums::columns + spreads);
}

std::vector<double> WindowMoments::packed() const {
  std::vector<double> numbers(packed_size(cells_));
  std::memcpy(numbers.data(), &totals_, sizeof totals_);
  const auto after_totals = numbers.begin() + static_cast<std::ptrdiff_t>(totals_count);
  std::copy(spreads_.begin(), spreads_.end(), std::copy(sums_.begin(), sums_.end(), after_totals));
  return numbers;
}

void WindowMoments::unpack(const std::vector<double>& numbers) {
  assert(numbers.size() == packed_size(cells_));
  std::memcpy(static_cast<void*>(&totals_), numbers.data(), sizeof totals_);
  const auto begin = numbers.begin() + static_cast<std::ptrdiff_t>(totals_count);
  const auto middle = begin + static_cast<std::ptrdiff_t>(sums_.size());
  std::copy(begin, middle, sums_.begin());
  std::copy(middle, numbers.end(), spreads_.begin());
}

}  // namespace millfoam::averaging
