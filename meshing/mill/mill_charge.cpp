// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/mill/mill_charge.hpp"

#include <algorithm>
#include <cmath>

#include "meshing/files/text_numbers.hpp"
#include "meshing/mill/mill_shape.hpp"
#include "meshing/mill/rules.hpp"
#include "meshing/surface/pi.hpp"

namespace millfoam::meshing {
namespace {

/// What a whole number can hold with all its digits in a double.
constexpr double most_counted = 9e15;

/// Solidity of the closest random packing of equal balls.
constexpr double closest_packing = 0.64;

/// The balls must move freely between the lifters' tops and, in a periodic slice, must not meet their own
/// images.
Rule ball_diameter(const Geometry& geometry) {
  const double room = geometry.radius() - geometry.lifters.height;
  const bool slice_is_short = geometry.length < room;
  return positive_below("a ball's diameter", std::min(room, geometry.length), " m",
                        slice_is_short ? "the mill's length" : "the radius inside the lifters");
}

std::vector<Section> list_classes(const Section& in) {
  return in.list("classes", {"diameter", "mass"});
}

/// `share` of the mass lies in the mill.
Rule class_mass(const Geometry& geometry, double density, double share) {
  return positive_up_to("a mass in kg (of the mill full of the balls' material at most)",
                        density * analytic_volume(geometry) / share);
}

std::vector<SizeClass> read_classes(const Section& in, const Geometry& geometry, double density) {
  for (const char* other : {"fill", "diameter"}) {
    if (in.has(other)) in.refuse(other, "either classes, or fill and diameter");
  }
  const double share =
      geometry.length / in.number("reference_length",
                                  positive_up_to("the length in m that the masses fill,", longest),
                                  geometry.length);
  std::vector<SizeClass> classes;
  for (const Section& item : list_classes(in)) {
    classes.push_back({item.number("diameter", ball_diameter(geometry)),
                       item.number("mass", class_mass(geometry, density, share)) * share});
  }
  return classes;
}

/// Mass in kg of balls that fill the requested share of the mill in bulk.
double read_fill_mass(const Section& in, const Geometry& geometry, double density, double packing) {
  if (in.has("reference_length")) in.refuse("reference_length", "this key with classes only, not with fill");
  const double fill =
      in.number("fill", positive_below("a share of the mill's volume (or the key classes)", 1, "", "1"));
  return fill * packing * density * analytic_volume(geometry);
}

/// Makes the masses of the file's classes fill the share that --set gives, with their sizes and their shares.
void fill_with_classes(Section& in, const Geometry& geometry, double density, double packing) {
  in.displace("fill", {"reference_length"});
  const double wanted = read_fill_mass(in, geometry, density, packing);
  in.drop("fill");
  double mass = 0;
  for (const SizeClass& size : read_classes(in, geometry, density)) mass += size.mass;
  for (Section& item : list_classes(in))
    item.put("mass", item.number("mass", class_mass(geometry, density, 1)) * wanted / mass);
}

/// What --set gives takes the place of the file's other way to say how much charge there is.
void choose_charge(Section& in, const Geometry& geometry, double density, double packing) {
  in.displace("classes", {"fill", "diameter"});
  if (in.is_set("fill") && in.has("classes") && !in.is_set("classes") && !in.has("diameter"))
    fill_with_classes(in, geometry, density, packing);
  else
    in.displace("fill", {"classes", "reference_length"});
}

}  // namespace

Charge read_charge(Section in, const Geometry& geometry, double density) {
  Charge charge;
  charge.packing = in.number("packing",
                             {"the solidity of a resting charge, above 0 and up to 0.74",
                              [](double v) { return v > 0 && v <= 0.74; }},
                             charge.packing);
  choose_charge(in, geometry, density, charge.packing);
  if (in.has("classes"))
    charge.classes = read_classes(in, geometry, density);
  else
    charge.classes = {{in.number("diameter", ball_diameter(geometry)),
                       read_fill_mass(in, geometry, density, charge.packing)}};
  double volume = 0;
  double largest = 0;
  for (const SizeClass& size : charge.classes) {
    volume += size.mass / density;
    largest = std::max(largest, size.diameter);
  }
  if (volume > closest_packing * analytic_volume(geometry)) {
    in.refuse(in.has("classes") ? "classes" : "fill",
              "balls that fit: theirs is " + shown(volume) + " m^3, the closest packing in this mill " +
                  shown(closest_packing * analytic_volume(geometry)) + " m^3");
  }
  charge.fines_below =
      in.number("fines_below",
                {"a diameter in m of 0 or more and up to the largest ball's, " + shown(largest) + " m",
                 [=](double v) { return v >= 0 && v <= largest; }},
                0);
  const double room = geometry.radius() - geometry.lifters.height;
  charge.start_radius =
      in.number("start_radius",
                {"a length above the largest ball's radius, " + shown(largest / 2) +
                     " m, and not above the radius inside the lifters, " + shown(room) + " m",
                 [=](double v) { return v > largest / 2 && v <= room; }},
                room - largest / 2);
  const bool plain = geometry.ends == Ends::plain;
  charge.start_length = in.number(
      "start_length",
      {plain ? "a length above the largest ball's diameter, " + shown(largest) +
                   " m, and not above the mill's, " + shown(geometry.length) + " m"
             : length_of_mill().expected,
       [=](double v) { return plain ? v > largest && v <= geometry.length : length_of_mill().holds(v); }},
      0.98 * geometry.length);
  return charge;
}

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
  const double solidity = mill.charge.packing;
  const double bulk = solidity * analytic_volume(mill.geometry);
  numbers.load = numbers.volume / bulk;
  numbers.load_asked = asked / mill.ball.density / bulk;
  numbers.pore_volume = numbers.volume * (1 - solidity) / solidity;
  return numbers;
}

}  // namespace millfoam::meshing
