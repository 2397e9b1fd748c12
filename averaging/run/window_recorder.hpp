// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <vector>

#include "averaging/files/window_journal.hpp"
#include "averaging/statistics/window_average.hpp"

namespace millfoam::averaging {

/// The windows of a series on their way to a solids file: the moments of the one under way, and a journal of
/// the finished ones. All members throw SolidsFileError as `WindowJournal`.
class WindowRecorder {
 public:
  /// @param journal  file of the finished windows
  /// @param limits  for `average`; must outlive the recorder
  /// @param cells   number of cells of the fields
  /// @param id      of the run, for the journal
  /// @param rows    finished windows of an earlier run that was killed
  WindowRecorder(const std::filesystem::path& journal, const CellLimits& limits, std::size_t cells,
                 std::size_t id, std::size_t rows);

  /// The window under way.
  WindowMoments& open() { return open_; }
  /// The same, to be read.
  const WindowMoments& open() const { return open_; }

  /// The averages of the window under way. Throws as `average`, with the begin of the window.
  /// @param time  of the window, s
  WindowAverage average_open(const TimeWindow& time) const;

  /// Puts the window under way into the journal, and begins an empty one. Throws as `average_open`.
  void close(const TimeWindow& time);

  std::size_t finished() const { return journal_.rows(); }  ///< number of closed windows
  /// A closed window, from 0.
  WindowAverage read(std::size_t row) const { return journal_.read(row); }
  /// Waits until the finished windows are on the disk.
  void sync() { journal_.sync(); }

 private:
  const CellLimits& limits_;
  WindowMoments open_;
  WindowJournal journal_;
};

}  // namespace millfoam::averaging
