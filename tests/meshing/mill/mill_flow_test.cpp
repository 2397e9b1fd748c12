// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "meshing/mill/mill_charge.hpp"
#include "meshing/mill/mill_document.hpp"
#include "meshing/mill/mill_reader.hpp"
#include "meshing/mill/mill_shape.hpp"
#include "tests/meshing/test_mill.hpp"

namespace millfoam::meshing {
namespace {

/// A mill with nothing but what has no default.
const std::string bare_mill =
    R"(geometry: {diameter: 0.6, length: 0.1, ends: periodic, lifters: {count: 12, height: 0.03, width: 0.03}}
speed: {fraction_of_critical: 0.7, sense: anticlockwise}
charge: {fill: 0.3, diameter: 0.025}
materials: {ball: glass, wall: HDPE}
slurry: {density: 1500, plastic_viscosity: 0.01, yield_stress: 1.0}
)";

Mill mill_of(const std::string& text, const std::vector<std::string>& set = {}) {
  return describe(text, set).mill;
}

std::string refusal_of(const std::string& text, const std::vector<std::string>& set = {}) {
  try {
    describe(text, set);
  } catch (const MillError& error) {
    const std::string message = error.what();
    return message.rfind("--set", 0) == 0 ? message : message.substr(message.find("mill.yaml"));
  }
  return "accepted";
}

TEST(Defaults, make_a_whole_mill_of_its_geometry_speed_charge_and_slurry) {
  const Mill mill = mill_of(bare_mill);
  const double turn = 2 * std::acos(-1.0) / (0.7 * std::sqrt(9.81 / 0.3));
  EXPECT_DOUBLE_EQ(mill.turn(), turn);
  EXPECT_DOUBLE_EQ(mill.dem.duration, 3 * turn);
  EXPECT_DOUBLE_EQ(mill.dem.record_interval, turn / 500);
  EXPECT_FALSE(mill.averages.start);
  EXPECT_DOUBLE_EQ(mill.averages.window, 25 * mill.dem.record_interval);
  EXPECT_DOUBLE_EQ(mill.flow.duration, 3 * turn);
  // Whole turns at the end
  EXPECT_NEAR(mill.flow.averages.start, turn, 1e-12);
  EXPECT_EQ(mill.flow.law, "Beetstra");
  EXPECT_EQ(mill.flow.out_of_range, "repeat");
  EXPECT_DOUBLE_EQ(mill.flow.start.fill, 1);
  EXPECT_EQ(mill.flow.slices, mill.resolution.layers);
}

TEST(Defaults, voxels_hold_8_to_64_balls_and_cover_the_mill) {
  const Mill mill = mill_of(bare_mill);
  const Voxels& voxels = mill.averages.voxels;
  EXPECT_LE(voxels.lower[0], -0.3);
  EXPECT_GE(voxels.upper[1], 0.3);
  EXPECT_EQ(voxels.upper[2], 0.1);
  EXPECT_EQ(voxels.shape[0] % 2, 0);
  const double side = 2 * voxels.upper[0] / voxels.shape[0];
  const double volume = side * side * voxels.upper[2] / voxels.shape[2];
  const double ball = std::acos(-1.0) / 6 * std::pow(0.025, 3);
  EXPECT_GE(mill.charge.packing * volume / ball, 8);
  EXPECT_LE(mill.charge.packing * volume / ball, 64);
}

TEST(Defaults, voxels_show_the_wall_of_a_small_mill_with_large_balls) {
  // 2.5 balls, 100 mm, would be a sixth of the diameter
  EXPECT_EQ(mill_of(bare_mill, {"charge.diameter=0.04"}).averages.voxels.shape[0], 8);
  // No voxel is smaller than a ball
  EXPECT_EQ(mill_of(bare_mill, {"charge.diameter=0.099", "geometry.length=0.2"}).averages.voxels.shape[0], 8);
}

TEST(Feed, needs_a_way_out_and_is_none_in_a_slice) {
  const std::string plain = with(bare_mill, "ends: periodic", "ends: plain");
  const std::vector<std::string> fed{"geometry.inlet={radius: 0.05}", "flow.feed=1e-5",
                                     "flow.tracer={pulse: 0.5}"};
  const auto and_with = [&](const std::string& change) {
    std::vector<std::string> all = fed;
    all.push_back(change);
    return all;
  };
  EXPECT_EQ(refusal_of(plain, fed),
            "--set flow.feed=1e-5: key 'flow.feed' = 1e-5: expected this key with geometry.grates only: "
            "without them what is fed cannot leave");
  EXPECT_EQ(mill_of(plain, and_with("geometry.grates={sectors: 6}")).flow.feed, 1e-5);
  const std::string in_file =
      with(plain, "length: 0.1, ", "length: 0.1, inlet: {radius: 0.05}, grates: {sectors: 6}, ") +
      "flow: {feed: 1.0e-5, tracer: {pulse: 0.5}}\n";
  EXPECT_TRUE(mill_of(in_file).flow.tracer);
  for (const char* slice : {"geometry.slice=0.05", "geometry.slice=0.1"}) {
    const Mill mill = mill_of(in_file, {slice});
    EXPECT_EQ(mill.flow.feed, 0) << slice;
    EXPECT_FALSE(mill.flow.tracer) << slice;
  }
  for (const char* change : {"flow.tracer.pulse=0.4", "flow.feed=2e-5"})
    EXPECT_NE(refusal_of(in_file, {"geometry.slice=0.05", change})
                  .find("expected this key without geometry.slice only: a slice has no feed"),
              std::string::npos)
        << change;
}

TEST(Removal, of_a_key_that_is_not_there_changes_nothing) {
  const std::string level = bare_mill + "flow: {duration: 4}\n";
  const std::string with_level = with(level, "yield_stress: 1.0}", "yield_stress: 1.0, level: -0.1}");
  for (const char* change : {"flow.start.level=~", "flow.start.fill=~", "flow.steady.hours=~",
                             "flow.tracer.pulse=~", "geometry.grates.pegged=~", "resolution.counts.core=~"}) {
    const MillDescription before = describe(with_level), after = describe(with_level, {change});
    EXPECT_EQ(before.document->keys(), after.document->keys()) << change;
    EXPECT_EQ(after.mill.flow.start.level, before.mill.flow.start.level) << change;
  }
  EXPECT_FALSE(mill_of(with_level, {"flow.turns=12", "flow.steady.hours=~"}).flow.steady);
  EXPECT_TRUE(refusal_of(with_level, {"slurry.density=~"}).find("'slurry.density' is missing") !=
              std::string::npos);
  EXPECT_NE(refusal_of(with_level, {"flwo.steady.hours=~"}).find("did you mean 'flow'"), std::string::npos);
  EXPECT_NE(refusal_of(with_level, {"geometry.slcie=~"}).find("did you mean 'slice'"), std::string::npos);
  EXPECT_NE(refusal_of(with_level, {"speed.sense.of=~"}).find("holds no keys"), std::string::npos);
}

TEST(Voxels, by_counts_end_at_the_shell) {
  const Mill mill = mill_of(bare_mill + "averages: {counts: {across: 33, along: 2}}\n");
  EXPECT_EQ(mill.averages.voxels.shape, (std::array<int, 3>{33, 33, 2}));
  EXPECT_EQ(mill.averages.voxels.lower[0], -0.3);
  EXPECT_NE(refusal_of(bare_mill + "averages: {counts: {across: 33, along: 2}, voxel_size: 0.01}\n")
                .find("'averages.voxel_size' = 0.01: expected either voxel_size or counts"),
            std::string::npos);
}

TEST(Voxels, are_so_few_that_a_window_of_their_velocity_fits_into_a_chunk_of_a_file) {
  const auto averages = [](const std::string& along) {
    return bare_mill + "averages: {counts: {across: 1000, along: " + along + "}}\n";
  };
  EXPECT_EQ(mill_of(averages("170")).averages.voxels.shape[2], 170);
  EXPECT_LT(170e6 * 3 * sizeof(double), 4.0 * (1 << 30));
  EXPECT_NE(refusal_of(averages("171")).find("'averages.counts'"), std::string::npos);
  EXPECT_NE(refusal_of(averages("171")).find("at most 1.7e+08 voxels, not 1.71e+08"), std::string::npos);
}

TEST(Voxels, of_the_slurry_are_as_thick_as_the_layers_where_their_number_is_open) {
  const Mill mill = mill_of(bare_mill, {"flow.averages.counts.across=20", "resolution.layers=7"});
  EXPECT_EQ(mill.flow.averages.voxels.shape, (std::array<int, 3>{20, 20, 7}));
  EXPECT_NE(refusal_of(bare_mill, {"averages.counts.across=20"}).find("'averages.counts.along' is missing"),
            std::string::npos);
}

TEST(FlowStart, by_level_volume_or_fill_of_the_pores) {
  EXPECT_EQ(mill_of(bare_mill, {"flow.start.level=-0.1"}).flow.start.level, -0.1);
  EXPECT_EQ(mill_of(bare_mill, {"slurry.level=-0.1"}).flow.start.level, -0.1);
  EXPECT_EQ(mill_of(bare_mill, {"flow.start.volume=0.002"}).flow.start.volume, 0.002);
  const Mill mill = mill_of(bare_mill, {"flow.start.fill=0.5"});
  // Bulk = balls/0.6, of which 0.4 are pores
  EXPECT_NEAR(mill.flow.start.volume, 0.5 * count_charge(mill).volume * 0.4 / 0.6, 1e-15);
}

TEST(FlowStart, volumes_are_those_of_the_whole_mill) {
  const std::string whole = with(bare_mill, "ends: periodic", "ends: plain, slice: 0.05");
  EXPECT_DOUBLE_EQ(mill_of(whole, {"flow.start.volume=0.002"}).flow.start.volume, 0.001);
  // A part of it is in the pulp lifters, 25 mm deep behind 100 mm
  const std::string lifted = with(
      bare_mill, "ends: periodic",
      "ends: plain, slice: 0.05, inlet: {radius: 0.09}, grates: {inner_radius: 0.12, outer_radius: 0.25, "
      "sectors: 12, sector_share: 0.8, open_fraction: 0.3}, "
      "pulp_lifters: {depth: 0.025, layers: 2, discharge_radius: 0.09}");
  EXPECT_DOUBLE_EQ(mill_of(lifted, {"flow.start.volume=0.002"}).flow.start.volume, 0.0008);
}

TEST(FlowStart, is_refused_when_given_twice_or_too_large) {
  EXPECT_NE(refusal_of(bare_mill, {"slurry.level=-0.1", "flow.start.fill=1"})
                .find("either this key or slurry.level"),
            std::string::npos);
  EXPECT_NE(refusal_of(bare_mill, {"flow.start={level: 0, fill: 1}"}).find("either this key or level"),
            std::string::npos);
  EXPECT_NE(refusal_of(bare_mill, {"flow.start.volume=0.025"}).find("the mill has room for"),
            std::string::npos);
}

TEST(Flow, laws_are_those_of_the_table) {
  EXPECT_EQ(mill_of(bare_mill, {"flow.law=Hill"}).flow.law, "Hill");
  const std::string message = refusal_of(bare_mill + "flow: {law: Stokes}\n");
  EXPECT_EQ(message.find("mill.yaml:6: key 'flow.law' = Stokes: expected one of Ergun, "), 0U) << message;
}

TEST(Averages, have_a_whole_window_within_the_dry_run) {
  const auto changes = [](const std::string& start, const std::string& window) {
    return std::vector<std::string>{"dem.duration=2", "averages.start=" + start, "averages.window=" + window};
  };
  EXPECT_EQ(mill_of(bare_mill, changes("1.5", "0.5")).averages.start, 1.5);
  EXPECT_NE(
      refusal_of(bare_mill, changes("1.6", "0.5"))
          .find("'averages.start' = 1.6: expected 'steady', or a DEM time in s of 0 or more and at most "
                "dem.duration less averages.window, 1.5 s"),
      std::string::npos);
}

TEST(Flow, averages_begin_after_the_first_half_of_a_short_one) {
  EXPECT_DOUBLE_EQ(mill_of(bare_mill, {"flow.duration=0.5"}).flow.averages.start, 0.25);
}

TEST(Flow, coupling_is_one_way_unless_it_is_asked_for) {
  EXPECT_EQ(mill_of(bare_mill).flow.coupling.kind, CouplingKind::one_way);
  const Coupling coupling = mill_of(bare_mill + "flow: {coupling: iterated, passes: 3}\n").flow.coupling;
  EXPECT_EQ(coupling.kind, CouplingKind::iterated);
  EXPECT_EQ(mill_of(bare_mill + "flow: {coupling: direct}\n").flow.coupling.kind, CouplingKind::direct);
  EXPECT_EQ(coupling.passes, 3);
  EXPECT_DOUBLE_EQ(coupling.relaxation, 0.7);
}

TEST(Flow, only_balls_in_slurryFoam_can_be_coupled_both_ways) {
  const std::string text = bare_mill + "flow: {coupling: iterated}\n";
  EXPECT_NE(refusal_of(text, {"flow.solver=interFoam"}).find("'flow.coupling' = iterated: expected one_way"),
            std::string::npos);
  EXPECT_NE(refusal_of(text, {"flow.balls=no"}).find("'flow.coupling' = iterated: expected one_way"),
            std::string::npos);
  EXPECT_NE(refusal_of(text, {"dem.fluid=buoyancy", "dem.fluid_level=0"})
                .find("'dem.fluid' = buoyancy: expected none where flow.coupling is iterated"),
            std::string::npos);
  EXPECT_NE(refusal_of(text, {"flow.relaxation=0"}).find("a share above 0 and up to 1"), std::string::npos);
  const std::vector<std::string> without_dumps = {"dem.dumps=no", "averages.live=yes", "averages.start=1"};
  EXPECT_EQ(refusal_of(text, without_dumps), "accepted");
  EXPECT_NE(refusal_of(bare_mill + "flow: {coupling: direct}\n", without_dumps)
                .find("'flow.coupling' = direct: expected one_way or iterated where dem.dumps is no"),
            std::string::npos);
}

TEST(Flow, ends_by_itself_if_it_is_asked_for) {
  EXPECT_FALSE(mill_of(bare_mill).flow.steady);
  const Flow flow = mill_of(bare_mill + "flow: {turns: 20, steady: {hours: 2.5}}\n").flow;
  ASSERT_TRUE(flow.steady);
  EXPECT_EQ(flow.steady->turns, 6);
  EXPECT_EQ(flow.steady->hours, 2.5);
  EXPECT_EQ(flow.averages.start, 0);
}

TEST(Flow, a_steady_end_is_judged_over_whole_halves_after_a_start) {
  const std::string text = bare_mill + "flow: {turns: 12, steady: {turns: 8}}\n";
  EXPECT_EQ(mill_of(text).flow.steady->turns, 8);
  for (const char* turns : {"5", "2"})
    EXPECT_NE(refusal_of(text, {std::string("flow.steady.turns=") + turns})
                  .find("an even whole number of turns from 4 to 1000"),
              std::string::npos)
        << turns;
  // Also the usual number of turns must fit
  const std::string longer = "expected a longest duration of the flow of ";
  EXPECT_NE(refusal_of(text, {"flow.steady.turns=10"}).find(longer + "15 turns or more"), std::string::npos);
  EXPECT_NE(refusal_of(bare_mill + "flow: {steady: {hours: 2}}\n").find(longer + "9 turns or more"),
            std::string::npos);
}

TEST(Flow, a_steady_end_needs_a_flow_that_may_take_any_time) {
  const std::string text = bare_mill + "flow: {turns: 12, steady: {turns: 8}}\n";
  EXPECT_NE(
      refusal_of(text, {"flow.coupling=direct"}).find("'flow.steady' = {…}: expected flow.coupling one_way"),
      std::string::npos);
  EXPECT_NE(refusal_of(text, {"flow.out_of_range=hold"}).find("expected flow.out_of_range repeat"),
            std::string::npos);
  EXPECT_EQ(refusal_of(text, {"flow.out_of_range=hold", "flow.balls=no"}), "accepted");
  EXPECT_NE(refusal_of(text, {"flow.averages.start=1"}).find("expected 0, or not this key: with flow.steady"),
            std::string::npos);
  EXPECT_NE(refusal_of(text, {"flow.steady.hours=0"}).find("hours of wall time above 0"), std::string::npos);
  EXPECT_NE(refusal_of(text, {"flow.steady.hours=1", "flow.solver=interFoam"})
                .find("expected this key with flow.solver slurryFoam only"),
            std::string::npos);
}

TEST(Flow, more_hours_leave_a_flow_as_it_is) {
  const std::string text = bare_mill + "flow: {turns: 10, steady: {hours: 1}}\n";
  EXPECT_EQ(mill_of(text).fingerprint.flow, mill_of(text, {"flow.steady.hours=2"}).fingerprint.flow);
  EXPECT_NE(mill_of(text).fingerprint.flow, mill_of(text, {"flow.steady.turns=4"}).fingerprint.flow);
}

/// A mill with a tracer in its feed.
const std::string fed_mill = with(with(bare_mill, "ends: periodic", "ends: plain"),
                                  "lifters:", "inlet: {radius: 0.1}, grates: {sectors: 6}, lifters:") +
                             "flow: {duration: 10, feed: 1e-5, tracer: {begin: 2}}\n";

TEST(Flow, feeds_a_tracer_if_it_is_asked_for) {
  EXPECT_FALSE(mill_of(bare_mill).flow.tracer);
  const Flow flow = mill_of(fed_mill).flow;
  ASSERT_TRUE(flow.tracer);
  EXPECT_EQ(flow.tracer->begin, 2);
  EXPECT_FALSE(flow.tracer->pulse);
  EXPECT_EQ(flow.tracer->dispersion, 0);
  EXPECT_EQ(mill_of(fed_mill, {"flow.tracer.pulse=8"}).flow.tracer->pulse, 8);
  EXPECT_NE(mill_of(fed_mill).fingerprint.flow, mill_of(fed_mill, {"flow.tracer.begin=3"}).fingerprint.flow);
}

TEST(Flow, a_tracer_needs_a_feed_and_an_end_within_the_flow) {
  const auto refused = [](const std::string& set) { return refusal_of(fed_mill, {set}); };
  EXPECT_NE(refused("flow.feed=0").find("expected this key with flow.feed above 0"), std::string::npos);
  EXPECT_NE(refused("flow.solver=interFoam").find("expected this key with flow.solver slurryFoam"),
            std::string::npos);
  EXPECT_NE(refused("flow.tracer.begin=10").find("below the duration, 10 s"), std::string::npos);
  EXPECT_NE(refused("flow.tracer.pulse=8.1").find("time after flow.tracer.begin, 8 s"), std::string::npos);
  EXPECT_NE(refused("flow.tracer.dispersion=-1").find("a dispersion in m^2/s"), std::string::npos);
  EXPECT_NE(refused("flow.tracer.length=1").find("pulse"), std::string::npos);
}

TEST(Flow, change_of_the_voidage_and_air_limit_steps_of_slurryFoam_only) {
  const std::string text = bare_mill + "flow: {max_voidage_change: 0.2}\n";
  EXPECT_DOUBLE_EQ(mill_of(text).flow.max_voidage_change, 0.2);
  EXPECT_DOUBLE_EQ(mill_of(text).flow.max_air_courant, 2.5);
  EXPECT_DOUBLE_EQ(mill_of(text).flow.max_courant, 1.25);
  EXPECT_DOUBLE_EQ(mill_of(text).flow.max_surface_courant, 1.25);
  EXPECT_DOUBLE_EQ(mill_of(text, {"flow.solver=interFoam"}).flow.max_courant, 1);
  EXPECT_DOUBLE_EQ(mill_of(text, {"flow.solver=interFoam"}).flow.max_surface_courant, 0.5);
  // The solver of one call leaves the file's key out
  EXPECT_EQ(refusal_of(text, {"flow.solver=interFoam"}), "accepted");
  for (const auto& refused : {refusal_of(bare_mill + "flow: {max_air_courant: 2, solver: interFoam}\n"),
                              refusal_of(bare_mill + "flow: {max_voidage_change: 0.2, solver: interFoam}\n"),
                              refusal_of(text, {"flow.solver=interFoam", "flow.max_voidage_change=0.3"})})
    EXPECT_NE(refused.find("expected this key with flow.solver slurryFoam only"), std::string::npos)
        << refused;
}

TEST(Flow, intervals_of_a_run_are_a_millionth_of_it_or_more) {
  for (const char* key : {"dem.record_interval", "dem.contact_interval", "flow.write_interval",
                          "flow.max_time_step", "flow.averages.window", "flow.averages.interval"}) {
    const std::string refused = refusal_of(bare_mill, {std::string(key) + "=1e-12"});
    EXPECT_NE(refused.find("a time in s from "), std::string::npos) << key << ": " << refused;
  }
  EXPECT_EQ(mill_of(bare_mill).dem.contact_interval, 0);
}

TEST(Flow, feed_needs_an_inlet) {
  EXPECT_NE(refusal_of(bare_mill, {"flow.feed=1e-5"}).find("expected this key with geometry.inlet only"),
            std::string::npos);
}

TEST(Set, of_an_item_needs_its_list) {
  EXPECT_EQ(
      refusal_of(bare_mill, {"charge={fill: 0.3, diameter: 0.01}", "charge.classes[0].mass=1"}),
      "--set charge.classes[0].mass=1: the mill has no list 'charge.classes': expected an item of a list "
      "that it has, or the whole list, as in charge.classes=[…]");
  EXPECT_EQ(
      refusal_of(example_mill, {"dem.duration[0]=1"}).find("--set dem.duration[0]=1: the mill has no list"),
      0U);
}

TEST(Set, takes_the_place_of_a_key_and_is_refused_like_one) {
  EXPECT_EQ(mill_of(example_mill, {"dem.duration=4", "charge.classes[1].mass=0.01"}).charge.classes[1].mass,
            0.01);
  EXPECT_EQ(
      refusal_of(example_mill, {"dem.duration=-4"}),
      "--set dem.duration=-4: key 'dem.duration' = -4: expected a time in s above 0 and up to 100000 s");
  EXPECT_EQ(refusal_of(example_mill, {"dem.durtion=4"})
                .find("--set dem.durtion=4: key 'dem.durtion' is unknown: did you "
                      "mean 'duration'?"),
            0U);
  EXPECT_EQ(refusal_of(example_mill, {"flw.law=Hill"})
                .find("--set flw.law=Hill: key 'flw' is unknown: did you mean 'flow'?"),
            0U);
}

TEST(Set, takes_maps_and_removes_keys) {
  const Mill mill = mill_of(example_mill, {"charge={fill: 0.3, diameter: 0.005}"});
  EXPECT_EQ(mill.charge.classes.size(), 1U);
  EXPECT_EQ(mill_of(example_mill, {"geometry.slice=0.018", "geometry.slice=~"}).geometry.length, 0.024);
}

TEST(Set, of_one_alternative_takes_the_place_of_the_other) {
  EXPECT_DOUBLE_EQ(mill_of(bare_mill + "flow: {turns: 5}\n", {"flow.duration=2"}).flow.duration, 2);
  EXPECT_EQ(mill_of(example_mill, {"flow.start.fill=1"}).flow.start.level, std::nullopt);
  EXPECT_EQ(mill_of(bare_mill + "flow: {start: {fill: 1}}\n", {"slurry.level=-0.1"}).flow.start.level, -0.1);
  EXPECT_EQ(mill_of(example_mill, {"speed.angular_velocity=2"}).angular_velocity, 2);
  EXPECT_EQ(mill_of(example_mill, {"dem.largest_overlap=0.05"}).dem.youngs_modulus, 0);
  EXPECT_NE(refusal_of(bare_mill + "flow: {turns: 5, duration: 2}\n").find("either duration or turns"),
            std::string::npos);
}

TEST(Set, of_one_alternative_takes_the_place_of_the_other_in_every_section) {
  EXPECT_DOUBLE_EQ(mill_of(bare_mill + "flow: {duration: 5}\n", {"flow.turns=1"}).flow.duration,
                   mill_of(bare_mill).turn());
  const std::string inlet = with(example_mill, "speed:", "  inlet: {radius: 0.02}\nspeed:");
  EXPECT_DOUBLE_EQ(mill_of(inlet, {"geometry.inlet.area=0.001"}).geometry.inlet->radius,
                   std::sqrt(0.001 / std::acos(-1.0)));
  EXPECT_EQ(mill_of(example_mill, {"resolution.counts={gap: 11, lifter: 3, height: 5, ring: 9}"})
                .resolution.cell_size,
            0);
  EXPECT_EQ(mill_of(bare_mill + "averages: {voxel_size: 0.06}\n", {"averages.counts={across: 9, along: 2}"})
                .averages.voxels.shape,
            (std::array<int, 3>{9, 9, 2}));
  EXPECT_EQ(
      mill_of(bare_mill + "flow: {start: {volume: 0.001}}\n", {"flow.start.level=-0.1"}).flow.start.level,
      -0.1);
}

TEST(Set, of_a_fraction_of_the_critical_speed_keeps_the_sense_of_the_files_angular_velocity) {
  const std::string speed = "fraction_of_critical: 0.5\n  sense: clockwise";
  const double critical = std::sqrt(9.81 / 0.06);
  for (const double sign : {-1, 1}) {
    const std::string text = with(example_mill, speed, "angular_velocity: " + std::to_string(sign * 6.4));
    EXPECT_NEAR(mill_of(text, {"speed.rpm=60"}).angular_velocity, sign * 2 * std::acos(-1.0), 1e-14);
    EXPECT_DOUBLE_EQ(mill_of(text, {"speed.fraction_of_critical=0.7"}).angular_velocity,
                     sign * 0.7 * critical);
  }
  const std::string text = with(example_mill, speed, "angular_velocity: -6.4");
  EXPECT_DOUBLE_EQ(
      mill_of(text, {"speed.fraction_of_critical=0.7", "speed.sense=anticlockwise"}).angular_velocity,
      0.7 * critical);
}

TEST(Set, of_classes_takes_the_place_of_fill_and_diameter) {
  const Mill mill = mill_of(bare_mill, {"charge.classes=[{diameter: 0.03, mass: 5}]"});
  ASSERT_EQ(mill.charge.classes.size(), 1U);
  EXPECT_EQ(mill.charge.classes[0].diameter, 0.03);
  EXPECT_EQ(mill.charge.classes[0].mass, 5);
}

TEST(Set, of_fill_and_diameter_takes_the_place_of_classes) {
  const std::string text = with(example_mill, "  classes", "  reference_length: 0.12\n  classes");
  const Mill mill = mill_of(text, {"charge.fill=0.3", "charge.diameter=0.005"});
  ASSERT_EQ(mill.charge.classes.size(), 1U);
  EXPECT_EQ(mill.charge.classes[0].diameter, 0.005);
  EXPECT_NEAR(count_charge(mill).load, 0.3, 1e-3);
}

TEST(Set, of_fill_alone_fills_with_the_files_classes_in_their_shares) {
  const std::string text = with(example_mill, "  classes", "  reference_length: 0.12\n  classes");
  const Mill mill = mill_of(text, {"charge.fill=0.25"});
  const Charge& charge = mill.charge;
  ASSERT_EQ(charge.classes.size(), 2U);
  EXPECT_EQ(charge.classes[0].diameter, 0.008);
  EXPECT_EQ(charge.classes[1].diameter, 0.002);
  EXPECT_DOUBLE_EQ(charge.classes[1].mass / charge.classes[0].mass, 1.5);
  const double mass = charge.classes[0].mass + charge.classes[1].mass;
  EXPECT_DOUBLE_EQ(mass, 0.25 * 0.6 * 2700 * analytic_volume(mill.geometry));
  // As much with another packing
  EXPECT_DOUBLE_EQ(mill_of(text, {"charge.fill=0.25", "charge.packing=0.5"}).charge.classes[0].mass,
                   charge.classes[0].mass * 0.5 / 0.6);
}

TEST(Set, of_fill_alone_takes_masses_of_a_much_longer_mill) {
  const std::string text =
      with(with(example_mill, "  classes", "  reference_length: 12\n  classes"), "mass: ", "mass: 20");
  const Mill mill = mill_of(text, {"charge.fill=0.25"});
  double mass = 0;
  for (const SizeClass& size : mill.charge.classes) mass += size.mass;
  EXPECT_NEAR(mass / (0.25 * 0.6 * 2700 * analytic_volume(mill.geometry)), 1, 1e-12);
}

TEST(Set, of_two_alternatives_is_refused) {
  const auto refused = [](const std::string& text, const std::vector<std::string>& set,
                          const std::string& message) {
    EXPECT_NE(refusal_of(text, set).find(message), std::string::npos) << refusal_of(text, set);
  };
  refused(
      example_mill, {"charge.fill=0.3", "charge.classes=[{diameter: 0.005, mass: 0.1}]"},
      "--set charge.fill=0.3: key 'charge.fill' = 0.3: expected either classes, or fill, diameter and shape");
  refused(example_mill, {"charge.fill=0.3", "charge.classes[0].mass=0.1"},
          "'charge.fill' = 0.3: expected either classes, or fill, diameter and shape");
  refused(example_mill, {"charge.fill=0.3", "charge.reference_length=0.1"},
          "'charge.reference_length' = 0.1: expected this key with classes only");
  refused(example_mill, {"speed.angular_velocity=2", "speed.fraction_of_critical=0.5"},
          "either angular_velocity alone");
  refused(example_mill, {"speed.angular_velocity=2", "speed.sense=clockwise"},
          "either angular_velocity alone");
  refused(bare_mill, {"flow.duration=2", "flow.turns=1"}, "either duration or turns");
  refused(bare_mill, {"flow.start.level=0", "flow.start.volume=0.001"}, "either this key or level");
  refused(bare_mill, {"flow.start.fill=1", "slurry.level=0"}, "either this key or slurry.level");
  refused(example_mill, {"dem.youngs_modulus=1e7", "dem.largest_overlap=0.05"},
          "either this key or youngs_modulus");
  refused(example_mill, {"resolution.cell_size=0.003", "resolution.counts={gap: 11}"},
          "either cell_size or counts");
}

TEST(Set, leaves_two_alternatives_of_the_file_refused) {
  const std::string both = with(example_mill, "  classes", "  fill: 0.3\n  classes");
  EXPECT_NE(refusal_of(both, {"dem.seed=3"}).find("'charge.fill' = 0.3: expected either classes"),
            std::string::npos);
}

TEST(Set, says_what_it_is_when_it_is_none) {
  for (const char* change : {"flow.law", "=3", "a..b=1", "charge.classes[x].mass=1"})
    EXPECT_NE(refusal_of(example_mill, {change}).find("expected PATH=VALUE"), std::string::npos) << change;
  EXPECT_NE(refusal_of(example_mill, {"charge.classes[7].mass=1"}).find("from 0 to 1"), std::string::npos);
  EXPECT_NE(refusal_of(example_mill, {"title.a=1"}).find("holds no keys"), std::string::npos);
}

TEST(Set, of_an_item_takes_the_lists_numbers_only) {
  const std::string text =
      with(bare_mill, "{fill: 0.3, diameter: 0.025}", "{classes: [{diameter: 0.025, mass: 5}]}");
  for (const char* item : {"1", "99999999999999999999999", "0x0", "-1", "a"}) {
    const std::string refused = refusal_of(text, {"charge.classes." + std::string(item) + ".mass=1"});
    EXPECT_NE(refused.find("expected a number of the list's items, from 0 to 0"), std::string::npos)
        << refused;
  }
}

TEST(Variants, of_a_smooth_drum_have_no_cells_at_lifters) {
  const std::string text = bare_mill +
                           "resolution: {counts: {gap: 7, lifter: 1, height: 2, ring: 5}}\n"
                           "variants: {smooth: {geometry.lifters.count: 0, resolution.counts.gap: 48}}\n";
  EXPECT_EQ(refusal_of(text), "accepted");
  EXPECT_EQ(mill_of(text, {"variant=smooth"}).resolution.counts->lifter, 0);
  EXPECT_NE(refusal_of(text, {"variant=smooth", "resolution.counts.height=2"})
                .find("expected this key with geometry.lifters.count above 0 only"),
            std::string::npos);
  for (const std::vector<std::string>& set : {std::vector<std::string>{
           "geometry.lifters.count=0", "resolution.counts={gap: 48, lifter: 9, height: 2, ring: 5}"}})
    EXPECT_NE(refusal_of(text, set).find("'resolution.counts.lifter' = 9: expected this key with"),
              std::string::npos);
  const std::string smooth = with(text, "count: 12", "count: 0");
  EXPECT_NE(refusal_of(smooth).find("'resolution.counts.lifter' = 1: expected this key with"),
            std::string::npos);
}

const std::string mill_with_variants = bare_mill + R"(flow: {duration: 2}
variants:
  slow: {speed.fraction_of_critical: 0.5, flow.duration: 3}
  thick:
    slurry.plastic_viscosity: 0.1
    slurry.yield_stress: 5
)";

TEST(Variants, change_keys_as_if_they_stood_in_the_file) {
  EXPECT_DOUBLE_EQ(mill_of(mill_with_variants).slurry.yield_stress, 1);
  const Mill mill = mill_of(mill_with_variants, {"variant=slow", "variant=thick"});
  EXPECT_DOUBLE_EQ(mill.flow.duration, 3);
  EXPECT_DOUBLE_EQ(mill.slurry.plastic_viscosity, 0.1);
  EXPECT_NEAR(mill.angular_velocity / critical_speed(mill.geometry), 0.5, 1e-12);
  // Other changes come after all of them, and take the place of alternatives
  EXPECT_DOUBLE_EQ(mill_of(mill_with_variants, {"flow.duration=4", "variant=slow"}).flow.duration, 4);
  const Mill turns = mill_of(mill_with_variants, {"variant=slow", "flow.turns=2"});
  EXPECT_DOUBLE_EQ(turns.flow.duration, 2 * turns.turn());
}

TEST(Variants, are_refused_by_line_and_name) {
  EXPECT_NE(refusal_of(mill_with_variants, {"variant=fast"}).find("expected one of slow, thick"),
            std::string::npos);
  EXPECT_NE(refusal_of(bare_mill, {"variant=fast"}).find("has no variants"), std::string::npos);
  const std::string list = bare_mill + "variants:\n  slow: [1, 2]\n";
  EXPECT_EQ(refusal_of(list, {"variant=slow"}).rfind("mill.yaml:7: key 'variants.slow': expected a map", 0),
            0U);
  const std::string wrong = bare_mill + "variants:\n  slow:\n    flow.law: Stokes\n";
  EXPECT_EQ(refusal_of(wrong, {"variant=slow"}).rfind("mill.yaml:8: key 'flow.law' = Stokes", 0), 0U)
      << refusal_of(wrong, {"variant=slow"});
  EXPECT_EQ(refusal_of(wrong), "accepted");
}

TEST(Variants, have_paths_of_keys_also_where_they_are_not_used) {
  const auto refused = [](const std::string& variant) {
    return refusal_of(bare_mill + "variants:\n  slow: {flow.turns: 2}\n  other: {" + variant + "}\n");
  };
  EXPECT_EQ(refused("flow.law: Hill"), "accepted");
  EXPECT_EQ(refused("flow.lwa: Hill").rfind("mill.yaml:8: key 'flow.lwa' is unknown: did you mean 'law'?", 0),
            0U)
      << refused("flow.lwa: Hill");
  EXPECT_EQ(refused("flow: {lwa: Hill}").rfind("mill.yaml:8: key 'flow.lwa' is unknown", 0), 0U);
  EXPECT_EQ(refused("flwo.law: Hill").rfind("mill.yaml:8: key 'flwo' is unknown: did you mean 'flow'?", 0),
            0U);
  EXPECT_NE(refused("flow..law: Hill").find("expected a path, as in flow.law"), std::string::npos);
  EXPECT_NE(refused("variants.slow.flow.turns: 3").find("expected a path"), std::string::npos);
  // Changes of the call hold for the variants, too
  const std::string old = bare_mill + "averaging: {start: 1}\nvariants:\n  slow: {flow.turns: 2}\n";
  EXPECT_NE(refusal_of(old).find("key 'averaging' is unknown"), std::string::npos);
  EXPECT_EQ(refusal_of(old, {"averaging=~"}), "accepted");
  EXPECT_EQ(refusal_of(old, {"variant=slow", "averaging=~"}), "accepted");
  // Values may go with other changes
  EXPECT_EQ(refused("flow.averages.start: 1e4"), "accepted");
}

TEST(Variants, are_among_the_known_sections) {
  EXPECT_NE(refusal_of(bare_mill + "variant: {slow: {flow.turns: 2}}\n").find("did you mean 'variants'?"),
            std::string::npos);
  EXPECT_NE(refusal_of(bare_mill, {"variants.slow.flow.turns=2"}).find("as in variant=slow"),
            std::string::npos);
}

TEST(Variants, are_refused_where_they_say_two_things) {
  const auto refused = [](const std::string& variants) { return refusal_of(bare_mill + variants); };
  EXPECT_EQ(refused("variants:\n  slow: {flow.law: Hill, flow.law: Beetstra}\n")
                .rfind("mill.yaml:7: key 'variants.slow.flow.law' is given twice", 0),
            0U);
  EXPECT_EQ(refused("variants:\n  a: {flow.law: Hill}\n  a: {flow.law: Beetstra}\n")
                .rfind("mill.yaml:8: key 'variants.a' is given twice", 0),
            0U);
  EXPECT_NE(refused("variants: [a]\n").find("key 'variants': expected a map of variants"), std::string::npos);
  EXPECT_NE(refused("variants:\n").find("key 'variants': expected a map of variants"), std::string::npos);
}

TEST(Aliases, are_values_of_their_own) {
  const std::string alike =
      with(with(example_mill, "ball_ball: {", "ball_ball: &pair {"),
           "ball_wall: {restitution: 0.703, friction: 0.287, rolling_friction: 0.02}", "ball_wall: *pair");
  EXPECT_EQ(mill_of(alike).ball_wall.friction, 0.94);
  const Mill mill = mill_of(alike, {"materials.ball_ball.friction=0.1"});
  EXPECT_EQ(mill.ball_ball.friction, 0.1);
  EXPECT_EQ(mill.ball_wall.friction, 0.94);
  const std::string number =
      with(with(example_mill, "height: 0.008", "height: &size 0.008"), "diameter: 0.008", "diameter: *size");
  EXPECT_EQ(mill_of(number, {"geometry.lifters.height=0.007"}).charge.classes.front().diameter, 0.008);
}

TEST(Aliases, of_balls_fill_the_mill_as_other_balls_do) {
  const std::string classes = "- {diameter: 0.008, mass: 0.02}\n    - {diameter: 0.002, mass: 0.03}";
  const auto fill = [&](const std::string& two) {
    double mass = 0;
    for (const SizeClass& size :
         mill_of(with(example_mill, classes, two), {"charge.fill=0.3"}).charge.classes)
      mass += size.mass;
    return mass;
  };
  EXPECT_DOUBLE_EQ(fill("- &ball {diameter: 0.008, mass: 0.02}\n    - *ball"),
                   fill("- {diameter: 0.008, mass: 0.02}\n    - {diameter: 0.008, mass: 0.02}"));
}

TEST(Aliases, that_contain_themselves_or_grow_without_end_are_refused) {
  EXPECT_NE(refusal_of("title: &a {b: *a}\n" + bare_mill).find("aliases (*NAME) are written out"),
            std::string::npos);
  std::string bomb = "title: &a0 [1, 1]\n";
  for (int i = 1; i < 40; ++i)
    bomb += "t" + std::to_string(i) + ": &a" + std::to_string(i) + " [*a" + std::to_string(i - 1) + ", *a" +
            std::to_string(i - 1) + "]\n";
  EXPECT_NE(refusal_of(bomb + bare_mill).find("more than 100000 values"), std::string::npos);
}

TEST(Numbers, with_a_comma_in_a_map_of_one_line_are_told) {
  EXPECT_NE(
      refusal_of(with(bare_mill, "0.025", "0,025")).find("key 'charge.025' is unknown: a decimal comma?"),
      std::string::npos);
}

TEST(Numbers, that_are_whole_may_have_a_point) {
  const Mill mill = mill_of(example_mill, {"geometry.lifters.count=12.0", "dem.seed=2.0121e4"});
  EXPECT_EQ(mill.geometry.lifters.count, 12);
  EXPECT_EQ(mill.fingerprint.flow, mill_of(example_mill).fingerprint.flow);
  for (const char* wrong : {"12.5", "1e300", ".nan", ".inf", "'12.0'", "3e9"})
    EXPECT_NE(refusal_of(example_mill, {std::string("geometry.lifters.count=") + wrong})
                  .find("expected a whole number of lifters from 0 to 1000"),
              std::string::npos)
        << wrong;
}

TEST(Materials, in_other_units_are_refused) {
  EXPECT_NE(refusal_of(example_mill, {"slurry.density=1.24"}).find("a density in kg/m^3 from 100 to 23000"),
            std::string::npos);
  EXPECT_NE(refusal_of(example_mill, {"materials.ball.density=2.7"}).find("from 100 to 23000"),
            std::string::npos);
  EXPECT_NE(refusal_of(example_mill, {"materials.ball.youngs_modulus=65"}).find("from 100000 to 2e+12"),
            std::string::npos);
}

TEST(Encoding, is_named_when_it_is_not_utf8) {
  EXPECT_NE(refusal_of("title: M\xFChle\n" + bare_mill)
                .find("mill.yaml:1: byte 0xFC is not UTF-8, as in a text in Latin-1"),
            std::string::npos);
  EXPECT_NE(refusal_of(std::string("\xFF\xFEt\0i\0", 6)).find("is in UTF-16"), std::string::npos);
  EXPECT_NE(refusal_of(std::string("t\0i\0", 4)).find("is in UTF-16"), std::string::npos);
  EXPECT_EQ(mill_of("\xEF\xBB\xBFtitle: Mühle\n" + bare_mill).title, "Mühle");
}

TEST(Encoding, tabs_before_keys_are_named) {
  EXPECT_EQ(refusal_of("speed:\n\tsense: clockwise\n").find("mill.yaml:2: a tab before the key"), 0U);
}

TEST(Encoding, tabs_in_blank_lines_and_before_comments_are_allowed) {
  for (const char* line : {"\t\n", "  \t\r\n", "\t# comment\n", " \t # a:\tb\n"})
    EXPECT_EQ(mill_of(with(example_mill, "  length", line + std::string("  length"))).geometry.length, 0.024);
  EXPECT_EQ(refusal_of(example_mill + "\t"), "accepted");
  EXPECT_EQ(refusal_of(example_mill + "\t# end"), "accepted");
}

TEST(Lengths, in_millimetres_are_refused) {
  EXPECT_NE(refusal_of(example_mill, {"geometry.diameter=120"}).find("up to 50 m"), std::string::npos);
  EXPECT_NE(refusal_of(example_mill, {"geometry.diameter=1e300"}).find("up to 50 m"), std::string::npos);
  EXPECT_NE(refusal_of(example_mill, {"dem.duration=1e12"}).find("up to 100000 s"), std::string::npos);
}

/// The paths of all numbers of a resolved mill's keys, and whether each is a whole one.
std::vector<std::pair<std::string, bool>> numbers_of(const nlohmann::ordered_json& keys) {
  std::vector<std::pair<std::string, bool>> paths;
  const nlohmann::ordered_json flat = keys.flatten();
  for (const auto& [pointer, value] : flat.items()) {
    if (!value.is_number()) continue;
    std::string path;
    std::istringstream names(pointer.substr(1));
    for (std::string name; std::getline(names, name, '/');) {
      const bool item = name.find_first_not_of("0123456789") == std::string::npos;
      path += item ? "[" + name + "]" : (path.empty() ? "" : ".") + name;
    }
    paths.emplace_back(path, value.is_number_integer());
  }
  return paths;
}

TEST(Numbers, are_bounded_each_by_something_that_a_mill_can_have) {
  const std::string whole = with(with(with(example_mill, "speed:", R"(  inlet: {radius: 0.02}
  grates: {inner_radius: 0.03, outer_radius: 0.045, sectors: 6}
  pulp_lifters: {depth: 0.01, layers: 2, discharge_radius: 0.02}
speed:)"),
                                      "  classes", "  reference_length: 0.024\n  classes"),
                                 "  level: -0.012\n", "");
  const std::string smooth = with(with(bare_mill, "count: 12", "count: 0"), "ends: periodic", "ends: plain");
  const std::vector<std::pair<std::string, std::vector<std::string>>> mills{
      {whole, {"flow.start={volume: 1e-5}", "flow.duration=1", "geometry.slice=0.02"}},
      {whole, {"geometry.inlet={area: 0.001}", "speed={angular_velocity: 3}", "dem={youngs_modulus: 1e7}"}},
      {bare_mill, {"averages={counts: {across: 9, along: 2}}", "flow.start={level: -0.1}", "flow.turns=1"}},
      {smooth, {"resolution={counts: {gap: 48, ring: 9}}", "flow.averages={counts: {across: 9, along: 2}}"}},
      {example_mill, {"resolution={counts: {gap: 11, lifter: 3, height: 5, ring: 9}}"}},
      {fed_mill, {"flow.tracer.pulse=1", "flow.tracer.dispersion=1e-5"}}};
  std::set<std::string> tried;
  for (const auto& [text, set] : mills) {
    const MillDescription mill = describe(text, set);
    for (const auto& [path, is_whole] : numbers_of(mill.document->keys())) {
      for (const std::string& value : is_whole ? std::vector<std::string>{"2000000000", "-2000000000"}
                                               : std::vector<std::string>{"1e300", "-1e300"}) {
        std::vector<std::string> changed = set;
        changed.push_back(path + "=" + value);
        const std::string message = refusal_of(text, changed);
        const std::string start =
            "--set " + changed.back() + ": key '" + path + "' = " + value + ": expected ";
        EXPECT_EQ(message.rfind(start, 0), 0U) << path << " = " << value << ": " << message;
      }
      tried.insert(path);
    }
  }
  EXPECT_GT(tried.size(), 60U);
}

TEST(Charge, packing_is_that_of_bulk_and_pores) {
  const ChargeNumbers dense = count_charge(mill_of(bare_mill, {"charge.packing=0.55"}));
  EXPECT_NEAR(dense.load, 0.3, 0.005);
  EXPECT_DOUBLE_EQ(dense.pore_volume, dense.volume * 0.45 / 0.55);
  const std::string classes = with(bare_mill, "{fill: 0.3, diameter: 0.025}",
                                   "{packing: 0.5, classes: [{diameter: 0.025, mass: 5}]}");
  const ChargeNumbers loose = count_charge(mill_of(classes));
  EXPECT_DOUBLE_EQ(loose.pore_volume, loose.volume);
}

TEST(Charge, of_a_fill_in_percent_is_refused_with_an_example) {
  EXPECT_EQ(refusal_of(bare_mill, {"charge.fill=30"}),
            "--set charge.fill=30: key 'charge.fill' = 30: expected a share of the mill's volume above 0 and "
            "below 1, 0.3 for 30 % (or the key classes)");
}

TEST(Charge, has_a_ball_of_each_class_that_is_computed) {
  const std::string whole =
      with(example_mill, "    - {diameter: 0.002, mass: 0.03}\n", "    - {diameter: 0.006, number: 1}\n");
  EXPECT_EQ(refusal_of(whole), "accepted");
  // 2700 pi/6 0.006^3 = 3.05363e-04 kg, of which a slice of 16 mm has two thirds, of 24 mm from 72 a third
  EXPECT_EQ(refusal_of(whole, {"geometry.slice=0.016"}), "accepted");
  const std::string third = with(whole, "length: 0.024", "length: 0.072");
  EXPECT_EQ(
      refusal_of(third, {"geometry.slice=0.024"}),
      "mill.yaml:16: key 'charge.classes[1]' = 0.000101788 kg of balls of 0.006 m in this mill, which "
      "rounds to 0 balls: expected at least half of one ball's mass, 0.000305363 kg: raise the mass, or "
      "leave the class out (small ones by charge.fines_below)");
  EXPECT_EQ(refusal_of(third, {"geometry.slice=0.024", "charge.fines_below=0.007"}), "accepted");
  EXPECT_EQ(refusal_of(third, {"geometry.slice=0.024", "flow.balls=no"}), "accepted");
  EXPECT_EQ(refusal_of(bare_mill, {"charge.fill=1e-6"}).rfind("mill.yaml:3: key 'charge' = ", 0), 0U);
}

TEST(Charge, counts_whole_balls_and_names_fines) {
  const ChargeNumbers charge = count_charge(mill_of(example_mill, {"charge.fines_below=0.003"}));
  ASSERT_EQ(charge.classes.size(), 2U);
  EXPECT_EQ(charge.classes[0].count, std::lround(0.02 / (2700 * std::acos(-1.0) / 6 * std::pow(0.008, 3))));
  EXPECT_FALSE(charge.classes[1].simulated);
  EXPECT_EQ(charge.balls, charge.classes[0].count);
  EXPECT_EQ(charge.fines_mass, 0.03);
  EXPECT_EQ(charge.sauter_diameter, 0.008);
  EXPECT_GT(charge.load_asked, 2 * charge.load);
}

}  // namespace
}  // namespace millfoam::meshing
