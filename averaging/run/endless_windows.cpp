// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/run/endless_windows.hpp"

#include "averaging/statistics/time_windows.hpp"

namespace millfoam::averaging {

EndlessWindows::EndlessWindows(const AverageRequest& request, const WindowsRequest& windows, double timestep,
                               long long begin)
    : timestep_(timestep),
      start_(request.start ? whole_steps(*request.start, timestep, "the start") : begin) {
  if (windows.length) length_ = whole_steps(*windows.length, timestep, "the window's length");
  if (request.end) end_ = whole_steps(*request.end, timestep, "the end");
}

std::size_t EndlessWindows::window_of(long long step) const {
  return length_ ? static_cast<std::size_t>((step - start_) / *length_) : 0;
}

TimeWindow EndlessWindows::time_of(std::size_t window) const {
  TimeWindow time;
  const long long begin = start_ + static_cast<long long>(window) * length_.value_or(0);
  time.begin = static_cast<double>(begin) * timestep_;
  time.end = static_cast<double>(begin + length_.value_or(0)) * timestep_;
  return time;
}

}  // namespace millfoam::averaging
