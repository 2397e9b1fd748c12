// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "averaging/sharing/box_sampling.hpp"
#include "averaging/files/solids_file.hpp"

namespace millfoam::averaging {

/// Averages the records of one window. With phi_k and u_k the solidity and the mean particle velocity of
/// record k of K:
///
///     solidity                phi = sum_k phi_k / K
///     velocity                u = sum V v / sum V over all particles of all records = sum_k phi_k u_k /
///     sum_k phi_k diameter, diameter43    d32 = sum V / sum (V/d),  d43 = sum (V d) / sum V
///     solidity_deviation      sqrt(sum_k (phi_k - phi)^2 / K)
///     velocity_deviation      sqrt(sum_k phi_k (u_k - u)^2 / sum_k phi_k), per component
///     granular_temperature    sum V |v - u|^2 / (3 sum V)
///
/// The temperature is about the window's mean velocity, so it holds the motion of single balls and the drift
/// of the mean within the window; the drift's part is the mean square of velocity_deviation's components.
class WindowAverager {
 public:
  explicit WindowAverager(const BoxGrid& grid);

  /// Adds a record, sampled on the same grid.
  void add(const RecordSums& record);

  long long records() const { return records_; }

  /// The window's averages; needs at least one record. `time.records` is filled in, the window's times are
  /// the caller's.
  WindowAverage average() const;

 private:
  void add_to_spread(const RecordSums& record, std::size_t voxel);

  double voxel_volume_;
  long long records_ = 0;
  RecordSums sums_;
  // Running means and sums of squared differences from them, as Welford 1962 (Technometrics 4:419) and West
  // 1979 (Comm ACM 22:532): no difference of large squares is taken.
  std::vector<double> mean_volume_;
  std::vector<double> volume_squares_;
  std::vector<double> mean_velocity_;
  std::vector<double> velocity_squares_;
};

}  // namespace millfoam::averaging
