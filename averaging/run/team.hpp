// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

namespace millfoam::averaging {

/// The processes that average together. This one is for a process alone; the tool has one for MPI.
class Team {
 public:
  Team() = default;
  virtual ~Team() = default;
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  virtual int rank() const { return 0; }
  virtual int size() const { return 1; }

  /// Hands numbers to rank 0, which waits for them in `receive`.
  virtual void send(const std::vector<double>& numbers) { static_cast<void>(numbers); }

  /// Numbers from a rank, as many as `numbers` has room for.
  virtual void receive(int rank, std::vector<double>& numbers) {
    static_cast<void>(rank);
    static_cast<void>(numbers);
  }

  /// The number that rank 0 has, for all.
  virtual long long from_first(long long number) { return number; }
};

}  // namespace millfoam::averaging
