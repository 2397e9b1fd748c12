// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>

#include "averaging/files/window_journal.hpp"
#include "averaging/run/record_blocks.hpp"
#include "averaging/statistics/window_average.hpp"

namespace millfoam::averaging {

/// The windows of one length: takes in the blocks of records in order, closes each window when its last block
/// is in, and writes the solids file when all are.
class WindowSeries {
 public:
  /// @param output  the solids file; its windows are kept in `output` + ".journal" until it is complete
  /// @param plan    the windows, in order of time
  /// @param timestep  of the DEM run, s
  /// @param cells   number of cells of the fields
  /// @param id      of the run, for the journal
  /// @param rows    finished windows of an earlier run that was killed
  /// @param limits  for `average`; must outlive the series
  WindowSeries(const std::filesystem::path& output, WindowPlan plan, double timestep,
               const CellLimits& limits, std::size_t cells, std::size_t id, std::size_t rows);

  /// Adds a block: the next one, or one that no window of this series holds. Throws SolidsFileError, and as
  /// `average` with the time of the window.
  void add(const RecordBlock& block, const WindowMoments& moments);

  std::size_t finished() const { return journal_.rows(); }    ///< number of closed windows
  const WindowMoments& open_window() const { return open_; }  ///< the one under way
  /// Takes up the window under way of an earlier run, `WindowMoments::packed`.
  void restore(const std::vector<double>& packed) { open_.unpack(packed); }

  /// Waits until the finished windows are on the disk.
  void sync() { journal_.sync(); }

  /// Writes the solids file and its .xdmf, calling `each` with every window. Throws SolidsFileError.
  void write(const Grid& grid, const SolidsHeader& header,
             const std::function<void(const WindowAverage&)>& each) const;

  /// Removes the journal.
  void forget() const;

  /// The journal of an output.
  static std::filesystem::path journal_path(const std::filesystem::path& output);

 private:
  WindowAverage average_of_window(double begin) const;

  std::filesystem::path output_;
  WindowPlan plan_;
  double timestep_;
  const CellLimits& limits_;
  WindowMoments open_;
  WindowJournal journal_;
};

}  // namespace millfoam::averaging
