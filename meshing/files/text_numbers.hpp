// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <charconv>
#include <cmath>
#include <optional>
#include <string>

namespace millfoam::meshing {

/// The finite number that a word is as a whole, whatever the locale; nothing for any other word.
inline std::optional<double> to_number(const std::string& word) {
  double value = 0;
  const char* begin = word.data() + (!word.empty() && word.front() == '+' ? 1 : 0);
  const char* end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (error != std::errc() || stop != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

}  // namespace millfoam::meshing
