// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/progress.hpp"

#include <algorithm>
#include <cmath>
#include <ostream>
#include <sstream>

namespace millfoam::dem_driver {

namespace {

std::string clock(double seconds) {
  const long whole = std::lround(seconds);
  std::ostringstream text;
  text << whole / 60 << ':' << (whole % 60 < 10 ? "0" : "") << whole % 60;
  return text.str();
}

}  // namespace

Progress::Progress(std::ostream& out, bool terminal, long total)
    : out_(out), terminal_(terminal), total_(std::max(1L, total)) {}

void Progress::show(long done, const std::string& what) {
  if (done > 0 && first_ == 0) {
    first_ = done;
    start_ = std::chrono::steady_clock::now();
  }
  const int percent = static_cast<int>(std::min(100L, 100 * done / total_));
  const int mark = terminal_ ? percent : percent / 10;
  if (mark == shown_) return;
  shown_ = mark;

  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
  std::ostringstream line;
  if (terminal_) {
    const auto filled = static_cast<std::size_t>(percent * 30 / 100);
    line << "\r[" << std::string(filled, '#') << std::string(30 - filled, '.') << "] ";
  }
  line << percent << " %, " << what;
  if (done > first_) {
    const double left =
        elapsed.count() * static_cast<double>(total_ - done) / static_cast<double>(done - first_);
    line << ", " << clock(std::max(0.0, left)) << " left";
  }
  out_ << line.str() << (terminal_ ? "   " : "\n") << std::flush;
}

void Progress::end() {
  if (terminal_ && shown_ >= 0) out_ << '\n' << std::flush;
}

}  // namespace millfoam::dem_driver
