// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/run/window_recorder.hpp"

#include <sstream>

#include "averaging/statistics/redistribution.hpp"

namespace millfoam::averaging {

WindowRecorder::WindowRecorder(const std::filesystem::path& journal, const CellLimits& limits,
                               std::size_t cells, std::size_t id, std::size_t rows)
    : limits_(limits), open_(cells), journal_(journal, id, cells, !limits.whole_volumes.empty(), rows) {}

WindowAverage WindowRecorder::average_open(const TimeWindow& time) const {
  try {
    WindowAverage result = average(open_, limits_);
    const long long records = result.time.records;
    result.time = time;
    result.time.records = records;
    return result;
  } catch (const NoRoomError& error) {
    std::ostringstream message;
    message << "window from " << time.begin << " s: " << error.what();
    throw NoRoomError(message.str(), error.cell, error.excess);
  }
}

void WindowRecorder::close(const TimeWindow& time) {
  journal_.append(average_open(time));
  open_.clear();
}

}  // namespace millfoam::averaging
