// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/mill/flow_start.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "meshing/files/text_numbers.hpp"
#include "meshing/mill/mill_charge.hpp"
#include "meshing/mill/mill_shape.hpp"
#include "meshing/mill/rules.hpp"
#include "meshing/mill/stirred_geometry.hpp"

namespace millfoam::meshing {
namespace {

FlowStart at_level(double level) {
  FlowStart start;
  start.level = level;
  return start;
}

/// Slurry of a stirred mill that stands at a level when all is at rest: the space below it without impeller
/// and balls, which lie up to the height that they fill by their packing.
/// @param balls  volume of the balls, m^3; 0 in a flow without them
/// @param pores  volume between the resting balls, m^3
FlowStart at_rest(double level, double balls, double pores, const Mill& mill) {
  const double space = analytic_section(mill.geometry) * level - impeller_volume(mill.geometry, level);
  FlowStart start;
  start.volume = space - std::min(balls, mill.charge.packing * space);
  start.fill = pores > 0 ? start.volume / pores : 0;
  return start;
}

FlowStart read_start(const Section& flow, Section& slurry, bool with_balls, const Mill& mill) {
  const double radius = mill.geometry.radius(), height = mill.geometry.length;
  const bool stirred = mill.machine() == Machine::stirred;
  const double pores = count_charge(mill).pore_volume;
  const double balls = with_balls ? count_charge(mill).volume : 0;
  const Rule level = stirred ? positive_below("a height in m above the base", height, " m", "the mill's")
                             : Rule{"a height in m within the radius, " + shown(radius) + " m, of the axis",
                                    [=](double v) { return std::abs(v) <= radius; }};
  FlowStart start;
  const bool both_set = flow.is_set("start") && slurry.is_set("level");
  if (flow.is_set("start") && !both_set) slurry.drop("level");
  if (slurry.has("level")) {
    if (flow.has("start") && (both_set || !slurry.is_set("level")))
      flow.refuse("start", "either this key or slurry.level");
    const double at = slurry.number("level", level);
    return stirred ? at_rest(at, balls, pores, mill) : at_level(at);
  }
  Section in = flow.optional_section("start", {"level", "volume", "fill"});
  in.alternatives({"level", "volume", "fill"});
  for (const auto& [one, other] : {std::pair("level", "volume"), {"level", "fill"}, {"volume", "fill"}})
    if (in.has(one) && in.has(other)) in.refuse(other, std::string("either this key or ") + one);
  if (in.has("level")) {
    const double at = in.number("level", level);
    return stirred ? at_rest(at, balls, pores, mill) : at_level(at);
  }
  if (in.has("volume")) {
    start.volume = in.number("volume", zero_up_to("a volume in m^3 (of the whole mill)", mill.whole_volume)) *
                   flow_volume(mill.geometry) / mill.whole_volume;
  } else {
    start.volume = pores * in.number("fill",
                                     {"a share of the resting charge's pores of 0 or more and up to 20",
                                      [](double v) { return v >= 0 && v <= 20; }},
                                     1);
  }
  start.fill = pores > 0 ? start.volume / pores : 0;
  return start;
}

/// Slurry and balls together must fit.
void check_room(const Section& flow, const FlowStart& start, bool with_balls, const Mill& mill) {
  if (start.level) return;
  const double balls = with_balls ? count_charge(mill).volume : 0;
  const double room = flow_volume(mill.geometry) - balls;
  if (start.volume < room) return;
  const Section in = flow.optional_section("start", {"level", "volume", "fill"});
  in.refuse(in.has("volume") ? "volume" : "fill", "slurry that fits: it is " + shown(start.volume) +
                                                      " m^3, the mill has room for " + shown(room) + " m^3");
}

}  // namespace

FlowStart read_flow_start(const Section& flow, Section& slurry, bool with_balls, const Mill& mill) {
  const FlowStart start = read_start(flow, slurry, with_balls, mill);
  check_room(flow, start, with_balls, mill);
  return start;
}

}  // namespace millfoam::meshing
