// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "averaging/dumps/dump_series.hpp"
#include "averaging/run/cell_setup.hpp"
#include "averaging/run/record_blocks.hpp"
#include "averaging/statistics/window_moments.hpp"

namespace millfoam::averaging {

/// What the records of a block give.
struct BlockResult {
  WindowMoments moments;        ///< of all its records
  std::vector<double> volumes;  ///< [records] of the balls, m^3
};

/// Averages blocks of records in one thread.
class RecordWorker {
 public:
  /// @param setup  the grid or mesh; must outlive the worker
  /// @param dumps  files of all records; must outlive the worker
  /// @param timestep  of the DEM run, s
  RecordWorker(const CellSetup& setup, const std::vector<DumpFile>& dumps, double timestep);

  /// Reads the block's dumps and takes their moments; valid until the next call. Throws DumpError, and as
  /// `sum_record` with the dump's name.
  const BlockResult& process(const RecordBlock& block);

 private:
  const CellSetup& setup_;
  const std::vector<DumpFile>& dumps_;
  double timestep_;
  std::unique_ptr<Deposition> deposition_;
  RecordSums sums_;
  BlockResult result_;
};

}  // namespace millfoam::averaging
