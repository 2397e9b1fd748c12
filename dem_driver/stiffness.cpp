// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/stiffness.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "dem_driver/pairs.hpp"
#include "meshing/files/text_numbers.hpp"
#include "meshing/mill/mill_error.hpp"
#include "meshing/mill/stirred_geometry.hpp"

namespace millfoam::dem_driver {

namespace {

/// Throws when the softest balls are too soft for LIGGGHTS.
void check_modulus(const meshing::Mill& mill, const Stiffness& stiffness) {
  const double smallest_diameter = smallest_simulated(mill);
  const double softest = std::min(stiffness.modulus, stiffness.of_ball(smallest_diameter));
  // The slack lets through a modulus that was raised to just this limit.
  if (softest >= smallest_modulus * (1 - 1e-12)) return;
  const std::string least = "at least " + shown(smallest_modulus) + " Pa, the softest that LIGGGHTS accepts";
  if (stiffness.modulus < smallest_modulus)
    throw meshing::KeyError(
        mill.dem.largest_overlap > 0 ? "materials.ball.youngs_modulus" : "dem.youngs_modulus",
        shown(stiffness.modulus), least);
  throw meshing::KeyError("dem.soften_below", shown(mill.dem.soften_below),
                          "a diameter in m with which the balls of " + shown(smallest_diameter) + " m have " +
                              least + ", not " + shown(softest) + " Pa");
}

/// All overlaps are proportional to modulus^-0.4, so one trial gives the modulus.
double modulus_for_overlap(const meshing::Mill& mill) {
  const Stiffness trial{mill.ball.youngs_modulus, mill.dem.soften_below};
  const double needed =
      trial.modulus * std::pow(expected_overlap(mill, trial).ratio / mill.dem.largest_overlap, 2.5);
  const double softening = trial.of_ball(smallest_simulated(mill)) / trial.modulus;
  return std::min(mill.ball.youngs_modulus, std::max(needed, smallest_modulus / softening));
}

}  // namespace

double expected_impact_speed(const meshing::Mill& mill) {
  if (mill.geometry.impeller) {
    const double tip = std::abs(mill.angular_velocity) * meshing::impeller_radius(*mill.geometry.impeller);
    return std::sqrt(2 * meshing::gravity * mill.geometry.length) + tip;
  }
  return std::sqrt(2 * meshing::gravity * mill.geometry.diameter) +
         std::abs(mill.angular_velocity) * mill.geometry.radius();
}

ExpectedOverlap expected_overlap(const meshing::Mill& mill, const Stiffness& stiffness) {
  const double speed = expected_impact_speed(mill);
  ExpectedOverlap worst;
  for (const auto& named : all_pairs(mill, stiffness)) {
    const double ratio = largest_overlap(named.pair, speed, named.restitution) / named.smaller_diameter;
    if (ratio > worst.ratio) worst = {named.name, ratio};
  }
  return worst;
}

Stiffness choose_stiffness(const meshing::Mill& mill) {
  const double modulus = mill.dem.largest_overlap > 0 ? modulus_for_overlap(mill) : mill.dem.youngs_modulus;
  const Stiffness stiffness{modulus, mill.dem.soften_below};
  check_modulus(mill, stiffness);
  return stiffness;
}

}  // namespace millfoam::dem_driver
