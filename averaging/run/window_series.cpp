// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/run/window_series.hpp"

#include <utility>

namespace millfoam::averaging {

WindowSeries::WindowSeries(const std::filesystem::path& output, WindowPlan plan, double timestep,
                           const CellLimits& limits, std::size_t cells, std::size_t id, std::size_t rows)
    : output_(output),
      plan_(std::move(plan)),
      timestep_(timestep),
      recorder_(journal_path(output), limits, cells, id, rows) {}

std::filesystem::path WindowSeries::journal_path(const std::filesystem::path& output) {
  return output.string() + ".journal";
}

void WindowSeries::add(const RecordBlock& block, const WindowMoments& moments) {
  const std::size_t window = recorder_.finished();
  if (window == plan_.windows.size() || block.first < plan_.windows[window].first_record) return;
  const WindowSpan& span = plan_.windows[window];
  recorder_.open().merge(moments);
  if (block.last < span.first_record + span.records) return;
  recorder_.close(time_of(span, timestep_));
}

void WindowSeries::forget() const {
  std::error_code no_matter;
  std::filesystem::remove(journal_path(output_), no_matter);
}

}  // namespace millfoam::averaging
