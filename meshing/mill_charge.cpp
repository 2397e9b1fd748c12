// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/mill_charge.hpp"

#include <algorithm>
#include <cmath>

#include "meshing/mill_shape.hpp"
#include "meshing/pi.hpp"

namespace millfoam::meshing {
namespace {

/// What a whole number can hold with all its digits in a double.
constexpr double most_counted = 9e15;

}  // namespace

double ball_mass(const Mill& mill, double diameter) {
  return mill.ball.density * pi / 6 * std::pow(diameter, 3);
}

ChargeNumbers count_charge(const Mill& mill) {
  ChargeNumbers numbers;
  double mass_over_diameter = 0;
  double asked = 0;
  for (const SizeClass& size : mill.charge.classes) {
    const double one = ball_mass(mill, size.diameter);
    const long count = std::lround(std::min(size.mass / one, most_counted));
    const BallCount ball{size.diameter, size.mass, static_cast<double>(count) * one, count,
                         size.diameter >= mill.charge.fines_below};
    numbers.classes.push_back(ball);
    asked += size.mass;
    if (!ball.simulated) {
      numbers.fines_mass += size.mass;
      continue;
    }
    numbers.balls += count;
    numbers.mass += ball.mass;
    mass_over_diameter += ball.mass / ball.diameter;
    numbers.largest_diameter = std::max(numbers.largest_diameter, ball.diameter);
    if (numbers.smallest_diameter == 0) numbers.smallest_diameter = ball.diameter;
    numbers.smallest_diameter = std::min(numbers.smallest_diameter, ball.diameter);
  }
  // A charge that rounds to no ball at all, which the dry run refuses, is as large as its largest class
  numbers.sauter_diameter =
      mass_over_diameter > 0 ? numbers.mass / mass_over_diameter : numbers.largest_diameter;
  numbers.volume = numbers.mass / mill.ball.density;
  const double bulk = resting_solidity * analytic_volume(mill.geometry);
  numbers.load = numbers.volume / bulk;
  numbers.load_asked = asked / mill.ball.density / bulk;
  numbers.pore_volume = numbers.volume * (1 - resting_solidity) / resting_solidity;
  return numbers;
}

}  // namespace millfoam::meshing
