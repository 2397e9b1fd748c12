// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/statistics/window_average.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace millfoam::averaging {

namespace {

void add_all(const std::vector<double>& from, std::vector<double>& to) {
  std::transform(to.begin(), to.end(), from.begin(), to.begin(), std::plus<>());
}

}  // namespace

WindowAverager::WindowAverager(const BoxGrid& grid)
    : voxel_volume_(grid.voxel_volume()),
      sums_(grid.size()),
      mean_volume_(grid.size(), 0.0),
      volume_squares_(grid.size(), 0.0),
      mean_velocity_(3 * grid.size(), 0.0),
      velocity_squares_(3 * grid.size(), 0.0) {}

void WindowAverager::add_to_spread(const RecordSums& record, std::size_t voxel) {
  const double volume = record.volume[voxel];
  const double difference = volume - mean_volume_[voxel];
  mean_volume_[voxel] += difference / static_cast<double>(records_);
  volume_squares_[voxel] += difference * (volume - mean_volume_[voxel]);
  if (volume == 0) return;
  const double share = volume / sums_.volume[voxel];
  for (std::size_t n = 3 * voxel; n < 3 * voxel + 3; ++n) {
    const double velocity = record.momentum[n] / volume;
    const double from_mean = velocity - mean_velocity_[n];
    mean_velocity_[n] += share * from_mean;
    velocity_squares_[n] += volume * from_mean * (velocity - mean_velocity_[n]);
  }
}

void WindowAverager::add(const RecordSums& record) {
  assert(record.volume.size() == sums_.volume.size());
  ++records_;
  add_all(record.volume, sums_.volume);
  add_all(record.momentum, sums_.momentum);
  add_all(record.volume_over_diameter, sums_.volume_over_diameter);
  add_all(record.volume_times_diameter, sums_.volume_times_diameter);
  add_all(record.volume_times_speed2, sums_.volume_times_speed2);
  for (std::size_t voxel = 0; voxel < record.volume.size(); ++voxel) add_to_spread(record, voxel);
  sums_.ledger.volume_in += record.ledger.volume_in;
  sums_.ledger.deposited += record.ledger.deposited;
  sums_.ledger.outside += record.ledger.outside;
  sums_.ledger.clipped += record.ledger.clipped;
}

WindowAverage WindowAverager::average() const {
  assert(records_ > 0);
  const auto count = static_cast<double>(records_);
  const std::size_t voxels = sums_.volume.size();
  WindowAverage result;
  result.time.records = records_;
  result.ledger = {sums_.ledger.volume_in / count, sums_.ledger.deposited / count,
                   sums_.ledger.outside / count, sums_.ledger.clipped / count};
  SolidsWindow& mean = result.mean;
  for (std::vector<double>* field : {&mean.solidity, &mean.diameter, &mean.diameter43,
                                     &result.solidity_deviation, &result.granular_temperature}) {
    field->assign(voxels, 0.0);
  }
  mean.velocity.assign(3 * voxels, 0.0);
  result.velocity_deviation.assign(3 * voxels, 0.0);

  for (std::size_t v = 0; v < voxels; ++v) {
    const double volume = sums_.volume[v];
    if (volume == 0) continue;
    mean.solidity[v] = volume / (count * voxel_volume_);
    mean.diameter[v] = volume / sums_.volume_over_diameter[v];
    mean.diameter43[v] = sums_.volume_times_diameter[v] / volume;
    result.solidity_deviation[v] = std::sqrt(volume_squares_[v] / count) / voxel_volume_;
    double speed2 = 0;
    for (std::size_t n = 3 * v; n < 3 * v + 3; ++n) {
      mean.velocity[n] = sums_.momentum[n] / volume;
      result.velocity_deviation[n] = std::sqrt(velocity_squares_[n] / volume);
      speed2 += mean.velocity[n] * mean.velocity[n];
    }
    // Rounding can leave a voxel in uniform motion just below zero.
    result.granular_temperature[v] = std::max(0.0, (sums_.volume_times_speed2[v] / volume - speed2) / 3);
  }
  return result;
}

}  // namespace millfoam::averaging
