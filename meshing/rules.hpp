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
inline Rule positive_below(const std::string& what, double bound, const std::string& unit,
                           const std::string& of) {
  return {what + " above 0 and below " + of + ", " + shown(bound) + unit,
          [bound](double v) { return v > 0 && v < bound; }};
}
inline Rule at_least_one(const std::string& what) {
  return {"a whole number of " + what + ", 1 or more", [](double v) { return v >= 1; }};
}

}  // namespace millfoam::meshing
