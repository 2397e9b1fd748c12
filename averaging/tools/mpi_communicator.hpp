// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mpi.h>

#include <vector>

#include "averaging/run/communicator.hpp"

namespace millfoam::averaging {

/// The ranks of an MPI run. One thread of a rank calls it at a time.
class MpiCommunicator : public Communicator {
 public:
  /// Whether a launcher (mpirun, srun) started this process as one of several.
  static bool launched();

  /// Starts and, at the end, ends MPI.
  MpiCommunicator();
  ~MpiCommunicator() override;

  int rank() const override { return rank_; }
  int size() const override { return size_; }
  void send(const std::vector<double>& numbers) override;
  void receive(int rank, std::vector<double>& numbers) override;
  long long broadcast(long long number) override;

  /// Ends all ranks at once, after an error on this one.
  [[noreturn]] static void abort();

 private:
  void wait_until_sent();

  /// Data on its way to rank 0 while this rank continues.
  std::vector<double> sending_;
  std::vector<MPI_Request> requests_;
  int rank_ = 0;
  int size_ = 1;
};

}  // namespace millfoam::averaging
