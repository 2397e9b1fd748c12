// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/mill/mill_charge.hpp"

#include <algorithm>
#include <cmath>

#include "meshing/files/text_numbers.hpp"
#include "meshing/mill/mill_ball_shape.hpp"
#include "meshing/mill/mill_error.hpp"
#include "meshing/mill/mill_shape.hpp"
#include "meshing/mill/rules.hpp"
#include "meshing/mill/stirred_geometry.hpp"
#include "meshing/surface/pi.hpp"

namespace millfoam::meshing {
namespace {

/// What a whole number can hold with all its digits in a double.
constexpr double most_counted = 9e15;

/// Share of the space up to a level that balls take where a stirred mill does not say it.
constexpr double usual_share = 0.5;
/// Distance of the space in which a stirred mill's balls are released from its walls, in diameters.
constexpr double start_gap = 0.1;

/// Solidity of the closest random packing of equal balls.
constexpr double closest_packing = 0.64;

/// A stirred mill's balls must not be clamped between the impeller and the shell, or the base, unless the
/// charge's `larger_than_gap` is true. They are released between shaft and shell.
Room room_in_stirred(const Section& charge, const Geometry& geometry) {
  const Impeller& impeller = *geometry.impeller;
  const double room = (geometry.radius() - impeller.shaft_diameter / 2) / (1 + 2 * start_gap);
  if (charge.boolean("larger_than_gap", false))
    return {room, "the room between the shaft and the shell", " m"};
  const char* unless = " m (or charge.larger_than_gap: true)";
  const double aside = impeller_gap(geometry);
  if (impeller.shaft_end < aside)
    return {impeller.shaft_end, "the gap between the impeller and the base", unless};
  return {std::min(aside, room), "the gap between the impeller and the shell", unless};
}

/// The balls must move freely between the lifters' tops and, in a periodic mill, must not touch the same ball
/// on both sides.
Room room_of_ball(const Section& charge, const Geometry& geometry) {
  if (geometry.impeller) return room_in_stirred(charge, geometry);
  const double room = geometry.radius() - geometry.lifters.height;
  const double half = geometry.length / fewest_diameters_of_period;
  if (geometry.ends == Ends::periodic && half < room)
    return {half, "half of the periodic mill's length", " m", true};
  if (geometry.length < room) return {geometry.length, "the mill's length", " m"};
  return {room, "the radius inside the lifters", " m"};
}

Rule ball_diameter(const Section& charge, const Geometry& geometry) {
  const Room room = room_of_ball(charge, geometry);
  return {"a ball's diameter above 0 and " + room.words(), [=](double v) { return v > 0 && room.holds(v); }};
}

/// The shape of the balls of a class, or of a charge of one class.
std::optional<Superquadric> read_shape(const Section& in, const Section& charge, const Geometry& geometry,
                                       double diameter) {
  return read_ball_shape(in, diameter, room_of_ball(charge, geometry));
}

std::vector<Section> list_classes(const Section& in) {
  return in.list("classes", {"diameter", "mass", "number", "shape"});
}

/// `share` of the mass lies in the mill.
Rule class_mass(const Geometry& geometry, double density, double share) {
  return positive_up_to("a mass in kg (of the mill full of the balls' material at most)",
                        density * analytic_volume(geometry) / share);
}

double sphere_mass(double density, double diameter) {
  return density * pi / 6 * std::pow(diameter, 3);
}

/// Mass of a class, by its mass or by its number of balls, kg.
double read_mass(const Section& item, const Geometry& geometry, double density, double share,
                 double diameter) {
  const Rule mass = class_mass(geometry, density, share);
  if (!item.has("number")) return item.number("mass", mass);
  if (item.has("mass")) item.refuse("number", "either the mass or the number of the balls");
  const double one = sphere_mass(density, diameter);
  return one * item.number("number",
                           {"a whole number of balls from 1 on, of which the mill has room",
                            [&](double v) { return v >= 1 && v == std::floor(v) && mass.holds(v * one); }});
}

/// Classes of which `share` of the mass lies in the mill.
std::vector<SizeClass> read_sizes(const Section& in, const Geometry& geometry, double density, double share) {
  std::vector<SizeClass> classes;
  for (const Section& item : list_classes(in)) {
    const double diameter = item.number("diameter", ball_diameter(in, geometry));
    classes.push_back({diameter, read_mass(item, geometry, density, share, diameter) * share,
                       read_shape(item, in, geometry, diameter)});
  }
  return classes;
}

/// Share of the classes' masses that lies in the mill.
double share_in_mill(const Section& in, const Geometry& geometry) {
  return geometry.length / in.number("reference_length",
                                     positive_up_to("the length in m that the masses fill,", longest),
                                     geometry.length);
}

std::vector<SizeClass> read_classes(const Section& in, const Geometry& geometry, double density) {
  for (const char* other : {"fill", "diameter", "shape"}) {
    if (in.has(other)) in.refuse(other, "either classes, or fill, diameter and shape");
  }
  return read_sizes(in, geometry, density, share_in_mill(in, geometry));
}

/// Mass in kg of balls that fill the requested share of the mill in bulk.
double read_fill_mass(const Section& in, const Geometry& geometry, double density, double packing) {
  if (in.has("reference_length")) in.refuse("reference_length", "this key with classes only, not with fill");
  const double fill = in.number(
      "fill", {"a share of the mill's volume above 0 and below 1, 0.3 for 30 % (or the key classes)",
               [](double v) { return v > 0 && v < 1; }});
  return fill * packing * density * analytic_volume(geometry);
}

/// Makes the masses of the file's classes fill the share that --set gives, with their sizes and their shares.
void fill_with_classes(Section& in, const Geometry& geometry, double density, double packing) {
  const double share = in.has("reference_length") ? share_in_mill(in, geometry) : 1;
  in.displace("fill", {"reference_length"});
  const double wanted = read_fill_mass(in, geometry, density, packing);
  in.drop("fill");
  // The masses that follow are those in this mill: the key takes its default
  in.number("reference_length", positive_up_to("a length in m", longest), geometry.length);
  double mass = 0;
  for (const SizeClass& size : read_sizes(in, geometry, density, share)) mass += size.mass;
  for (Section& item : list_classes(in)) {
    const double diameter = item.number("diameter", ball_diameter(in, geometry));
    const double own = share * read_mass(item, geometry, density, share, diameter);
    // mill.json is read in this order again
    if (item.has("number"))
      item.replace("number", "mass", own * wanted / mass);
    else
      item.put("mass", own * wanted / mass);
  }
}

/// What --set gives takes the place of the file's other way to say how much charge there is.
void choose_charge(Section& in, const Geometry& geometry, double density, double packing) {
  in.displace("classes", {"fill", "diameter", "shape"});
  if (in.is_set("fill") && in.has("classes") && !in.is_set("classes") && !in.has("diameter"))
    fill_with_classes(in, geometry, density, packing);
  else
    in.displace("fill", {"classes", "reference_length"});
}

double read_packing(const Section& in, double usual) {
  return in.number("packing",
                   {"the solidity of a resting charge, above 0 and up to 0.74",
                    [](double v) { return v > 0 && v <= 0.74; }},
                   usual);
}

/// Refuses balls that do not fit, by the key that gives them; returns the longest way through a ball, m.
double require_room(const Section& in, const char* key, const std::vector<SizeClass>& classes,
                    const Geometry& geometry, double density) {
  double volume = 0;
  double largest = 0;
  for (const SizeClass& size : classes) {
    volume += size.mass / density;
    largest = std::max(largest, longest_way(size));
  }
  if (volume > closest_packing * analytic_volume(geometry)) {
    in.refuse(key, "balls that fit: theirs is " + shown(volume) + " m^3, the closest packing in this mill " +
                       shown(closest_packing * analytic_volume(geometry)) + " m^3");
  }
  return largest;
}

/// A charge of balls of one size and shape. The diameter is read before the mass: the order of the keys is
/// part of the fingerprint.
/// @param read_mass  reads it, kg
template <typename ReadMass>
SizeClass read_single_class(const Section& in, const Geometry& geometry, const ReadMass& read_mass) {
  const double diameter = in.number("diameter", ball_diameter(in, geometry));
  const double mass = read_mass();
  return {diameter, mass, read_shape(in, in, geometry, diameter)};
}

double read_fines(const Section& in, const std::vector<SizeClass>& classes) {
  double largest = 0;
  for (const SizeClass& size : classes) largest = std::max(largest, size.diameter);
  return in.number("fines_below",
                   {"a diameter in m of 0 or more and up to the largest ball's, " + shown(largest) + " m",
                    [=](double v) { return v >= 0 && v <= largest; }},
                   0);
}

/// Mass of balls that take a share of the space up to a level, outside of the impeller.
double read_level_mass(const Section& in, const Geometry& geometry, double density) {
  const double level = in.number(
      "level", positive_up_to("a height in m, up to the mill's, of the space of which the balls take a share "
                              "(or the key classes),",
                              geometry.length));
  const double share =
      in.number("share",
                {"a share of the space up to that level above 0 and up to " + shown(closest_packing),
                 [](double v) { return v > 0 && v <= closest_packing; }},
                usual_share);
  const double section = pi * geometry.radius() * geometry.radius();
  return share * density * (section * level - impeller_volume(geometry, level));
}

}  // namespace

Charge read_charge(Section in, const Geometry& geometry, double density) {
  Charge charge;
  charge.packing = read_packing(in, charge.packing);
  choose_charge(in, geometry, density, charge.packing);
  if (in.has("classes"))
    charge.classes = read_classes(in, geometry, density);
  else
    charge.classes = {read_single_class(
        in, geometry, [&] { return read_fill_mass(in, geometry, density, charge.packing); })};
  const double largest =
      require_room(in, in.has("classes") ? "classes" : "fill", charge.classes, geometry, density);
  charge.fines_below = read_fines(in, charge.classes);
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
  charge.start_bottom = (geometry.length - charge.start_length) / 2;
  return charge;
}

Charge read_stirred_charge(Section in, const Geometry& geometry, double density) {
  Charge charge;
  charge.packing = read_packing(in, charge.packing);
  in.displace("classes", {"level", "share", "diameter", "shape"});
  in.displace("level", {"classes"});
  const bool by_classes = in.has("classes");
  if (by_classes) {
    for (const char* other : {"level", "share", "diameter", "shape"})
      if (in.has(other)) in.refuse(other, "either classes, or level, share, diameter and shape");
    charge.classes = read_sizes(in, geometry, density, 1);
  } else {
    charge.classes = {
        read_single_class(in, geometry, [&] { return read_level_mass(in, geometry, density); })};
  }
  const double largest =
      require_room(in, by_classes ? "classes" : "level", charge.classes, geometry, density);
  charge.fines_below = read_fines(in, charge.classes);
  const Impeller& impeller = *geometry.impeller;
  // Above pins and discs, around the shaft; a tenth of a ball more, so that none touches a wall
  charge.start_radius = geometry.radius() - largest * start_gap;
  charge.start_core = impeller.shaft_diameter / 2 + largest * start_gap;
  charge.start_bottom = impeller_top(impeller) + largest * start_gap;
  charge.start_length = geometry.length - charge.start_bottom - largest * start_gap;
  if (charge.start_length < 2 * largest)
    in.refuse(by_classes ? "classes" : "diameter",
              "a mill with room above the impeller, where balls are released: a height of " +
                  shown(impeller_top(impeller) + 2.2 * largest) + " m or more, not " +
                  shown(geometry.length) + " m");
  return charge;
}

std::string key_of_class(const Mill& mill, std::size_t number) {
  return mill.charge.classes.size() == 1 ? "charge" : "charge.classes[" + std::to_string(number) + "]";
}

void require_balls(const Mill& mill) {
  const std::vector<BallCount> counted = count_charge(mill).classes;
  for (std::size_t i = 0; i < counted.size(); ++i) {
    const BallCount& size = counted[i];
    if (size.count > 0 || !size.simulated) continue;
    throw KeyError(
        key_of_class(mill, i),
        shown(size.mass_asked) + " kg of balls of " + shown(size.diameter) +
            " m in this mill, which rounds to 0 balls",
        "at least half of one ball's mass, " + shown(ball_mass(mill, size.diameter)) + " kg: raise the mass" +
            (counted.size() == 1 ? "" : ", or leave the class out (small ones by charge.fines_below)"));
  }
}

std::vector<ClassShape> class_shapes(const ChargeNumbers& charge) {
  std::vector<ClassShape> shares;
  for (const BallCount& ball : charge.classes)
    if (ball.simulated && ball.count > 0)
      shares.push_back({ball.mass / charge.mass, ball.shape ? sphericity(*ball.shape) : 1});
  return shares;
}

double ball_mass(const Mill& mill, double diameter) {
  return sphere_mass(mill.ball.density, diameter);
}

ChargeNumbers count_charge(const Mill& mill) {
  ChargeNumbers numbers;
  double mass_over_diameter = 0;
  double mass_times_sphericity = 0;
  double asked = 0;
  for (const SizeClass& size : mill.charge.classes) {
    const double one = ball_mass(mill, size.diameter);
    const long count = std::lround(std::min(size.mass / one, most_counted));
    const BallCount ball{size.diameter,
                         size.mass,
                         static_cast<double>(count) * one,
                         count,
                         size.diameter >= mill.charge.fines_below,
                         size.shape};
    numbers.classes.push_back(ball);
    asked += size.mass;
    if (!ball.simulated) {
      numbers.fines_mass += size.mass;
      continue;
    }
    numbers.balls += count;
    numbers.mass += ball.mass;
    mass_over_diameter += ball.mass / ball.diameter;
    mass_times_sphericity += ball.mass * (ball.shape ? sphericity(*ball.shape) : 1);
    numbers.largest_diameter = std::max(numbers.largest_diameter, ball.diameter);
    if (numbers.smallest_diameter == 0) numbers.smallest_diameter = ball.diameter;
    numbers.smallest_diameter = std::min(numbers.smallest_diameter, ball.diameter);
  }
  // A charge that rounds to no ball at all, which only a flow without balls may have, is as large as its
  // largest class
  numbers.sauter_diameter =
      mass_over_diameter > 0 ? numbers.mass / mass_over_diameter : numbers.largest_diameter;
  if (numbers.mass > 0) numbers.sphericity = mass_times_sphericity / numbers.mass;
  numbers.volume = numbers.mass / mill.ball.density;
  const double solidity = mill.charge.packing;
  const double bulk = solidity * analytic_volume(mill.geometry);
  numbers.load = numbers.volume / bulk;
  numbers.load_asked = asked / mill.ball.density / bulk;
  numbers.pore_volume = numbers.volume * (1 - solidity) / solidity;
  return numbers;
}

}  // namespace millfoam::meshing
