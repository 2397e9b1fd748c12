// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/tools/mpi_communicator.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <stdexcept>

namespace millfoam::averaging {

namespace {

/// MPI counts with int: longer messages go in pieces.
constexpr std::size_t piece = 1U << 26;

template <typename Numbers, typename Action>
void in_pieces(Numbers& numbers, Action&& action) {
  for (std::size_t done = 0; done < numbers.size(); done += piece) {
    action(numbers.data() + done, static_cast<int>(std::min(piece, numbers.size() - done)));
  }
}

}  // namespace

bool MpiCommunicator::launched() {
  constexpr std::array<const char*, 3> set_by_launchers{"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "PMIX_RANK"};
  return std::any_of(set_by_launchers.begin(), set_by_launchers.end(),
                     [](const char* name) { return std::getenv(name) != nullptr; });
}

MpiCommunicator::MpiCommunicator() {
  int provided = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &provided);
  if (provided < MPI_THREAD_SERIALIZED) {
    throw std::runtime_error("this MPI cannot be used by programs with threads");
  }
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &size_);
}

MpiCommunicator::~MpiCommunicator() {
  wait_until_sent();
  MPI_Finalize();
}

void MpiCommunicator::send(const std::vector<double>& numbers) {
  wait_until_sent();
  sending_ = numbers;
  in_pieces(sending_, [this](const double* first, int count) {
    MPI_Request& request = requests_.emplace_back(MPI_REQUEST_NULL);
    MPI_Isend(first, count, MPI_DOUBLE, 0, 0, MPI_COMM_WORLD, &request);
  });
}

void MpiCommunicator::wait_until_sent() {
  MPI_Waitall(static_cast<int>(requests_.size()), requests_.data(), MPI_STATUSES_IGNORE);
  requests_.clear();
}

void MpiCommunicator::receive(int rank, std::vector<double>& numbers) {
  in_pieces(numbers, [rank](double* first, int count) {
    MPI_Recv(first, count, MPI_DOUBLE, rank, 0, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  });
}

long long MpiCommunicator::broadcast(long long number) {
  MPI_Bcast(&number, 1, MPI_LONG_LONG, 0, MPI_COMM_WORLD);
  return number;
}

void MpiCommunicator::abort() {
  MPI_Abort(MPI_COMM_WORLD, 1);
  std::abort();
}

}  // namespace millfoam::averaging
