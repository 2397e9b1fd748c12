// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/files/text_numbers.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <sstream>

namespace millfoam {

std::optional<double> to_number(std::string_view word) {
  double value = 0;
  const char* begin = word.data() + (!word.empty() && word.front() == '+' ? 1 : 0);
  const char* end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (error != std::errc() || stop != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::string exact(double value) {
  std::array<char, 32> text;  // the longest, -2.2250738585072014e-308, has 24
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return {text.data(), end};
}

std::string exact(const Eigen::Vector3d& vector) {
  return exact(vector.x()) + ' ' + exact(vector.y()) + ' ' + exact(vector.z());
}

std::string shown(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

std::string described(const Eigen::Vector3d& point) {
  std::ostringstream text;
  text.precision(9);
  text << '(' << point.x() << ' ' << point.y() << ' ' << point.z() << ')';
  return text.str();
}

}  // namespace millfoam
