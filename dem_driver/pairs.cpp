// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/pairs.hpp"

#include <algorithm>
#include <iterator>
#include <sstream>

#include "dem_driver/mill_key.hpp"
#include "meshing/files/text_numbers.hpp"

namespace millfoam::dem_driver {

std::string millimetres(double length) {
  std::ostringstream text;
  text << length * 1e3 << " mm";
  return text.str();
}

std::vector<meshing::SizeClass> simulated_classes(const meshing::Mill& mill) {
  std::vector<meshing::SizeClass> classes;
  std::copy_if(mill.charge.classes.begin(), mill.charge.classes.end(), std::back_inserter(classes),
               [&](const auto& size) { return size.diameter >= mill.charge.fines_below; });
  if (classes.empty())
    throw KeyError("charge.fines_below", shown(mill.charge.fines_below),
                   "a diameter in m not above the largest ball's: no size class is left to simulate");
  return classes;
}

double smallest_simulated(const meshing::Mill& mill) {
  const auto classes = simulated_classes(mill);
  return std::min_element(classes.begin(), classes.end(),
                          [](const auto& a, const auto& b) { return a.diameter < b.diameter; })
      ->diameter;
}

std::vector<NamedPair> all_pairs(const meshing::Mill& mill, const Stiffness& stiffness) {
  const auto ball = [&](double diameter) {
    return Elastic{stiffness.of_ball(diameter), mill.ball.poisson_ratio};
  };
  const Elastic wall{stiffness.modulus, mill.wall.poisson_ratio};
  const auto classes = simulated_classes(mill);
  std::vector<NamedPair> pairs;
  for (const auto& [first, mass] : classes) {
    for (const auto& [second, other_mass] : classes) {
      if (second < first) continue;
      pairs.push_back({millimetres(first) + " on " + millimetres(second),
                       ball_on_ball(first, second, mill.ball.density, ball(first), ball(second)), first,
                       mill.ball_ball.restitution});
    }
    pairs.push_back({millimetres(first) + " on the wall",
                     ball_on_wall(first, mill.ball.density, ball(first), wall), first,
                     mill.ball_wall.restitution});
  }
  return pairs;
}

}  // namespace millfoam::dem_driver
