// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/pairs.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <sstream>

#include "meshing/files/text_numbers.hpp"
#include "meshing/mill/mill_error.hpp"

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
    throw meshing::KeyError(
        "charge.fines_below", shown(mill.charge.fines_below),
        "a diameter in m not above the largest ball's: no size class is left to simulate");
  return classes;
}

double smallest_simulated(const meshing::Mill& mill) {
  const auto classes = simulated_classes(mill);
  return std::min_element(classes.begin(), classes.end(),
                          [](const auto& a, const auto& b) { return a.diameter < b.diameter; })
      ->diameter;
}

double least_radius(const meshing::SizeClass& size) {
  return size.shape ? meshing::least_radius_of_curvature(*size.shape) : size.diameter / 2;
}

std::string in_words(const meshing::SizeClass& size) {
  if (!size.shape) return millimetres(size.diameter);
  std::ostringstream text;
  text << millimetres(size.diameter) << " of blockiness " << size.shape->blockiness;
  return text.str();
}

std::vector<NamedPair> all_pairs(const meshing::Mill& mill, const Stiffness& stiffness) {
  const auto ball = [&](const meshing::SizeClass& size) {
    return Elastic{stiffness.of_ball(size.diameter), mill.ball.poisson_ratio};
  };
  const Elastic wall{stiffness.modulus, mill.wall.poisson_ratio};
  const auto classes = simulated_classes(mill);
  std::vector<double> radii;
  radii.reserve(classes.size());
  for (const auto& size : classes) radii.push_back(least_radius(size));
  std::vector<NamedPair> pairs;
  const auto add = [&](NamedPair named, bool shapes, double radius) {
    named.blunt = named.pair;
    if (shapes) {
      named.blunt.radius *= mill.dem.curvature_limit;
      named.pair.radius = radius;
    }
    pairs.push_back(named);
  };
  for (std::size_t i = 0; i < classes.size(); ++i) {
    const auto& first = classes[i];
    for (std::size_t k = 0; k < classes.size(); ++k) {
      const auto& second = classes[k];
      if (second.diameter < first.diameter) continue;
      add({in_words(first) + " on " + in_words(second),
           ball_on_ball(first.diameter, second.diameter, mill.ball.density, ball(first), ball(second)),
           {},
           first.diameter,
           mill.ball_ball.restitution},
          first.shape || second.shape, radii[i] * radii[k] / (radii[i] + radii[k]));
    }
    add({in_words(first) + " on the wall",
         ball_on_wall(first.diameter, mill.ball.density, ball(first), wall),
         {},
         first.diameter,
         mill.ball_wall.restitution},
        first.shape.has_value(), radii[i]);
  }
  return pairs;
}

}  // namespace millfoam::dem_driver
