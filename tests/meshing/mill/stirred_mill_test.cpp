// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/meshing/stirred_mill.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "meshing/mill/mill_charge.hpp"
#include "meshing/mill/mill_shape.hpp"
#include "meshing/mill/resolved_mill.hpp"
#include "meshing/mill/stirred_geometry.hpp"
#include "meshing/surface/pi.hpp"
#include "tests/meshing/test_mill.hpp"

namespace millfoam::meshing {
namespace {

using Json = nlohmann::ordered_json;

Mill read(const std::string& text, const std::vector<std::string>& set = {}) {
  return describe(text, set).mill;
}

TEST(StirredMill, turns_its_impeller_in_a_shell_at_rest) {
  const Mill mill = read(stirred_mill);
  EXPECT_EQ(mill.machine(), Machine::stirred);
  EXPECT_EQ(read(example_mill).machine(), Machine::tumbling);
  EXPECT_DOUBLE_EQ(mill.angular_velocity, 31.416);
  EXPECT_DOUBLE_EQ(impeller_radius(*mill.geometry.impeller), 0.0705);
  EXPECT_DOUBLE_EQ(impeller_top(*mill.geometry.impeller), 0.0775);
  // Corners of the pins' flat ends, 15 mm wide, are further out than their centres
  EXPECT_NEAR(impeller_gap(mill.geometry), 0.0775 - std::sqrt(0.0705 * 0.0705 + 0.0075 * 0.0075), 1e-15);
}

TEST(StirredMill, speed_of_the_tips_is_that_of_the_pins) {
  const std::string tips =
      with(stirred_mill, "{angular_velocity: 31.416}", "{tip_speed: 1.846, sense: clockwise}");
  EXPECT_NEAR(read(tips).angular_velocity, -1.846 / 0.0705, 1e-12);
  EXPECT_NEAR(read(stirred_mill, {"speed.tip_speed=1.477"}).angular_velocity, 20.95, 0.01);
  const std::string clockwise = with(stirred_mill, "31.416", "-31.416");
  EXPECT_NEAR(read(clockwise, {"speed.tip_speed=1.477"}).angular_velocity, -20.95, 0.01);
}

TEST(StirredMill, turns_so_many_times_a_minute) {
  const std::string clockwise = with(stirred_mill, "31.416", "-31.416");
  EXPECT_NEAR(read(clockwise, {"speed.rpm=300"}).angular_velocity, -10 * pi, 1e-12);
  EXPECT_NEAR(read(stirred_mill, {"speed={rpm: 300}"}).angular_velocity, 10 * pi, 1e-12);
  EXPECT_NEAR(read(stirred_mill, {"speed={rpm: 300, sense: clockwise}"}).angular_velocity, -10 * pi, 1e-12);
  EXPECT_TRUE(says(refusal(stirred_mill, {"speed={rpm: 300, tip_speed: 1}"}),
                   "key 'speed.rpm' = 300: expected either this key or tip_speed"));
}

// Volumes of balls: half of the space up to the highest pin. Published numbers of balls of 5 mm
TEST(StirredMill, balls_of_the_published_mills) {
  struct Published {
    double diameter, tip_to_tip;
    long balls;
    double slurry;  // m^3
  };
  for (const auto& [diameter, length, balls, slurry] :
       {Published{0.155, 0.141, 10639, 696e-6}, Published{0.203, 0.185, 18512, 1212e-6},
        Published{0.256, 0.233, 29694, 1944e-6}}) {
    const Mill mill =
        read(stirred_mill, {"geometry.diameter=" + std::to_string(diameter),
                            "geometry.impeller.pins[0].length=" + std::to_string(length),
                            "geometry.impeller.pins[1].length=" + std::to_string(length),
                            "slurry={density: 1379, plastic_viscosity: 0.0022, yield_stress: 0, "
                            "level: 0.0775}"});
    EXPECT_NEAR(mill.flow.start.volume / slurry, 1, 1e-3);
    const ChargeNumbers charge = count_charge(mill);
    EXPECT_NEAR(static_cast<double>(charge.balls) / static_cast<double>(balls), 1, 1e-3);
    EXPECT_NEAR(charge.volume / slurry, 1, 1e-3);
  }
}

TEST(StirredMill, slurry_below_the_top_of_the_balls_fills_their_pores) {
  const auto volume = [](double level) {
    return read(stirred_mill, {"slurry={density: 1379, plastic_viscosity: 0.0022, yield_stress: 0, level: " +
                               std::to_string(level) + "}"})
        .flow.start.volume;
  };
  const Mill mill = read(stirred_mill);
  const auto space = [&](double level) {
    return analytic_section(mill.geometry) * level - impeller_volume(mill.geometry, level);
  };
  for (const double level : {0.03, 0.05}) EXPECT_NEAR(volume(level) / ((1 - 0.6) * space(level)), 1, 1e-9);
  EXPECT_NEAR(volume(0.07) / (space(0.07) - count_charge(mill).volume), 1, 1e-9);
}

TEST(StirredMill, impeller_has_the_volume_of_crossing_cylinders) {
  const Geometry geometry = read(stirred_mill).geometry;
  const double r = 0.0125, half = 0.0075;
  // Two crossing cylinders share 8 times the integral of sqrt((half^2 - x^2)(r^2 - x^2)) from 0 to half
  double common = 0;
  constexpr int steps = 200000;
  for (int i = 0; i < steps; ++i) {
    const double x = half * (i + 0.5) / steps;
    common += 8 * std::sqrt((half * half - x * x) * (r * r - x * x)) * half / steps;
  }
  const double pins = 2 * (pi * half * half * 0.141 - common);
  const double shaft = pi * r * r;
  EXPECT_NEAR(impeller_volume(geometry, 0.315) / (shaft * 0.295 + pins), 1, 1e-7);
  EXPECT_NEAR(impeller_volume(geometry, 0.0775) / (shaft * 0.0575 + pins), 1, 1e-7);
  EXPECT_NEAR(impeller_volume(geometry, 0.0304) / (shaft * 0.0104 + pins / 4), 1, 1e-7);
  EXPECT_EQ(impeller_volume(geometry, 0.02), 0);
  EXPECT_NEAR(analytic_volume(geometry), pi * 0.0775 * 0.0775 * 0.315 - impeller_volume(geometry, 0.315),
              1e-15);
}

TEST(StirredMill, discs_have_the_volume_of_rings_on_the_shaft) {
  const Geometry geometry = read(stirred_mill, {disc_impeller}).geometry;
  const Geometry pins = read(stirred_mill, {disc_impeller, "geometry.impeller.discs=~"}).geometry;
  const double r2 = 0.0125 * 0.0125, upper = pi * (0.06 * 0.06 - r2), lower = pi * (0.071 * 0.071 - r2);
  const auto discs_below = [&](double z) { return impeller_volume(geometry, z) - impeller_volume(pins, z); };
  EXPECT_EQ(discs_below(0.020), 0);
  EXPECT_NEAR(discs_below(0.022) / (0.002 * lower), 1, 1e-12);
  EXPECT_NEAR(discs_below(0.030) / (0.006 * lower), 1, 1e-12);
  EXPECT_NEAR(discs_below(0.315) / (0.006 * lower + 0.008 * upper), 1, 1e-12);
  EXPECT_DOUBLE_EQ(impeller_radius(*geometry.impeller), 0.071);
  EXPECT_DOUBLE_EQ(impeller_top(*geometry.impeller), 0.0775);
  const Geometry no_pins = read(stirred_mill, {disc_impeller, "geometry.impeller.pins=~"}).geometry;
  EXPECT_DOUBLE_EQ(impeller_top(*no_pins.impeller), 0.049);
}

TEST(StirredMill, discs_that_hit_something_are_refused) {
  const auto disc = [](const std::string& height, const std::string& diameter = "0.14") {
    return refusal(stirred_mill, {"geometry.impeller.discs=[{height: 0.12, diameter: 0.14, thickness: 0.01}, "
                                  "{height: " +
                                  height + ", diameter: " + diameter + ", thickness: 0.01}]"});
  };
  EXPECT_EQ(disc("0.05"), "");
  EXPECT_TRUE(says(disc("0.075"),
                   "key 'geometry.impeller.discs[1].height' = 0.075: expected a height at which "
                   "this disc, from 0.07 to 0.08 m, is 0.00025 m or more away from the pins from "
                   "0.0625 to 0.0775 m"));
  EXPECT_TRUE(says(disc("0.129"), "away from the disc from 0.115 to 0.125 m"));
  // They touch
  EXPECT_TRUE(says(disc("0.130"), "away from the disc"));
  EXPECT_TRUE(says(disc("0.0825"), "away from the pins"));
  EXPECT_TRUE(says(disc("0.02"), "0.025 m for a disc at the shaft's end, or from 0.02525 to 0.30975 m"));
  EXPECT_TRUE(says(disc("0.312"), "below the lid"));
  EXPECT_TRUE(says(disc("0.1", "0.155"), "above the shaft's, 0.025 m, and below the shell's, 0.155 m"));
  EXPECT_TRUE(says(disc("0.1", "0.02"), "a diameter in m above the shaft's"));
  // The shell's gap is that of the largest part
  EXPECT_TRUE(says(disc("0.1", "0.150"), "the gap between the impeller and the shell, 0.0025 m"));
}

TEST(StirredMill, larger_balls_than_the_gaps_are_requested) {
  const std::string base = "geometry.impeller.shaft.end=0.004";
  EXPECT_TRUE(
      says(refusal(stirred_mill, {base}),
           "below the gap between the impeller and the base, 0.004 m (or charge.larger_than_gap: true)"));
  const std::string wanted = "charge.larger_than_gap=true";
  EXPECT_EQ(refusal(stirred_mill, {base, wanted}), "");
  EXPECT_EQ(refusal(stirred_mill, {"charge.diameter=0.008", wanted}), "");
  // Those that do not fit between shaft and shell stay refused
  EXPECT_TRUE(says(refusal(stirred_mill, {"charge.diameter=0.06", wanted}),
                   "below the room between the shaft and the shell, 0.0541667 m"));
  // It allows balls, and does not change them
  EXPECT_EQ(read(stirred_mill).fingerprint.charge, read(stirred_mill, {wanted}).fingerprint.charge);
}

TEST(StirredMill, balls_are_given_by_mass_or_by_number) {
  const std::string classes = with(stirred_mill, "{level: 0.0775, share: 0.5, diameter: 0.005}",
                                   "{classes: [{diameter: 0.005, number: 1234}]}");
  EXPECT_EQ(count_charge(read(classes)).balls, 1234);
  EXPECT_EQ(count_charge(read(classes, {"charge.level=0.0775", "charge.diameter=0.005"})).balls, 10640);
  EXPECT_TRUE(says(refusal(with(classes, "number: 1234", "number: 12.5")), "a whole number of balls"));
  EXPECT_TRUE(
      says(refusal(with(classes, "number: 1234", "number: 12, mass: 1")), "either the mass or the number"));
  EXPECT_EQ(count_charge(read(with(example_mill, "mass: 0.02}", "number: 100}"))).classes[0].count, 100);
}

TEST(StirredMill, what_cannot_turn_is_refused) {
  const auto set = [](const std::string& change) { return refusal(stirred_mill, {change}); };
  EXPECT_TRUE(says(set("geometry.impeller.pins[0].length=0.155"), "the pins would hit the shell"));
  EXPECT_TRUE(says(set("geometry.impeller.pins[1].height=0.04"), "do not hit those from 0.0229 to 0.0379 m"));
  EXPECT_TRUE(says(set("geometry.impeller.pins[0].height=0.01"), "the pins lie on the shaft"));
  EXPECT_TRUE(says(set("geometry.impeller.pins[0].thickness=0.03"), "below that of the shaft"));
  EXPECT_TRUE(says(set("geometry.impeller.pins[0].arms=8"), "these meet outside of the shaft"));
  EXPECT_TRUE(says(set("charge.diameter=0.008"), "the gap between the impeller and the shell, 0.0066"));
  EXPECT_TRUE(says(set("charge.level=0.5"), "up to the mill's"));
  EXPECT_TRUE(says(set("speed.tip_speed=500"), "a speed of the impeller's tips"));
  EXPECT_TRUE(says(set("flow.turns=3"), "without it the mill has a dry run alone"));
  EXPECT_TRUE(
      says(set("averages={azimuthal: 1000, axial: 1000, radial: 200}"), "at most 1.7e+08 voxels, not 2e+08"));
  const std::string slurry = "slurry={density: 1000, plastic_viscosity: 0.001, yield_stress: 0, level: ";
  EXPECT_TRUE(says(set(slurry + "0.4}"), "above 0 and below the mill's"));
  const auto wet = [&](const std::string& change) {
    return refusal(stirred_mill, {slurry + "0.0775}", change});
  };
  EXPECT_TRUE(says(wet("flow.coupling=iterated"), "one_way or direct for a stirred mill"));
  EXPECT_TRUE(says(wet("flow.solver=interFoam"), "slurryFoam for a stirred mill"));
  EXPECT_TRUE(says(wet("resolution.cell_size=0.05"), "from a sixtieth of the radius"));
  EXPECT_TRUE(says(wet("resolution.layers=9"), "'resolution.layers' is unknown"));
  EXPECT_TRUE(says(set("machine=planetary"), "tumbling"));
  EXPECT_TRUE(says(set("geometry.lifters.count=3"), "'geometry.lifters' is unknown"));
}

// A mill that was run before it could have discs is still the same
TEST(StirredMill, without_discs_it_keeps_its_fingerprints) {
  const MillFingerprints found = read(stirred_mill).fingerprint;
  EXPECT_EQ(found.walls, "5178b99beda016a3");
  EXPECT_EQ(found.charge, "ba635eeb3dbe9b1e");
  EXPECT_NE(read(stirred_mill, {disc_impeller}).fingerprint.walls, found.walls);
}

TEST(StirredMill, resolved_it_is_the_same_mill) {
  const TemporaryFolder folder;
  const MillDescription first = describe(stirred_mill, {"dem.contact_interval=0.01", disc_impeller});
  const Json one = resolved_mill(first, "test");
  const Json two = resolved_mill(describe_mill(folder.write("mill.json", one.dump(2))), "test");
  EXPECT_EQ(one["mill"], two["mill"]);
  EXPECT_EQ(one["derived"], two["derived"]);
  EXPECT_EQ(one["fingerprint"], two["fingerprint"]);
  EXPECT_EQ(one["derived"]["machine"], "stirred");
  EXPECT_NEAR(one["derived"]["geometry"]["impeller"]["gap_m"].get<double>(), 0.0065, 1e-12);
  EXPECT_EQ(one["derived"]["geometry"]["impeller"]["discs"][1]["diameter_m"], 0.142);
  EXPECT_NEAR(one["derived"]["speed"]["tip_speed_m_s"].get<double>(), 2.2305, 1e-4);
}

TEST(StirredMill, balls_are_averaged_over_the_run_on_rings_that_turn_with_the_impeller) {
  const Averages averages = read(stirred_mill).averages;
  ASSERT_TRUE(averages.rings);
  EXPECT_TRUE(averages.rings->turning);
  EXPECT_TRUE(averages.whole_run);
  // Edges of a ball of 5 mm; a number of sectors that four pins share
  EXPECT_EQ(averages.shape(), (std::array<int, 3>{16, 64, 63}));
  EXPECT_DOUBLE_EQ(read(stirred_mill, {"averages.start=0.5"}).averages.window, 0.7);
  const Json derived = resolved_mill(describe(stirred_mill), "test")["derived"]["averages"];
  EXPECT_EQ(derived["shape"], (Json{16, 64, 63}));
  EXPECT_EQ(derived["frame"], "impeller");
  EXPECT_EQ(derived["whole_run"], true);
  EXPECT_EQ(derived["radii_m"], (Json{0, 0.0775}));
}

TEST(StirredMill, balls_and_slurry_meet_on_voxels_at_rest_that_cover_the_shell) {
  const std::string slurry =
      "slurry={density: 1000, plastic_viscosity: 0.001, yield_stress: 0, level: 0.0775}";
  const std::string direct = "flow.coupling=direct", size = "flow.exchange.voxel_size=0.0155";
  EXPECT_FALSE(read(stirred_mill, {slurry}).flow.coupling.voxels);
  const Voxels usual = read(stirred_mill, {slurry, direct}).flow.coupling.voxels.value();
  // Two balls of 5 mm
  EXPECT_EQ(usual.shape, (std::array<int, 3>{16, 16, 32}));
  EXPECT_DOUBLE_EQ(usual.lower[0], -0.08);
  EXPECT_DOUBLE_EQ(usual.upper[1], 0.08);
  EXPECT_DOUBLE_EQ(usual.upper[2], 0.315);
  EXPECT_EQ(read(stirred_mill, {slurry, direct, size}).flow.coupling.voxels.value().shape,
            (std::array<int, 3>{10, 10, 20}));
  const Json derived = resolved_mill(describe(stirred_mill, {slurry, direct}), "test")["derived"]["flow"];
  EXPECT_EQ(derived["exchange"]["shape"], (Json{16, 16, 32}));
  EXPECT_EQ(derived["coupling"], "direct");
  // Its own key alone
  EXPECT_NE(read(stirred_mill, {slurry, direct, size}).fingerprint.flow,
            read(stirred_mill, {slurry, direct}).fingerprint.flow);
  EXPECT_TRUE(says(refusal(stirred_mill, {slurry, size}), "flow.coupling direct of a stirred mill only"));
  EXPECT_TRUE(
      says(refusal(stirred_mill, {slurry, direct, "flow.exchange.voxel_size=0.5"}), "up to the radius"));
  const std::string shape = "charge.shape={half_axes: [1.1, 1, 0.9], blockiness: 3}";
  EXPECT_TRUE(read(stirred_mill, {slurry, direct, shape}).flow.coupling.voxels);
}

TEST(StirredMill, rings_can_be_at_rest_and_have_other_numbers) {
  const Averages averages =
      read(stirred_mill + "averages: {frame: lab, radial: 8, azimuthal: 12, axial: 20}\n").averages;
  EXPECT_FALSE(averages.rings->turning);
  EXPECT_TRUE(averages.whole_run);
  EXPECT_EQ(averages.shape(), (std::array<int, 3>{8, 12, 20}));
  EXPECT_EQ(read(stirred_mill, {"averages.window=0.2"}).averages.window, 0.2);
  EXPECT_FALSE(read(stirred_mill, {"averages.window=0.2"}).averages.whole_run);
  const auto fingerprint = [](const std::vector<std::string>& set) {
    return read(stirred_mill, set).fingerprint.averages;
  };
  EXPECT_NE(fingerprint({"averages.frame=lab"}), fingerprint({}));
  EXPECT_EQ(fingerprint({"averages.axial=63"}), fingerprint({}));
}

TEST(StirredMill, wrong_averages_are_refused) {
  EXPECT_TRUE(says(refusal(stirred_mill, {"averages.frame=shaft"}),
                   "'averages.frame' = shaft: expected one of lab, impeller"));
  EXPECT_TRUE(
      says(refusal(stirred_mill, {"averages.radial=0"}),
           "'averages.radial' = 0: expected a whole number of rings along the radius from 1 to 1000"));
  EXPECT_TRUE(says(refusal(stirred_mill, {"averages.window=all"}), "expected 'whole', or a time in s"));
  EXPECT_TRUE(says(refusal(stirred_mill, {"averages.voxel_size=0.01"}), "'averages.voxel_size'"));
  EXPECT_TRUE(says(refusal(stirred_mill, {"averages.live=true"}),
                   "'averages.live' = true: expected false, or a time in s as averages.start"));
  EXPECT_EQ(refusal(stirred_mill, {"averages.live=true", "averages.start=0.3"}), "");
  EXPECT_TRUE(says(refusal(example_mill, {"averages.frame=lab"}), "'averages.frame'"));
  EXPECT_TRUE(says(refusal(example_mill, {"averages.window=whole"}), "expected a time in s of at least"));
}

TEST(StirredMill, tumbling_mills_keep_their_fingerprints) {
  const MillFingerprints usual = read(example_mill).fingerprint;
  const MillFingerprints named = read("machine: tumbling\n" + example_mill).fingerprint;
  EXPECT_EQ(usual.flow, named.flow);
  EXPECT_EQ(usual.charge, named.charge);
}

}  // namespace
}  // namespace millfoam::meshing
