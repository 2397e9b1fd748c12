// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "meshing/yaml_section.hpp"

namespace millfoam::meshing {

/// Rules that many keys share; `what` is the quantity with its unit, as a message shows it.

inline Rule positive(const std::string& what) {
  return {what + " above 0", [](double v) { return v > 0; }};
}
inline Rule not_negative(const std::string& what) {
  return {what + " of 0 or more", [](double v) { return v >= 0; }};
}
/// Lengths above this are millimetres, not metres: the largest mills are 13 m wide.
inline constexpr double longest = 50;
/// Longer times than this are a slip: a mill's first turn takes seconds.
inline constexpr double longest_time = 1e5;

inline Rule length_of_mill() {
  return {"a length in m above 0 and up to " + shown(longest) + " m",
          [](double v) { return v > 0 && v <= longest; }};
}
inline Rule time_above_zero() {
  return {"a time in s above 0 and up to " + shown(longest_time) + " s",
          [](double v) { return v > 0 && v <= longest_time; }};
}
inline Rule time_from_zero() {
  return {"a time in s of 0 or more and up to " + shown(longest_time) + " s",
          [](double v) { return v >= 0 && v <= longest_time; }};
}
inline Rule positive_below(const std::string& what, double bound, const std::string& unit,
                           const std::string& of) {
  return {what + " above 0 and below " + of + ", " + shown(bound) + unit,
          [bound](double v) { return v > 0 && v < bound; }};
}
inline Rule at_least_one(const std::string& what) {
  return {"a whole number of " + what + ", 1 or more", [](double v) { return v >= 1; }};
}

}  // namespace millfoam::meshing
