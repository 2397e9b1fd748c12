// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/mill/resolved_mill.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "meshing/mill/mill_document.hpp"
#include "tests/meshing/test_mill.hpp"

namespace millfoam::meshing {
namespace {

using Json = nlohmann::ordered_json;

TEST(ResolvedMill, is_read_again_as_the_same_mill) {
  const std::string fill = with(example_mill, R"(  classes:
    - {diameter: 0.008, mass: 0.02}
    - {diameter: 0.002, mass: 0.03}
)",
                                "  fill: 0.3\n  diameter: 0.005\n");
  // Their masses take the place of their numbers
  const std::string superquadrics = with(
      fill, "  fill: 0.3\n  diameter: 0.005\n",
      "  classes:\n    - {diameter: 0.005, number: 300, shape: {half_axes: [3, 2, 2], blockiness: 3}}\n");
  for (const auto& [text, set] : std::vector<std::pair<std::string, std::vector<std::string>>>{
           {example_mill, {}},
           {example_mill, {"geometry.slice=0.018", "flow.turns=2", "flow.law=Hill"}},
           {with(example_mill, "  level: -0.012\n", ""),
            {"flow.start.fill=0.7", "averages.counts={across: 9, along: 2}"}},
           {example_mill, {"charge.fill=0.25", "speed.angular_velocity=3", "flow.duration=1"}},
           {with(example_mill, "fraction_of_critical: 0.5\n  sense: clockwise", "angular_velocity: -6.4"),
            {"speed.fraction_of_critical=0.6", "geometry.slice=0.018"}},
           {fill,
            {"flow.balls=no", "geometry.inlet={radius: 0.02}", "geometry.grates={sectors: 6}",
             "flow.feed=1e-5"}},
           {superquadrics, {"charge.fill=0.2"}}}) {
    const TemporaryFolder folder;
    const MillDescription first = describe(text, set);
    const MillDescription again =
        describe_mill(folder.write("mill.json", resolved_mill(first, "test").dump(2)));
    const Json one = resolved_mill(first, "test");
    const Json two = resolved_mill(again, "test");
    EXPECT_EQ(one["mill"], two["mill"]);
    EXPECT_EQ(one["derived"], two["derived"]);
    for (const char* key : {"fingerprint", "file", "file_fingerprint", "set", "lines"})
      EXPECT_EQ(one[key], two[key]) << key;
  }
}

TEST(ResolvedMill, holds_every_key_with_its_default) {
  const Json mill = resolved_mill(describe(example_mill), "test")["mill"];
  EXPECT_EQ(mill["slurry"]["surface_tension"], 0.07);
  EXPECT_EQ(mill["averages"]["start"], "steady");
  EXPECT_EQ(mill["flow"]["law"], "Beetstra");
  EXPECT_EQ(mill["air"]["density"], 1.2);
  EXPECT_EQ(mill["charge"]["classes"][1]["diameter"], 0.002);
}

TEST(ResolvedMill, of_a_changed_resolved_mill_says_where_the_change_is_wrong) {
  const TemporaryFolder folder;
  const auto file = folder.write("mill.json", resolved_mill(describe(example_mill), "test").dump(2));
  EXPECT_EQ(describe_mill(file, {"flow.law=Hill"}).mill.flow.law, "Hill");
  EXPECT_THROW(describe_mill(file, {"flow.law=Stokes"}), MillError);
}

TEST(Fingerprints, change_with_what_a_stage_depends_on_alone) {
  const MillFingerprints mill = describe(example_mill).mill.fingerprint;
  const auto changed = [](const std::string& change) {
    return describe(example_mill, {change}).mill.fingerprint;
  };
  EXPECT_EQ(changed("title=another").flow, mill.flow);
  EXPECT_EQ(changed("flow.law=Hill").averages, mill.averages);
  EXPECT_EQ(changed("flow.coupling=iterated").flow, mill.flow);
  EXPECT_EQ(changed("flow.passes=3").flow, mill.flow);
  EXPECT_NE(changed("flow.law=Hill").flow, mill.flow);
  EXPECT_EQ(changed("slurry.viscosity_ratio=1000").flow, mill.flow);
  EXPECT_NE(changed("slurry.viscosity_ratio=2000").flow, mill.flow);
  EXPECT_EQ(changed("slurry.viscosity_ratio=2000").averages, mill.averages);
  EXPECT_EQ(changed("resolution.layers=4").walls, mill.walls);
  EXPECT_EQ(changed("resolution.last_layer=0.002").walls, mill.walls);
  EXPECT_NE(changed("resolution.last_layer=0.002").flow, mill.flow);
  EXPECT_NE(changed("resolution.cell_size=0.004").walls, mill.walls);
  EXPECT_EQ(changed("averages.window=0.1").charge, mill.charge);
  EXPECT_NE(changed("averages.window=0.1").averages, mill.averages);
  EXPECT_EQ(changed("speed.fraction_of_critical=0.6").walls, mill.walls);
  EXPECT_NE(changed("speed.fraction_of_critical=0.6").charge, mill.charge);
  EXPECT_EQ(changed("dem.contact_statistics=true").charge, mill.charge);
  EXPECT_EQ(changed("dem.contact_statistics=true").averages, mill.averages);
  // When averages are made, and whether balls are dumped, changes no result
  for (const char* key : {"averages.live=yes", "dem.dumps=no"}) {
    EXPECT_EQ(changed(key).charge, mill.charge);
    EXPECT_EQ(changed(key).averages, mill.averages);
    EXPECT_EQ(changed(key).flow, mill.flow);
  }
  // A longer dry run is resumed, but its averages are others
  EXPECT_EQ(changed("dem.duration=3").charge, mill.charge);
  EXPECT_NE(changed("dem.duration=3").averages, mill.averages);
}

TEST(Fingerprints, of_walls_and_charge_do_not_know_core_and_ring) {
  const auto with_counts = [](const std::string& counts) {
    return describe(example_mill, {"geometry.inlet.radius=0.02", "resolution={counts: {" + counts + "}}"})
        .mill.fingerprint;
  };
  const MillFingerprints usual = with_counts("gap: 11, lifter: 3, height: 5, ring: 9");
  for (const char* other : {"ring: 9, core: 21", "ring: 12"}) {
    const MillFingerprints mill = with_counts("gap: 11, lifter: 3, height: 5, " + std::string(other));
    EXPECT_EQ(mill.walls, usual.walls) << other;
    EXPECT_EQ(mill.charge, usual.charge) << other;
    EXPECT_EQ(mill.averages, usual.averages) << other;
    EXPECT_NE(mill.flow, usual.flow) << other;
  }
  EXPECT_NE(with_counts("gap: 11, lifter: 3, height: 6, ring: 9").walls, usual.walls);
  // The default, written out
  EXPECT_EQ(with_counts("gap: 11, lifter: 3, height: 5, ring: 9, core: 42").flow, usual.flow);
}

TEST(ResolvedMill, has_no_size_of_cells_that_are_counted) {
  const auto cell_size = [](const std::string& resolution) {
    return resolved_mill(describe(example_mill, {"resolution=" + resolution}),
                         "test")["derived"]["resolution"]["cell_size_m"];
  };
  EXPECT_EQ(cell_size("{cell_size: 0.004}"), 0.004);
  EXPECT_TRUE(cell_size("{counts: {gap: 11, lifter: 3, height: 5, ring: 9}}").is_null());
}

TEST(ResolvedMill, has_the_last_layers_thickness) {
  const auto last_layer = [](const std::vector<std::string>& changes) {
    return resolved_mill(describe(example_mill, changes), "test")["derived"]["resolution"]["last_layer_m"]
        .get<double>();
  };
  EXPECT_DOUBLE_EQ(last_layer({}), 0.024 / 8);
  EXPECT_EQ(last_layer({"resolution.last_layer=0.002"}), 0.002);
  EXPECT_DOUBLE_EQ(last_layer({"resolution.last_layer=0.002", "geometry.slice=0.018"}), 0.018 / 6);
}

TEST(Fingerprints, of_walls_and_charge_do_not_know_the_layers_of_the_pulp_lifters) {
  const auto with_layers = [](const std::string& layers) {
    return describe(example_mill, {"geometry.grates.sectors=6", "geometry.pulp_lifters.layers=" + layers})
        .mill.fingerprint;
  };
  const MillFingerprints two = with_layers("2");
  const MillFingerprints three = with_layers("3");
  EXPECT_EQ(three.walls, two.walls);
  EXPECT_EQ(three.charge, two.charge);
  EXPECT_EQ(three.averages, two.averages);
  EXPECT_NE(three.flow, two.flow);
}

TEST(Fingerprints, know_the_pool_of_a_run_with_buoyancy_and_nothing_of_one_without) {
  const auto charge = [](const std::vector<std::string>& set) {
    return describe(example_mill, set).mill.fingerprint.charge;
  };
  const std::string dry = charge({});
  EXPECT_EQ(charge({"dem.fluid=none"}), dry);
  EXPECT_EQ(charge({"slurry.density=1100"}), dry);
  const std::string wet = charge({"dem.fluid=buoyancy", "dem.fluid_level=-0.01"});
  EXPECT_NE(wet, dry);
  EXPECT_NE(charge({"dem.fluid=buoyancy", "dem.fluid_level=-0.02"}), wet);
  EXPECT_NE(charge({"dem.fluid=buoyancy", "dem.fluid_level=-0.01", "slurry.density=1100"}), wet);
}

TEST(Fingerprints, are_of_the_materials_numbers_by_whatever_name) {
  const auto of = [](const std::vector<std::string>& set) {
    return describe(example_mill, set).mill.fingerprint.charge;
  };
  const std::string named = of({"materials={ball: glass, wall: HDPE}"});
  EXPECT_EQ(of({"materials={ball: glass, wall: HDPE, ball_ball: glass-glass, ball_wall: glass-HDPE}"}),
            named);
  EXPECT_EQ(of({"materials={ball: glass, wall: {density: 950, youngs_modulus: 1e9, poisson_ratio: 0.42}}",
                "materials.ball_wall=glass-HDPE"}),
            named);
  EXPECT_NE(of({"materials={ball: glass, wall: nylon}"}), named);
}

TEST(Place, of_a_resolved_mill_is_that_in_its_source) {
  const TemporaryFolder folder;
  const MillDescription first = describe(example_mill, {"dem.seed=7"});
  const MillDescription again =
      describe_mill(folder.write("mill.json", resolved_mill(first, "test").dump(2)), {"flow.law=Hill"});
  for (const char* key : {"dem.duration", "dem.seed", "dem.contact_interval", "charge.classes[1]"})
    EXPECT_EQ(again.document->place(key), first.document->place(key)) << key;
  EXPECT_EQ(again.document->place("flow.law"), "--set flow.law=Hill");
}

TEST(Place, of_a_key_is_its_line_its_change_or_the_section_around_it) {
  const MillDescription mill = describe(example_mill, {"dem.seed=7"});
  const std::string file = mill.document->file();
  EXPECT_EQ(mill.document->place("dem.duration"), file + ":26");
  EXPECT_EQ(mill.document->place("dem.seed"), "--set dem.seed=7");
  EXPECT_EQ(mill.document->place("dem.contact_interval"), file + ":22");
  EXPECT_EQ(mill.document->place("charge.classes[1]"), file + ":16");
  const MillDescription map = describe(example_mill, {"dem={duration: 2}"});
  EXPECT_EQ(map.document->place("dem.duration"), "--set dem={duration: 2}");
}

}  // namespace
}  // namespace millfoam::meshing
