// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/time_step.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <ostream>
#include <sstream>

#include "dem_driver/contact.hpp"

namespace millfoam::dem_driver {

namespace {

struct NamedPair {
  std::string name;
  ContactPair pair;
  double smaller_diameter = 0;
  double restitution = 0;
};

std::string millimetres(double length) {
  std::ostringstream text;
  text << length * 1e3 << " mm";
  return text.str();
}

std::vector<NamedPair> all_pairs(const meshing::Mill& mill) {
  const Elastic ball{mill.dem.youngs_modulus, mill.ball.poisson_ratio};
  const Elastic wall{mill.dem.youngs_modulus, mill.wall.poisson_ratio};
  std::vector<NamedPair> pairs;
  for (const auto& first : mill.charge.classes) {
    for (const auto& second : mill.charge.classes) {
      if (second.diameter < first.diameter) continue;
      pairs.push_back({millimetres(first.diameter) + " on " + millimetres(second.diameter),
                       ball_on_ball(first.diameter, second.diameter, mill.ball.density, ball), first.diameter,
                       mill.ball_ball.restitution});
    }
    pairs.push_back({millimetres(first.diameter) + " on the wall",
                     ball_on_wall(first.diameter, mill.ball.density, ball, wall), first.diameter,
                     mill.ball_wall.restitution});
  }
  return pairs;
}

double smallest_diameter(const meshing::Mill& mill) {
  if (mill.charge.classes.empty())
    throw std::runtime_error("the charge has no size class: no time-step to choose");
  return std::min_element(mill.charge.classes.begin(), mill.charge.classes.end(),
                          [](const auto& a, const auto& b) { return a.diameter < b.diameter; })
      ->diameter;
}

TimeStepLimit contact_limit(const std::vector<NamedPair>& pairs, double speed) {
  const auto shortest = std::min_element(pairs.begin(), pairs.end(), [speed](const auto& a, const auto& b) {
    return hertz_contact_time(a.pair, speed) < hertz_contact_time(b.pair, speed);
  });
  std::ostringstream reason;
  reason << "1/" << steps_per_contact << " of the shortest Hertz contact, " << shortest->name;
  return {reason.str(), hertz_contact_time(shortest->pair, speed) / steps_per_contact};
}

ExpectedOverlap worst_overlap(const std::vector<NamedPair>& pairs, double speed) {
  ExpectedOverlap worst;
  for (const auto& named : pairs) {
    const double ratio = largest_overlap(named.pair, speed, named.restitution) / named.smaller_diameter;
    if (ratio > worst.ratio) worst = {named.name, ratio};
  }
  return worst;
}

}  // namespace

double expected_impact_speed(const meshing::Mill& mill) {
  return std::sqrt(2 * meshing::gravity * mill.geometry.diameter) +
         std::abs(mill.angular_velocity) * mill.geometry.radius();
}

TimeStep choose_time_step(const meshing::Mill& mill) {
  const double diameter = smallest_diameter(mill);
  const auto pairs = all_pairs(mill);
  TimeStep step;
  step.impact_speed = expected_impact_speed(mill);

  const Elastic ball{mill.dem.youngs_modulus, mill.ball.poisson_ratio};
  std::ostringstream fraction;
  fraction << mill.dem.rayleigh_fraction << " of the Rayleigh time of " << millimetres(diameter);
  step.limits.push_back(
      {fraction.str(), mill.dem.rayleigh_fraction * rayleigh_time(diameter / 2, mill.ball.density, ball)});
  step.limits.push_back(contact_limit(pairs, step.impact_speed));
  std::ostringstream crossing;
  crossing << "1/" << steps_per_allowed_overlap << " of the allowed overlap at the impact speed";
  step.limits.push_back(
      {crossing.str(), allowed_overlap_ratio * diameter / steps_per_allowed_overlap / step.impact_speed});
  step.overlap = worst_overlap(pairs, step.impact_speed);

  double longest = std::numeric_limits<double>::infinity();
  for (const auto& limit : step.limits) longest = std::min(longest, limit.value);
  if (!(longest > 0) || !std::isfinite(mill.dem.record_interval / longest))
    throw std::runtime_error(
        "no time-step follows from dem.youngs_modulus, dem.rayleigh_fraction and the smallest ball");
  // The slack keeps an interval that is a whole number of longest steps from being cut once more by
  // round-off.
  step.steps_per_record =
      std::max(1L, std::lround(std::ceil(mill.dem.record_interval / longest * (1 - 1e-12))));
  step.value = mill.dem.record_interval / static_cast<double>(step.steps_per_record);
  return step;
}

void print_time_step(std::ostream& out, const TimeStep& step) {
  const auto smallest = std::min_element(step.limits.begin(), step.limits.end(),
                                         [](const auto& a, const auto& b) { return a.value < b.value; });
  out << "time-step limits (hardest impact expected: " << std::setprecision(3) << step.impact_speed
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
        << " % that softened balls are good for; raise dem.youngs_modulus\n";
}

}  // namespace millfoam::dem_driver
