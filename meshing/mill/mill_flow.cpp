// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/mill/mill_flow.hpp"

#include <algorithm>
#include <cmath>

#include "meshing/files/text_numbers.hpp"
#include "meshing/mill/mill_charge.hpp"
#include "meshing/mill/mill_geometry.hpp"
#include "meshing/mill/mill_shape.hpp"
#include "meshing/mill/rules.hpp"
#include "meshing/mill/stirred_averages.hpp"
#include "meshing/mill/stirred_geometry.hpp"
#include "openfoam_module/drag/drag_laws.hpp"
#include "openfoam_module/drag/nonspherical.hpp"

namespace millfoam::meshing {
namespace {

/// Where mill.yaml leaves them open. Voxels of 2.5 Sauter diameters hold 18 balls of a dense charge; the drag
/// laws were derived on 8 to 64. Few balls fit across a small mill, whose curved wall voxels must still show.
/// A window is short against a turn and has 25 records. The flow's first turn brings the slurry to where it
/// stays. Limits of the time-step: cases/studies/mill_resolution.
constexpr double usual_voxel = 2.5;
constexpr double usual_voxels_of_radius = 4;
constexpr double windows_per_turn = 20;
constexpr double usual_flow_turns = 3;
constexpr int usual_passes = 6;
constexpr int usual_steady_turns = 6;
constexpr double usual_relaxation = 0.7;
constexpr double share_averaged = 2.0 / 3;
constexpr double fields_per_turn = 24;
constexpr double samples_per_window = 10;
constexpr double finest_flow_voxel = 1.0 / 32;
constexpr double longest_step_of_turn = 1.0 / 250;

/// The same of a stirred mill, whose impeller turns several times a second: turns of the flow, written fields
/// and windows in a turn.
constexpr double usual_stirred_flow_turns = 15;
constexpr double stirred_fields_per_turn = 0.5;
constexpr double stirred_windows_per_turn = 1;

/// Voxels of a few balls are up to 2.3 % off the balls' volume on the cells of small mills (radius of four to
/// seven balls), up to 5.1 % at single times of a smooth course between windows that differ; where averages
/// do not fit the mesh it is tens of per cent.
constexpr double usual_largest_correction = 0.08;

/// Length along the axis that slurry and balls can reach, m.
double reach(const Geometry& geometry) {
  return geometry.length + (geometry.pulp_lifters ? geometry.pulp_lifters->depth : 0);
}

/// Voxels or slices along an axis, and voxels together, that memory and files can hold.
constexpr int most_along_axis = 10000;
constexpr double most_voxels = 1e9;
/// Factor on the drag, with which balls and slurry move as one.
constexpr double largest_multiplier = 1000;

void check_number_of_voxels(const Section& in, double across, double along) {
  const double voxels = across * across * along;
  if (voxels <= most_voxels) return;
  const bool counted = in.has("counts");
  in.refuse(counted ? "counts" : "voxel_size", (counted ? "numbers that give" : "a length that gives") +
                                                   std::string(" at most 1e9 voxels, not ") + shown(voxels));
}

/// Voxels across and along the mill, by `voxel_size` or `counts`; an even number across unless counted.
/// @param usual_along  number along the axis; 0: by voxel_size
Voxels read_voxels(Section& in, const Geometry& geometry, double usual_size, int usual_along) {
  in.alternatives({"voxel_size", "counts"});
  const double length = reach(geometry);
  Voxels voxels;
  double half = geometry.radius();
  if (in.has("counts")) {
    if (in.has("voxel_size")) in.refuse("voxel_size", "either voxel_size or counts");
    const Section counts = in.section("counts", {"across", "along"});
    voxels.shape[0] = counts.integer("across", whole_number("voxels across the mill", 1, most_along_axis));
    const Rule along = whole_number("voxels along the axis", 1, most_along_axis);
    voxels.shape[2] =
        usual_along > 0 ? counts.integer("along", along, usual_along) : counts.integer("along", along);
    check_number_of_voxels(in, voxels.shape[0], voxels.shape[2]);
  } else {
    const double size =
        in.number("voxel_size",
                  {"a length of at least a thousandth of the diameter, and up to the radius, " + shown(half) +
                       " m (or the key counts)",
                   [=](double v) { return v >= half / 500 && v <= half; }},
                  usual_size);
    voxels.shape[0] = 2 * static_cast<int>(std::ceil(half / size * (1 - 1e-9)));
    half = voxels.shape[0] * size / 2;
    const double along = usual_along > 0 ? usual_along : std::max(1.0, std::round(length / size));
    check_number_of_voxels(in, voxels.shape[0], along);
    voxels.shape[2] = static_cast<int>(along);
  }
  voxels.shape[1] = voxels.shape[0];
  voxels.lower = {-half, -half, 0};
  voxels.upper = {half, half, length};
  return voxels;
}

/// A number of records, as a time.
double whole_records(double time, const Mill& mill) {
  return std::max(1.0, std::round(time / mill.dem.record_interval)) * mill.dem.record_interval;
}

FlowStart at_level(double level) {
  FlowStart start;
  start.level = level;
  return start;
}

/// Slurry of a stirred mill that stands at a level when all is at rest: the space below it without impeller
/// and balls.
/// @param balls  volume of the balls, m^3; 0 in a flow without them
/// @param pores  volume between the resting balls, m^3
FlowStart at_rest(const Section& in, double level, double balls, double pores, const Mill& mill) {
  const double space = analytic_section(mill.geometry) * level - impeller_volume(mill.geometry, level);
  FlowStart start;
  start.volume = space - balls;
  if (!(start.volume > 0))
    in.refuse("level", "a height at which slurry covers the balls: up to " + shown(level) + " m there are " +
                           shown(space) + " m^3, and the balls' volume is " + shown(balls) + " m^3");
  start.fill = start.volume / pores;
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
    return stirred ? at_rest(slurry, at, balls, pores, mill) : at_level(at);
  }
  Section in = flow.optional_section("start", {"level", "volume", "fill"});
  in.alternatives({"level", "volume", "fill"});
  for (const auto& [one, other] : {std::pair("level", "volume"), {"level", "fill"}, {"volume", "fill"}})
    if (in.has(one) && in.has(other)) in.refuse(other, std::string("either this key or ") + one);
  if (in.has("level")) {
    const double at = in.number("level", level);
    return stirred ? at_rest(in, at, balls, pores, mill) : at_level(at);
  }
  if (in.has("volume")) {
    start.volume = in.number("volume", zero_up_to("a volume in m^3 (of the whole mill)",
                                                  flow_volume(mill.geometry) * mill.whole_length /
                                                      mill.geometry.length)) *
                   mill.geometry.length / mill.whole_length;
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
void check_room(const Section& flow, const Flow& read, const Mill& mill) {
  if (read.start.level) return;
  const double balls = read.balls ? count_charge(mill).volume : 0;
  const double room = flow_volume(mill.geometry) - balls;
  if (read.start.volume < room) return;
  const Section in = flow.optional_section("start", {"level", "volume", "fill"});
  in.refuse(in.has("volume") ? "volume" : "fill", "slurry that fits: it is " + shown(read.start.volume) +
                                                      " m^3, the mill has room for " + shown(room) + " m^3");
}

void read_duration(Section& in, const Mill& mill, Flow& flow) {
  in.alternatives({"duration", "turns"});
  if (in.has("duration")) {
    if (in.has("turns")) in.refuse("turns", "either duration or turns");
    flow.duration = in.number("duration", time_above_zero());
  } else {
    flow.duration =
        mill.turn() *
        in.number("turns",
                  {"a number of turns above 0 and up to 10000", [](double v) { return v > 0 && v <= 1e4; }},
                  mill.geometry.impeller ? usual_stirred_flow_turns : usual_flow_turns);
  }
}

std::optional<SteadyEnd> read_steady_end(const Section& flow_section, const Flow& flow, double turn) {
  if (!flow_section.has("steady")) return std::nullopt;
  const Section in = flow_section.section("steady", {"turns", "hours"});
  SteadyEnd end;
  end.turns = in.integer("turns",
                         {"an even whole number of turns from 4 to 1000",
                          [](double v) { return v >= 4 && v <= 1000 && std::fmod(v, 2) == 0; }},
                         usual_steady_turns);
  // Half as many turns before them are the flow's start
  const double least = 1.5 * end.turns, there = flow.duration / turn;
  if (there < least * (1 - 1e-9))
    flow_section.refuse("steady", "a longest duration of the flow of " + shown(least) +
                                      " turns or more (flow.turns, flow.duration); it is " + shown(there) +
                                      " turns");
  if (in.has("hours")) {
    if (flow.solver != "slurryFoam") in.refuse("hours", "this key with flow.solver slurryFoam only");
    end.hours = in.number("hours", {"hours of wall time above 0", [](double v) { return v > 0; }});
  }
  if (flow.coupling.both_ways())
    flow_section.refuse("steady", "flow.coupling one_way: balls that feel the slurry run for a given time");
  if (flow.balls && flow.out_of_range != "repeat")
    flow_section.refuse("steady", "flow.out_of_range repeat: the flow outlasts the record of the dry run");
  return end;
}

void read_drag(const Section& in, Flow& flow) {
  Section::Keys names;
  for (const drag::Law& law : drag::laws()) names.emplace_back(law.name);
  names.emplace_back(drag::hoelzer_sommerfeld_law().name);
  flow.law = in.choice("law", names, "Beetstra");
  flow.multiplier = in.number("multiplier", zero_up_to("a factor on the drag", largest_multiplier), 1);
  flow.viscosity = in.choice("viscosity", {"plastic", "pore"}, "plastic");
  flow.polydispersity = in.boolean("polydispersity", false);
  flow.mixed_drag = in.choice("mixed_drag", {"weights", "permeability"}, "weights");
}

Coupling read_coupling(Section& in, const Flow& flow) {
  Coupling coupling;
  const std::string kind = in.choice("coupling", {"one_way", "iterated", "direct"}, "one_way");
  for (const CouplingKind one : {CouplingKind::one_way, CouplingKind::iterated, CouplingKind::direct})
    if (kind == name_of(one)) coupling.kind = one;
  if (coupling.both_ways() && flow.solver != "slurryFoam")
    in.refuse("coupling", "one_way: only slurryFoam knows what the balls feel");
  if (coupling.both_ways() && !flow.balls) in.refuse("coupling", "one_way where flow.balls is no");
  coupling.passes = in.integer("passes", whole_number("passes", 2, 50), usual_passes);
  coupling.relaxation =
      in.number("relaxation", {"a share above 0 and up to 1", [](double v) { return v > 0 && v <= 1; }},
                usual_relaxation);
  return coupling;
}

Rule courant_number() {
  return {"a Courant number above 0 and up to 10", [](double v) { return v > 0 && v <= 10; }};
}

/// Only slurryFoam's step depends on the voidage, and on the air by a bound of its own.
void read_own_bounds(Section& in, Flow& flow) {
  if (flow.solver != "slurryFoam") {
    for (const char* key : {"max_air_courant", "max_voidage_change"}) {
      if (in.has(key) && (in.is_set(key) || !in.is_set("solver")))
        in.refuse(key, "this key with flow.solver slurryFoam only");
      in.drop(key);
    }
    return;
  }
  flow.max_air_courant = in.number("max_air_courant", courant_number(), 2.5);
  flow.max_voidage_change = in.number(
      "max_voidage_change",
      {"a share of a cell's voidage above 0 and up to 1", [](double v) { return v > 0 && v <= 1; }}, 0.1);
}

void read_steps(Section& in, const Mill& mill, Flow& flow) {
  // slurryFoam carries the slurry in parts of a step where a cell gives away more fluid than it has;
  // interFoam's surface is smeared by that
  const bool in_parts = flow.solver == "slurryFoam";
  flow.max_courant = in.number("max_courant", courant_number(), in_parts ? 1.25 : 1);
  flow.max_surface_courant = in.number("max_surface_courant", courant_number(), in_parts ? 1.25 : 0.5);
  read_own_bounds(in, flow);
  flow.largest_correction = in.number(
      "largest_correction",
      {"a share of the balls' volume of 0 or more and up to 1", [](double v) { return v >= 0 && v <= 1; }},
      usual_largest_correction);
  flow.max_time_step = in.number("max_time_step", part_of("flow's duration", flow.duration),
                                 std::min(longest_step_of_turn * mill.turn(), flow.duration));
  flow.write_interval =
      in.number("write_interval", part_of("flow's duration", flow.duration),
                std::min(mill.turn() / (mill.geometry.impeller ? stirred_fields_per_turn : fields_per_turn),
                         flow.duration));
}

/// Whole turns at the end of the flow, at most two thirds of it; of a flow shorter than 1.5 turns its
/// second half.
double usual_averages_start(const Flow& flow, double turn) {
  const double turns = std::floor(share_averaged * flow.duration / turn * (1 + 1e-9));
  return turns >= 1 ? std::max(0.0, flow.duration - turns * turn) : flow.duration / 2;
}

/// Voxels along the axis: one for each of the mesh's layers, of a stirred mill of its cell size.
int slices_along(const Mill& mill) {
  const double layer =
      mill.geometry.impeller ? mill.resolution.cell_size : mill.geometry.length / mill.resolution.layers;
  return std::max(1, static_cast<int>(std::lround(reach(mill.geometry) / layer)));
}

/// What only tumbling mills have.
void refuse_for_stirred(const Section& in, const Flow& flow) {
  if (flow.solver != "slurryFoam") in.refuse("solver", "slurryFoam for a stirred mill");
  if (flow.coupling.both_ways()) in.refuse("coupling", "one_way for a stirred mill");
}

FlowAverages read_flow_averages(const Section& flow_section, const Flow& flow, const Mill& mill) {
  Section in =
      flow_section.optional_section("averages", {"start", "window", "interval", "voxel_size", "counts"});
  const double radius = mill.geometry.radius();
  const double size = std::max(shell_cell_size(mill.resolution, mill.geometry), finest_flow_voxel * radius);
  const int along = slices_along(mill);
  FlowAverages averages;
  averages.voxels = read_voxels(in, mill.geometry, std::min(size, radius), along);
  const Rule begin = {
      flow.steady ? "0, or not this key: with flow.steady the last turns are averaged"
                  : "a flow time in s of 0 or more and below the duration, " + shown(flow.duration) + " s",
      [&](double v) { return v == 0 || (!flow.steady && v > 0 && v < flow.duration); }};
  averages.start = in.number("start", begin, flow.steady ? 0 : usual_averages_start(flow, mill.turn()));
  const double rest = flow.duration - averages.start;
  averages.window = in.number(
      "window", part_of("time after flow.averages.start", rest),
      std::min(mill.turn() / (mill.geometry.impeller ? stirred_windows_per_turn : windows_per_turn), rest));
  averages.interval =
      in.number("interval", part_of("window", averages.window), averages.window / samples_per_window);
  return averages;
}

/// The averages' length of windows; of a whole run it follows from the start.
void read_window(const Section& in, const Mill& mill, Averages& averages) {
  averages.whole_run = averages.rings && (!in.has("window") || in.is("window", "whole"));
  if (averages.whole_run) {
    in.choice("window", {"whole"}, "whole");
    return;
  }
  const double duration = mill.dem.duration, shortest = mill.dem.record_interval;
  averages.window = in.number("window",
                              {(averages.rings ? "'whole', or a time" : "a time") +
                                   std::string(" in s of at least dem.record_interval, ") + shown(shortest) +
                                   " s, and not above dem.duration, " + shown(duration) + " s",
                               [=](double v) { return v >= shortest * (1 - 1e-9) && v <= duration; }},
                              std::min(whole_records(mill.turn() / windows_per_turn, mill), duration));
}

}  // namespace

Averages read_averages(const Section& root, const Mill& mill) {
  const bool stirred = mill.machine() == Machine::stirred;
  Section::Keys keys{"window", "start", "method", "template", "live"};
  const Section::Keys cells = stirred ? Section::Keys{"frame", "radial", "azimuthal", "axial"}
                                      : Section::Keys{"voxel_size", "counts"};
  keys.insert(keys.end(), cells.begin(), cells.end());
  Section in = root.optional_section("averages", keys);
  const ChargeNumbers charge = count_charge(mill);
  const double radius = mill.geometry.radius();
  const double many_balls = std::min(usual_voxel * charge.sauter_diameter, radius / usual_voxels_of_radius);
  const double usual_size = std::min(std::max(charge.largest_diameter, many_balls), radius);
  Averages averages;
  if (stirred)
    averages.rings = read_rings(in, mill.geometry, charge.largest_diameter);
  else
    averages.voxels = read_voxels(in, mill.geometry, usual_size, 0);
  read_window(in, mill, averages);
  const double duration = mill.dem.duration;
  const Rule time = {
      "'steady', or a DEM time in s of 0 or more and below dem.duration, " + shown(duration) + " s",
      [=](double v) { return v >= 0 && v < duration; }};
  if (!in.has("start") || in.is("start", "steady"))
    in.choice("start", {"steady"}, "steady");
  else
    averages.start = in.number("start", time);
  averages.method = in.choice("method", {"exact", "sample"}, "exact");
  averages.template_points =
      in.integer("template",
                 {"a whole number of points from 2 to 100", [](double v) { return v >= 2 && v <= 100; }}, 12);
  averages.live = in.boolean("live", false);
  if (averages.whole_run) averages.window = duration - averages.start.value_or(0);
  if (averages.whole_run && averages.live && !averages.start)
    in.refuse("live",
              "false, or a time in s as averages.start: a window of the whole run cannot wait until the "
              "charge is steady");
  return averages;
}

Flow read_flow(const Section& root, Section& slurry, const Mill& mill) {
  Section in = root.optional_section("flow", {"solver",
                                              "duration",
                                              "turns",
                                              "balls",
                                              "law",
                                              "multiplier",
                                              "viscosity",
                                              "polydispersity",
                                              "mixed_drag",
                                              "out_of_range",
                                              "coupling",
                                              "passes",
                                              "steady",
                                              "relaxation",
                                              "start",
                                              "feed",
                                              "max_courant",
                                              "max_surface_courant",
                                              "max_air_courant",
                                              "max_voidage_change",
                                              "largest_correction",
                                              "max_time_step",
                                              "write_interval",
                                              "slices",
                                              "averages"});
  Flow flow;
  flow.solver = in.choice("solver", {"slurryFoam", "interFoam"}, "slurryFoam");
  read_duration(in, mill, flow);
  flow.balls = in.boolean("balls", true);
  read_drag(in, flow);
  flow.out_of_range = in.choice("out_of_range", {"error", "hold", "repeat"}, "repeat");
  flow.coupling = read_coupling(in, flow);
  if (mill.geometry.impeller) refuse_for_stirred(in, flow);
  flow.steady = read_steady_end(in, flow, mill.turn());
  flow.start = read_start(in, slurry, flow.balls, mill);
  check_room(in, flow, mill);
  const double feed = in.number(
      "feed",
      zero_up_to("a feed rate in m^3/s (the mill's volume in a second at most)", flow_volume(mill.geometry)),
      0);
  if (feed > 0 && !mill.geometry.inlet && mill.whole_length == mill.geometry.length)
    in.refuse("feed", "this key with geometry.inlet only");
  flow.feed = mill.geometry.inlet ? feed : 0;
  read_steps(in, mill, flow);
  flow.slices = in.integer("slices", whole_number("slices", 1, most_along_axis),
                           mill.geometry.impeller ? slices_along(mill) : mill.resolution.layers);
  flow.averages = read_flow_averages(in, flow, mill);
  return flow;
}

std::string name_of(CouplingKind kind) {
  switch (kind) {
    case CouplingKind::one_way:
      return "one_way";
    case CouplingKind::iterated:
      return "iterated";
    case CouplingKind::direct:
      return "direct";
  }
  return {};
}

}  // namespace millfoam::meshing
