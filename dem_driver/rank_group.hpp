// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

namespace millfoam::dem_driver {

/// What the ranks of a run tell each other. This class is for a run on one rank; millLiggghts has one for
/// MPI.
class RankGroup {
 public:
  RankGroup() = default;
  virtual ~RankGroup() = default;
  RankGroup(const RankGroup&) = delete;
  RankGroup& operator=(const RankGroup&) = delete;

  /// Number of this rank, from 0.
  virtual int rank() const { return 0; }
  /// Adds up the numbers of all ranks, entry by entry; the sums are on rank 0.
  virtual void sum(std::vector<double>& numbers) { static_cast<void>(numbers); }
  /// Gives all ranks the numbers of rank 0, in any quantity.
  virtual void broadcast(std::vector<double>& numbers) { static_cast<void>(numbers); }

  /// The sums of the numbers of all ranks, on every rank.
  std::vector<double> all_sums(std::vector<double> numbers) {
    sum(numbers);
    broadcast(numbers);
    return numbers;
  }
};

}  // namespace millfoam::dem_driver
