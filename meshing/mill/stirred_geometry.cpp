// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/mill/stirred_geometry.hpp"

#include <algorithm>
#include <cmath>

#include "meshing/files/text_numbers.hpp"
#include "meshing/mill/rules.hpp"
#include "meshing/mill/turning_speed.hpp"
#include "meshing/surface/pi.hpp"

namespace millfoam::meshing {
namespace {

/// Arms at one height: more leave no room for balls between them.
constexpr int most_arms = 24;
/// Pins above each other: more are a screw.
constexpr std::size_t most_levels = 100;
/// Discs above each other.
constexpr std::size_t most_discs = 100;
/// Smallest part of the shaft's diameter that is left between a disc and what is next to it.
constexpr double least_gap = 0.01;
/// Largest speed of the impeller's rim, m/s: grinding mills stay below 25.
constexpr double fastest_tip = 50;
constexpr double slowest_tip = 0.001;

/// Lowest and highest points of a level's pins.
std::pair<double, double> span_of(const PinLevel& level) {
  return {level.height - level.thickness / 2, level.height + level.thickness / 2};
}

/// Heights of a disc's lower and upper face.
std::pair<double, double> span_of(const Disc& disc) {
  return {disc.height - disc.thickness / 2, disc.height + disc.thickness / 2};
}

/// Neighbouring arms of one level must not meet outside of the shaft, where they would be cut.
bool arms_are_apart(const PinLevel& level, double shaft_radius) {
  if (level.arms < 2) return true;
  const double half = level.thickness / 2;
  // Two strips of this half-width meet at this distance from the axis
  const double meeting = half / std::sin(pi / level.arms);
  return meeting <= shaft_radius;
}

PinLevel read_level(const Section& in, const Geometry& geometry) {
  const Impeller& impeller = *geometry.impeller;
  PinLevel level;
  level.thickness = in.number(
      "thickness", positive_below("a pin's diameter", impeller.shaft_diameter, " m", "that of the shaft"));
  const double low = impeller.shaft_end + level.thickness / 2;
  const double high = geometry.length - level.thickness / 2;
  level.height =
      in.number("height", {"a height in m of the pins' axis, at which the pins lie on the shaft and below "
                           "the lid, from " +
                               shown(low) + " to " + shown(high) + " m",
                           [=](double v) { return v >= low * (1 - 1e-12) && v <= high; }});
  const double half = level.thickness / 2;
  const double reach = std::sqrt(geometry.radius() * geometry.radius() - half * half);
  level.length =
      in.number("length", {"a length in m from tip to tip above the shaft's diameter, " +
                               shown(impeller.shaft_diameter) + " m, and below " + shown(2 * reach) +
                               " m, at which the pins would hit the shell",
                           [&](double v) { return v > impeller.shaft_diameter && v < 2 * reach; }});
  level.angle = in.number(
      "angle", {"an angle in degrees from -360 to 360", [](double v) { return std::abs(v) <= 360; }}, 0);
  level.arms = in.integer("arms", whole_number("arms", 1, most_arms), 2);
  if (!arms_are_apart(level, impeller.shaft_diameter / 2))
    in.refuse("arms", "fewer arms, or thinner ones: these meet outside of the shaft");
  return level;
}

void refuse_pins_that_meet(const std::vector<Section>& items, const std::vector<PinLevel>& pins) {
  for (std::size_t i = 0; i < pins.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      const auto [low, high] = span_of(pins[i]);
      const auto [other_low, other_high] = span_of(pins[k]);
      if (low < other_high && high > other_low)
        items[i].refuse("height", "a height at which these pins, from " + shown(low) + " to " + shown(high) +
                                      " m, do not hit those from " + shown(other_low) + " to " +
                                      shown(other_high) + " m");
    }
}

Disc read_disc(const Section& in, const Geometry& geometry) {
  const Impeller& impeller = *geometry.impeller;
  Disc disc;
  disc.thickness = in.number(
      "thickness", positive_below("a disc's thickness", geometry.length, " m", "the mill's height"));
  const double gap = least_gap * impeller.shaft_diameter;
  const double end = impeller.shaft_end + disc.thickness / 2;
  const double high = geometry.length - gap - disc.thickness / 2;
  disc.height = in.number(
      "height", {"a height in m of the disc's middle plane, " + shown(end) +
                     " m for a disc at the shaft's end, or from " + shown(end + gap) + " to " + shown(high) +
                     " m for one above it and below the lid",
                 [&](double v) {
                   return is_at_shaft_end({v, 0, disc.thickness}, impeller) || (v >= end + gap && v <= high);
                 }});
  disc.diameter =
      in.number("diameter", {"a diameter in m above the shaft's, " + shown(impeller.shaft_diameter) +
                                 " m, and below the shell's, " + shown(geometry.diameter) + " m",
                             [&](double v) { return v > impeller.shaft_diameter && v < geometry.diameter; }});
  return disc;
}

/// A disc leaves a gap to pins and to other discs: no walls of two parts touch.
void refuse_discs_that_meet(const std::vector<Section>& items, const Impeller& impeller) {
  const double gap = least_gap * impeller.shaft_diameter;
  for (std::size_t i = 0; i < impeller.discs.size(); ++i) {
    const auto [low, high] = span_of(impeller.discs[i]);
    const auto require_apart = [&, low = low, high = high](const auto& other, const std::string& what) {
      const auto [other_low, other_high] = span_of(other);
      if (low >= other_high + gap || high <= other_low - gap) return;
      items[i].refuse("height", "a height at which this disc, from " + shown(low) + " to " + shown(high) +
                                    " m, is " + shown(gap) + " m or more away from " + what + " from " +
                                    shown(other_low) + " to " + shown(other_high) + " m");
    };
    for (const PinLevel& level : impeller.pins) require_apart(level, "the pins");
    for (std::size_t k = 0; k < i; ++k) require_apart(impeller.discs[k], "the disc");
  }
}

Impeller read_impeller(const Section& in, Geometry& geometry) {
  const Section shaft = in.section("shaft", {"diameter", "end"});
  geometry.impeller = Impeller();
  Impeller& impeller = *geometry.impeller;
  impeller.shaft_diameter =
      shaft.number("diameter", positive_below("a length", geometry.diameter, " m", "the shell's diameter"));
  impeller.shaft_end = shaft.number(
      "end", positive_below("the height in m of its lower end", geometry.length, " m", "the mill's height"));
  if (in.has("pins")) {
    const auto items = in.list("pins", {"height", "length", "thickness", "angle", "arms"});
    if (items.size() > most_levels) in.refuse("pins", "at most " + std::to_string(most_levels) + " levels");
    for (const Section& item : items) impeller.pins.push_back(read_level(item, geometry));
    refuse_pins_that_meet(items, impeller.pins);
  }
  if (in.has("discs")) {
    const auto items = in.list("discs", {"height", "diameter", "thickness"});
    if (items.size() > most_discs) in.refuse("discs", "at most " + std::to_string(most_discs) + " discs");
    for (const Section& item : items) impeller.discs.push_back(read_disc(item, geometry));
    refuse_discs_that_meet(items, impeller);
  }
  return impeller;
}

/// Area of an arm's section by the plane at a height, outside of the shaft: a strip from the shaft to the
/// tip.
double arm_section(const PinLevel& level, double shaft_radius, double half_width) {
  const double r = shaft_radius, c = half_width;
  return c * level.length - (c * std::sqrt(r * r - c * c) + r * r * std::asin(c / r));
}

/// Volume of a level's arms outside of the shaft and below a height.
double arms_volume(const PinLevel& level, double shaft_radius, double height) {
  const double half = level.thickness / 2;
  // z = height of the axis + half sin(t), in which the section is smooth up to the pin's edges
  const double end = std::asin(std::clamp((height - level.height) / half, -1.0, 1.0));
  constexpr int steps = 200;
  double sum = 0;
  const double step = (end + pi / 2) / steps;
  for (int i = 0; i <= steps; ++i) {
    const double width = half * std::cos(-pi / 2 + step * i);
    const double weight = i == 0 || i == steps ? 1 : i % 2 == 1 ? 4 : 2;  // Simpson's
    sum += weight * arm_section(level, shaft_radius, width) * width;
  }
  return level.arms * sum * step / 3;
}

/// Volume of a disc outside of the shaft and below a height.
double disc_volume(const Disc& disc, double shaft_radius, double height) {
  const auto [low, high] = span_of(disc);
  const double outer = disc.diameter / 2;
  return pi * (outer * outer - shaft_radius * shaft_radius) * (std::clamp(height, low, high) - low);
}

double read_tip_speed(const Section& speed) {
  return speed.number("tip_speed", {"a speed of the impeller's tips in m/s from " + shown(slowest_tip) +
                                        " to " + shown(fastest_tip) + " (or the key angular_velocity or rpm)",
                                    [](double v) { return v >= slowest_tip && v <= fastest_tip; }});
}

}  // namespace

Geometry read_stirred_geometry(const Section& in) {
  Geometry geometry;
  geometry.diameter = in.number("diameter", length_of_mill());
  geometry.length = in.number("height", length_of_mill());
  geometry.ends = Ends::plain;
  geometry.impeller = read_impeller(in.section("impeller", {"shaft", "pins", "discs"}), geometry);
  return geometry;
}

double read_stirred_speed(Section& in, const Geometry& geometry) {
  const double reach = impeller_radius(*geometry.impeller);
  const double slowest = slowest_tip / reach, fastest = fastest_tip / reach;
  const Rule turning = {"an angular velocity in rad/s from " + shown(slowest) + " to " + shown(fastest) +
                            ", positive for anticlockwise seen from above (or the key rpm)",
                        [=](double v) { return std::abs(v) >= slowest && std::abs(v) <= fastest; }};
  return read_turning_speed(in, {slowest, fastest, turning, "tip_speed",
                                 [&] { return read_tip_speed(in) / reach; }, "anticlockwise"});
}

double impeller_volume(const Geometry& geometry, double height) {
  const Impeller& impeller = *geometry.impeller;
  const double r = impeller.shaft_diameter / 2;
  double volume = pi * r * r * std::max(height - impeller.shaft_end, 0.0);
  for (const PinLevel& level : impeller.pins) volume += arms_volume(level, r, height);
  for (const Disc& disc : impeller.discs) volume += disc_volume(disc, r, height);
  return volume;
}

bool is_at_shaft_end(const Disc& disc, const Impeller& impeller) {
  return std::abs(span_of(disc).first - impeller.shaft_end) <= 1e-6 * impeller.shaft_diameter;
}

double impeller_radius(const Impeller& impeller) {
  double reach = impeller.shaft_diameter / 2;
  for (const PinLevel& level : impeller.pins) reach = std::max(reach, level.length / 2);
  for (const Disc& disc : impeller.discs) reach = std::max(reach, disc.diameter / 2);
  return reach;
}

double impeller_gap(const Geometry& geometry) {
  double reach = impeller_radius(*geometry.impeller);
  for (const PinLevel& level : geometry.impeller->pins)
    reach = std::max(reach, std::hypot(level.length / 2, level.thickness / 2));
  return geometry.radius() - reach;
}

double impeller_top(const Impeller& impeller) {
  double top = impeller.shaft_end;
  for (const PinLevel& level : impeller.pins) top = std::max(top, span_of(level).second);
  for (const Disc& disc : impeller.discs) top = std::max(top, span_of(disc).second);
  return top;
}

}  // namespace millfoam::meshing
