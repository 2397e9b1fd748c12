// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/time_step.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <ostream>
#include <sstream>

#include "dem_driver/contact.hpp"
#include "dem_driver/pairs.hpp"
#include "meshing/files/text_numbers.hpp"
#include "meshing/mill/mill_error.hpp"

namespace millfoam::dem_driver {

namespace {

constexpr double most_steps_per_record = 1e15;  // which a long holds, for the hardest balls too

TimeStepLimit rayleigh_limit(const meshing::Mill& mill, const Stiffness& stiffness) {
  double shortest = std::numeric_limits<double>::infinity();
  std::string ball;
  for (const auto& size : simulated_classes(mill)) {
    const Elastic elastic{stiffness.of_ball(size.diameter), mill.ball.poisson_ratio};
    const double time = rayleigh_time(least_radius(size), mill.ball.density, elastic);
    if (time < shortest) {
      shortest = time;
      ball = in_words(size);
    }
  }
  std::ostringstream reason;
  reason << mill.dem.rayleigh_fraction << " of the Rayleigh time of " << ball;
  return {"rayleigh", reason.str(), mill.dem.rayleigh_fraction * shortest};
}

TimeStepLimit contact_limit(const std::vector<NamedPair>& pairs, double speed) {
  const auto shortest = std::min_element(pairs.begin(), pairs.end(), [speed](const auto& a, const auto& b) {
    return hertz_contact_time(a.blunt, speed) < hertz_contact_time(b.blunt, speed);
  });
  std::ostringstream reason;
  reason << "1/" << steps_per_contact << " of the shortest Hertz contact, " << shortest->name;
  return {"contact", reason.str(), hertz_contact_time(shortest->blunt, speed) / steps_per_contact};
}

}  // namespace

TimeStep choose_time_step(const meshing::Mill& mill) {
  TimeStep step;
  step.impact_speed = expected_impact_speed(mill);
  step.stiffness = choose_stiffness(mill);
  step.overlap = expected_overlap(mill, step.stiffness);

  step.limits.push_back(rayleigh_limit(mill, step.stiffness));
  step.limits.push_back(contact_limit(all_pairs(mill, step.stiffness), step.impact_speed));
  std::ostringstream crossing;
  crossing << "1/" << steps_per_allowed_overlap << " of the allowed overlap at the impact speed";
  step.limits.push_back(
      {"overlap", crossing.str(),
       allowed_overlap_ratio * smallest_simulated(mill) / steps_per_allowed_overlap / step.impact_speed});

  double longest = std::numeric_limits<double>::infinity();
  for (const auto& limit : step.limits) longest = std::min(longest, limit.value);
  if (!(longest > 0) || !(mill.dem.record_interval / longest < most_steps_per_record))
    throw meshing::KeyError(
        "dem.rayleigh_fraction", shown(mill.dem.rayleigh_fraction),
        "a fraction from which, with the balls' modulus and the smallest ball, a time-step follows");
  // The slack keeps an interval that is a whole number of longest steps from being cut once more by
  // round-off.
  step.steps_per_record =
      std::max(1L, std::lround(std::ceil(mill.dem.record_interval / longest * (1 - 1e-12))));
  step.value = mill.dem.record_interval / static_cast<double>(step.steps_per_record);
  return step;
}

std::vector<Softness> softness_table(const meshing::Mill& mill) {
  const double chosen = choose_time_step(mill).value;
  std::vector<double> moduli{smallest_modulus, 1e7, 3e7, 1e8, 1e9, 1e10};
  while (moduli.size() > 1 && moduli.back() >= mill.ball.youngs_modulus) moduli.pop_back();
  if (mill.ball.youngs_modulus > moduli.back()) moduli.push_back(mill.ball.youngs_modulus);
  std::vector<Softness> table;
  for (const double modulus : moduli) {
    meshing::Mill other = mill;
    other.dem.youngs_modulus = modulus;
    other.dem.largest_overlap = 0;
    other.dem.soften_below = 0;
    const TimeStep step = choose_time_step(other);
    table.push_back({modulus, step.overlap.ratio, step.value, chosen / step.value});
  }
  return table;
}

void print_advice(std::ostream& out, const meshing::Mill& mill) {
  out << "softness: modulus Pa   largest overlap %   time-step us   cost\n";
  for (const Softness& row : softness_table(mill))
    out << std::setprecision(3) << std::setw(21) << row.modulus << std::setw(20) << 100 * row.overlap
        << std::setw(15) << 1e6 * row.time_step << std::setw(7) << row.cost << '\n';
}

void print_time_step(std::ostream& out, const TimeStep& step, const meshing::Mill& mill) {
  const auto smallest = std::min_element(step.limits.begin(), step.limits.end(),
                                         [](const auto& a, const auto& b) { return a.value < b.value; });
  out << "softened modulus of balls and walls: " << std::setprecision(4) << step.stiffness.modulus << " Pa";
  if (step.stiffness.soften_below > 0)
    out << ", balls below " << millimetres(step.stiffness.soften_below) << " softer by (d/"
        << millimetres(step.stiffness.soften_below) << ")^2.5";
  out << "\ntime-step limits (hardest impact expected: " << std::setprecision(3) << step.impact_speed
      << " m/s)\n";
  for (const auto& limit : step.limits)
    out << "  " << std::left << std::setw(64) << limit.reason << std::right << std::setw(10)
        << std::setprecision(4) << limit.value * 1e6 << " us" << (&limit == &*smallest ? "  <- smallest" : "")
        << '\n';
  out << "  " << std::left << std::setw(64)
      << "chosen: " + std::to_string(step.steps_per_record) + " steps per record" << std::right
      << std::setw(10) << step.value * 1e6 << " us\n"
      << "largest overlap expected: " << std::setprecision(3) << 100 * step.overlap.ratio
      << " % of the diameter (" << step.overlap.pair << ")\n";
  if (step.overlap.ratio > allowed_overlap_ratio)
    out << "WARNING: more than the " << 100 * allowed_overlap_ratio
        << " % up to which softened balls are accurate; raise dem.youngs_modulus\n";
  // Round-off of the modulus' power
  if (mill.dem.largest_overlap > 0 && step.overlap.ratio > mill.dem.largest_overlap * (1 + 1e-6))
    out << "WARNING: dem.largest_overlap, " << 100 * mill.dem.largest_overlap
        << " %, is not kept: the balls have their real modulus and are not stiffer\n";
  if (step.stiffness.modulus > mill.ball.youngs_modulus)
    out << "WARNING: dem.youngs_modulus is above the balls' real modulus, " << mill.ball.youngs_modulus
        << " Pa\n";
}

}  // namespace millfoam::dem_driver
