// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

namespace millfoam::averaging {

/// Messages between the processes that average together. This class is for a process alone; the tool has one
/// for MPI.
class Communicator {
 public:
  Communicator() = default;
  virtual ~Communicator() = default;
  Communicator(const Communicator&) = delete;
  Communicator& operator=(const Communicator&) = delete;

  /// Number of this process, from 0.
  virtual int rank() const { return 0; }
  /// Number of processes.
  virtual int size() const { return 1; }

  /// Hands numbers to rank 0, which waits for them in `receive`.
  virtual void send(const std::vector<double>& numbers) { static_cast<void>(numbers); }

  /// Overwrites `numbers` with as many from a rank.
  virtual void receive(int rank, std::vector<double>& numbers) {
    static_cast<void>(rank);
    static_cast<void>(numbers);
  }

  /// Leaves on rank 0 the sums over all ranks, entry by entry. Other ranks may be left with any numbers.
  /// @param numbers  as many on every rank
  virtual void sum(std::vector<double>& numbers) { static_cast<void>(numbers); }

  /// The number that rank 0 has, for all.
  virtual long long broadcast(long long number) { return number; }
};

}  // namespace millfoam::averaging
