// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "dem_driver/stiffness.hpp"
#include "meshing/mill/mill.hpp"

namespace millfoam::dem_driver {

/// One upper bound of the time-step and why it is there.
struct TimeStepLimit {
  std::string name;    ///< rayleigh, contact or overlap
  std::string reason;  ///< in words, with the balls that set it
  double value = 0;    ///< s
};

/// The chosen time-step with its reasons.
struct TimeStep {
  double value = 0;                   ///< s; a record interval is exactly `steps_per_record` of them
  long steps_per_record = 0;          ///< time-steps between two dumps, at least 1
  double impact_speed = 0;            ///< m/s, the hardest impact expected in this mill
  std::vector<TimeStepLimit> limits;  ///< all bounds; value <= the smallest
  Stiffness stiffness;                ///< that the limits belong to
  ExpectedOverlap overlap;            ///< worst pair at `impact_speed`
};

/// Fewest time-steps in the duration of a Hertz contact.
inline constexpr double steps_per_contact = 10;
/// Fewest time-steps in which a ball crosses the allowed overlap (`allowed_overlap_ratio` of the smallest
/// diameter).
inline constexpr double steps_per_allowed_overlap = 6;
/// Overlap, relative to the diameter, up to which softened balls are accepted (Brosh, Kalman & Levy).
inline constexpr double allowed_overlap_ratio = 0.15;

/// Chooses the stiffness (choose_stiffness) and the time-step: the smallest of a fraction
/// (`dem.rayleigh_fraction`) of the shortest Rayleigh time of all balls, of superquadrics that of a sphere of
/// their least radius of curvature, a tenth of the shortest Hertz
/// contact, and the time in which the hardest impact crosses a sixth of the allowed overlap; then shortened
/// so that `dem.record_interval` is a whole number of steps. Throws meshing::KeyError for a mill without
/// balls or with values that give no finite step.
TimeStep choose_time_step(const meshing::Mill& mill);

/// What softer and harder balls would mean for a mill.
struct Softness {
  double modulus = 0;    ///< Pa
  double overlap = 0;    ///< largest expected, over the smaller diameter
  double time_step = 0;  ///< s
  double cost = 0;       ///< steps, over those of the modulus chosen
};

/// One row for each of six moduli between the softest that LIGGGHTS accepts and the real one, ascending;
/// moduli above the real one are left out. Throws as choose_time_step does.
std::vector<Softness> softness_table(const meshing::Mill& mill);

/// Prints that table.
void print_advice(std::ostream& out, const meshing::Mill& mill);

/// Prints the moduli, the limits, the choice and the expected overlap as a small table; warns where the
/// overlap is too large, or larger than asked for, and of balls stiffer than the real ones.
void print_time_step(std::ostream& out, const TimeStep& step, const meshing::Mill& mill);

}  // namespace millfoam::dem_driver
