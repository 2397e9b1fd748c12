// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "meshing/files/text_numbers.hpp"
#include "meshing/mill/mill.hpp"
#include "meshing/mill/yaml_section.hpp"

namespace millfoam::meshing {

// Rules that many keys share; `what` is the quantity with its unit, as a message shows it. Every number has
// an upper bound, so that an error (another unit, a digit too many) is refused.

/// A number above 0 and up to `most`.
inline Rule positive_up_to(const std::string& what, double most) {
  return {what + " above 0 and up to " + shown(most), [=](double v) { return v > 0 && v <= most; }};
}

/// A number from `least` to `most`.
inline Rule from_to(const std::string& what, double least, double most) {
  return {what + " from " + shown(least) + " to " + shown(most),
          [=](double v) { return v >= least && v <= most; }};
}

/// A number of 0 or more and up to `most`.
inline Rule zero_up_to(const std::string& what, double most) {
  return {what + " of 0 or more and up to " + shown(most), [=](double v) { return v >= 0 && v <= most; }};
}

/// A whole number of `what` from `least` to `most`.
inline Rule whole_number(const std::string& what, int least, int most) {
  return {"a whole number of " + what + " from " + std::to_string(least) + " to " + std::to_string(most),
          [=](double v) { return v >= least && v <= most; }};
}

/// m. Lengths above this are millimetres, not metres: the largest mills are 13 m wide.
inline constexpr double longest = 50;

/// s. Longer times than this are an error: a mill's first turn takes seconds.
inline constexpr double longest_time = 1e5;

/// A length, m, that a part of a mill can have.
inline Rule length_of_mill() {
  return {"a length in m above 0 and up to " + shown(longest) + " m",
          [](double v) { return v > 0 && v <= longest; }};
}

/// A time, s, that is not 0.
inline Rule time_above_zero() {
  return {"a time in s above 0 and up to " + shown(longest_time) + " s",
          [](double v) { return v > 0 && v <= longest_time; }};
}

/// A time, s, that may be 0.
inline Rule time_from_zero() {
  return {"a time in s of 0 or more and up to " + shown(longest_time) + " s",
          [](double v) { return v >= 0 && v <= longest_time; }};
}

/// An interval of which a run may have a million.
inline Rule part_of(const std::string& what, double whole) {
  const double least = whole / 1e6;
  return {"a time in s from " + shown(least) + " s to that of the " + what + ", " + shown(whole) + " s",
          [=](double v) { return v >= least && v <= whole * (1 + 1e-9); }};
}

/// A number above 0 and below the `bound`, in `unit`, that is named `of`.
inline Rule positive_below(const std::string& what, double bound, const std::string& unit,
                           const std::string& of) {
  return {what + " above 0 and below " + of + ", " + shown(bound) + unit,
          [bound](double v) { return v > 0 && v < bound; }};
}

/// A number of turns in a minute, with angular speeds from `slowest` to `fastest`, rad/s.
inline Rule turns_per_minute(double slowest, double fastest) {
  return from_to("a speed in turns per minute", slowest / turn_per_minute, fastest / turn_per_minute);
}

/// A density of balls, walls or slurry, kg/m^3; osmium has 22590. The least refuses densities in g/cm^3.
inline Rule density() {
  return from_to("a density in kg/m^3", 100, 23000);
}

/// Young's modulus, Pa; diamond has 1.2e12, soft rubber 1e6. The least refuses moduli in GPa and MPa.
inline Rule youngs_modulus() {
  return from_to("a modulus in Pa", 1e5, 2e12);
}

/// A friction coefficient; rubber on dry concrete has up to 4.
inline Rule friction_coefficient(const std::string& what) {
  return zero_up_to(what, 10);
}

}  // namespace millfoam::meshing
