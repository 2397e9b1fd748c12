// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "averaging/run/record_blocks.hpp"
#include "averaging/run/window_recorder.hpp"

namespace millfoam::averaging {

/// The windows of one length of recorded dumps: takes in the blocks of records in order, and closes each
/// window when its last block is in.
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

  /// Its windows, finished and under way.
  WindowRecorder& recorder() { return recorder_; }

  /// Removes the journal.
  void forget() const;

  /// The journal of an output.
  static std::filesystem::path journal_path(const std::filesystem::path& output);

 private:
  std::filesystem::path output_;
  WindowPlan plan_;
  double timestep_;
  WindowRecorder recorder_;
};

}  // namespace millfoam::averaging
