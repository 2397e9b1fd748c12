// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/mill/mill_flow.hpp"

#include <algorithm>
#include <cmath>

#include "meshing/files/text_numbers.hpp"
#include "meshing/mill/flow_start.hpp"
#include "meshing/mill/mill_averages.hpp"
#include "meshing/mill/mill_charge.hpp"
#include "meshing/mill/mill_geometry.hpp"
#include "meshing/mill/mill_shape.hpp"
#include "meshing/mill/mill_voxels.hpp"
#include "meshing/mill/rules.hpp"
#include "openfoam_module/drag/drag_laws.hpp"
#include "openfoam_module/drag/nonspherical.hpp"

namespace millfoam::meshing {
namespace {

/// Where mill.yaml leaves them open. Limits of the time-step: cases/studies/mill_resolution.
constexpr int usual_passes = 6;
constexpr int usual_steady_turns = 6;
constexpr double usual_relaxation = 0.7;
constexpr double share_averaged = 2.0 / 3;
constexpr double samples_per_window = 10;
constexpr double finest_flow_voxel = 1.0 / 32;
constexpr double longest_step_of_turn = 1.0 / 250;

/// The same by machine: turns of the flow; written fields and windows in a turn.
struct UsualFlow {
  double turns;
  double fields_per_turn;
  double windows_per_turn;
};
/// The first turn brings the slurry to where it stays.
constexpr UsualFlow usual_tumbling = {3, 24, windows_per_turn};
/// The impeller turns several times a second.
constexpr UsualFlow usual_stirred = {15, 0.5, 1};

const UsualFlow& usual_of(const Mill& mill) {
  return mill.machine() == Machine::stirred ? usual_stirred : usual_tumbling;
}

/// Voxels of a few balls are up to 2.3 % off the balls' volume on the cells of small mills (radius of four to
/// seven balls), up to 5.1 % at single times of a smooth course between windows that differ; where averages
/// do not fit the mesh it is tens of per cent.
constexpr double usual_largest_correction = 0.08;

/// Over the Sauter diameter: voxels on which balls and slurry of a stirred mill meet hold about nine balls,
/// and are smaller than its pins.
constexpr double exchange_voxel = 2;

/// Factor on the drag, with which balls and slurry move as one.
constexpr double largest_multiplier = 1000;

void read_duration(Section& in, const Mill& mill, Flow& flow) {
  in.alternatives({"duration", "turns"});
  if (in.has("duration")) {
    if (in.has("turns")) in.refuse("turns", "either duration or turns");
    flow.duration = in.number("duration", time_above_zero());
  } else {
    flow.duration = mill.turn() * in.number("turns",
                                            {"a number of turns above 0 and up to 10000",
                                             [](double v) { return v > 0 && v <= 1e4; }},
                                            usual_of(mill).turns);
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

Coupling read_coupling(Section& in, const Mill& mill, const Flow& flow) {
  Coupling coupling;
  const std::string kind = in.choice("coupling", {"one_way", "iterated", "direct"}, "one_way");
  for (const CouplingKind one : {CouplingKind::one_way, CouplingKind::iterated, CouplingKind::direct})
    if (kind == name_of(one)) coupling.kind = one;
  if (coupling.both_ways() && flow.solver != "slurryFoam")
    in.refuse("coupling", "one_way: only slurryFoam knows what the balls feel");
  if (coupling.both_ways() && !flow.balls) in.refuse("coupling", "one_way where flow.balls is no");
  if (coupling.kind == CouplingKind::direct && !mill.dem.dumps)
    in.refuse("coupling", "one_way or iterated where dem.dumps is no: direct coupling needs the dumps");
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
void read_own_bounds(Section& in, const Mill& mill, Flow& flow) {
  if (flow.solver != "slurryFoam") {
    const auto& grates = mill.geometry.grates;
    if (grates && grates->open() < 1)
      in.refuse("solver",
                "slurryFoam: only it knows the resistance of geometry.grates, which are open by a share of " +
                    shown(grates->open()));
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
  read_own_bounds(in, mill, flow);
  if (flow.solver != "slurryFoam" && in.is_set("largest_correction"))
    in.refuse("largest_correction", "this key with flow.solver slurryFoam only");
  flow.largest_correction = in.number(
      "largest_correction",
      {"a share of the balls' volume of 0 or more and up to 1", [](double v) { return v >= 0 && v <= 1; }},
      usual_largest_correction);
  flow.max_time_step = in.number("max_time_step", part_of("flow's duration", flow.duration),
                                 std::min(longest_step_of_turn * mill.turn(), flow.duration));
  flow.write_interval = in.number("write_interval", part_of("flow's duration", flow.duration),
                                  std::min(mill.turn() / usual_of(mill).fields_per_turn, flow.duration));
}

/// Whole turns at the end of the flow, at most two thirds of it; of a flow shorter than 1.5 turns its
/// second half.
double usual_averages_start(const Flow& flow, double turn) {
  const double turns = std::floor(share_averaged * flow.duration / turn * (1 + 1e-9));
  return turns >= 1 ? std::max(0.0, flow.duration - turns * turn) : flow.duration / 2;
}

/// Voxels along the axis: as thick as the mesh's layers in the mean, of a stirred mill as its cells.
int slices_along(const Mill& mill) {
  const double layer =
      mill.geometry.impeller ? mill.resolution.cell_size : mill.geometry.length / mill.resolution.layers;
  return std::max(1, static_cast<int>(std::lround(axial_reach(mill.geometry) / layer)));
}

/// What only tumbling mills have.
void refuse_for_stirred(const Section& in, const Flow& flow) {
  if (flow.solver != "slurryFoam") in.refuse("solver", "slurryFoam for a stirred mill");
  if (flow.coupling.kind == CouplingKind::iterated)
    in.refuse("coupling", "one_way or direct for a stirred mill");
}

/// Voxels on which balls and slurry of a stirred mill meet. Averages of a moment need larger cells than those
/// of a whole run; the averages themselves are on rings that turn.
void read_exchange(const Section& flow_section, const Mill& mill, Coupling& coupling) {
  const bool has_voxels = mill.machine() == Machine::stirred && coupling.kind == CouplingKind::direct;
  if (flow_section.has("exchange") && !has_voxels)
    flow_section.refuse("exchange", "this key with flow.coupling direct of a stirred mill only");
  if (!has_voxels) return;
  Section in = flow_section.optional_section("exchange", {"voxel_size", "counts"});
  const ChargeNumbers charge = count_charge(mill);
  const double size = std::max(charge.largest_diameter, exchange_voxel * charge.sauter_diameter);
  coupling.voxels = read_voxels(in, mill.geometry, std::min(size, mill.geometry.radius()), 0);
}

/// @param is_cut  of a slice, whose feed is none, the tracer is none either
std::optional<FeedTracer> read_tracer(Section& flow_section, const Flow& flow, bool is_cut) {
  if (is_cut && flow_section.is_set("tracer"))
    flow_section.refuse("tracer", "this key without geometry.slice only: a slice has no feed");
  if (is_cut) flow_section.drop("tracer");
  if (!flow_section.has("tracer")) return std::nullopt;
  if (flow.solver != "slurryFoam") flow_section.refuse("tracer", "this key with flow.solver slurryFoam only");
  if (flow.feed == 0) flow_section.refuse("tracer", "this key with flow.feed above 0 only: the feed has it");
  Section in = flow_section.section("tracer", {"begin", "pulse", "dispersion"});
  FeedTracer tracer;
  tracer.begin =
      in.number("begin",
                {"a flow time in s of 0 or more and below the duration, " + shown(flow.duration) + " s",
                 [&](double v) { return v >= 0 && v < flow.duration; }},
                0);
  if (in.has("pulse"))
    tracer.pulse = in.number("pulse", part_of("time after flow.tracer.begin", flow.duration - tracer.begin));
  tracer.dispersion = in.number("dispersion", zero_up_to("a dispersion in m^2/s", 1), 0);
  return tracer;
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
  averages.window = in.number("window", part_of("time after flow.averages.start", rest),
                              std::min(mill.turn() / usual_of(mill).windows_per_turn, rest));
  averages.interval =
      in.number("interval", part_of("window", averages.window), averages.window / samples_per_window);
  return averages;
}

}  // namespace

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
                                              "exchange",
                                              "passes",
                                              "steady",
                                              "relaxation",
                                              "start",
                                              "feed",
                                              "tracer",
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
  flow.coupling = read_coupling(in, mill, flow);
  if (mill.machine() == Machine::stirred) refuse_for_stirred(in, flow);
  read_exchange(in, mill, flow.coupling);
  flow.steady = read_steady_end(in, flow, mill.turn());
  flow.start = read_flow_start(in, slurry, flow.balls, mill);
  const double feed = in.number(
      "feed",
      zero_up_to("a feed rate in m^3/s (the mill's volume in a second at most)", flow_volume(mill.geometry)),
      0);
  if (feed > 0 && mill.is_cut && in.is_set("feed"))
    in.refuse("feed", "this key without geometry.slice only: a slice has no feed");
  if (feed > 0 && !mill.is_cut && !mill.geometry.inlet)
    in.refuse("feed", "this key with geometry.inlet only");
  if (feed > 0 && !mill.is_cut && !mill.geometry.grates)
    in.refuse("feed", "this key with geometry.grates only: without them what is fed cannot leave");
  flow.feed = mill.is_cut ? 0 : feed;
  flow.tracer = read_tracer(in, flow, mill.is_cut);
  read_steps(in, mill, flow);
  flow.slices = in.integer("slices", whole_number("slices", 1, most_along_axis),
                           mill.machine() == Machine::stirred ? slices_along(mill) : mill.resolution.layers);
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
