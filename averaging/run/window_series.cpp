// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/run/window_series.hpp"

#include <sstream>
#include <stdexcept>
#include <utility>

#include "averaging/files/xdmf.hpp"

namespace millfoam::averaging {

WindowSeries::WindowSeries(const std::filesystem::path& output, WindowPlan plan, double timestep,
                           const CellLimits& limits, std::size_t cells, std::size_t id, std::size_t rows)
    : output_(output),
      plan_(std::move(plan)),
      timestep_(timestep),
      limits_(limits),
      open_(cells),
      journal_(journal_path(output), id, cells, !limits.whole_volumes.empty(), rows) {}

std::filesystem::path WindowSeries::journal_path(const std::filesystem::path& output) {
  return output.string() + ".journal";
}

void WindowSeries::add(const RecordBlock& block, const WindowMoments& moments) {
  const std::size_t window = journal_.rows();
  if (window == plan_.windows.size() || block.first < plan_.windows[window].first_record) return;
  const WindowSpan& span = plan_.windows[window];
  open_.merge(moments);
  if (block.last < span.first_record + span.records) return;
  const double begin = static_cast<double>(span.begin) * timestep_;
  WindowAverage result = average_of_window(begin);
  result.time.begin = begin;
  result.time.end = static_cast<double>(span.end) * timestep_;
  result.time.starts_late = span.starts_late;
  result.time.ends_short = span.ends_short;
  journal_.append(result);
  open_.clear();
}

WindowAverage WindowSeries::average_of_window(double begin) const {
  try {
    return average(open_, limits_);
  } catch (const std::runtime_error& error) {
    std::ostringstream message;
    message << "window from " << begin << " s: " << error.what();
    throw std::runtime_error(message.str());
  }
}

void WindowSeries::write(const Grid& grid, const SolidsHeader& header,
                         const std::function<void(const WindowAverage&)>& each) const {
  SolidsWriter writer(output_, grid, header);
  for (std::size_t row = 0; row < journal_.rows(); ++row) {
    const WindowAverage window = journal_.read(row);
    writer.append(window);
    each(window);
  }
  writer.finish();
  write_xdmf(output_);
}

void WindowSeries::forget() const {
  std::filesystem::remove(journal_path(output_));
}

}  // namespace millfoam::averaging
