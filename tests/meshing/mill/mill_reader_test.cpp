// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/mill/mill_reader.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "meshing/mill/materials.hpp"
#include "tests/meshing/test_mill.hpp"

namespace millfoam::meshing {
namespace {

Mill read(const std::string& text) {
  const TemporaryFolder folder;
  return read_mill(folder.write("mill.yaml", text));
}

/// The message with which a description is refused; the folder's name is cut off.
std::string refusal(const std::string& text) {
  try {
    read(text);
  } catch (const MillError& error) {
    const std::string message = error.what();
    return message.substr(message.find("mill.yaml"));
  }
  return "accepted";
}

std::string refusal(const std::string& from, const std::string& to) {
  return refusal(with(example_mill, from, to));
}

TEST(ReadMill, gives_every_number_of_the_file_in_its_place) {
  const Mill mill = read(example_mill);
  EXPECT_EQ(mill.title, "example");
  EXPECT_EQ(mill.geometry.radius(), 0.06);
  EXPECT_EQ(mill.geometry.length, 0.024);
  EXPECT_EQ(mill.geometry.ends, Ends::plain);
  EXPECT_EQ(mill.geometry.lifters.count, 12);
  EXPECT_EQ(mill.geometry.lifters.height, 0.008);
  EXPECT_EQ(mill.geometry.lifters.width, 0.006);
  EXPECT_EQ(mill.ball.density, 2700);
  EXPECT_EQ(mill.wall.youngs_modulus, 1e9);
  EXPECT_EQ(mill.wall.poisson_ratio, 0.4);
  EXPECT_EQ(mill.ball_ball.friction, 0.94);
  EXPECT_EQ(mill.ball_wall.restitution, 0.703);
  EXPECT_EQ(mill.ball_wall.rolling_friction, 0.02);
  EXPECT_EQ(mill.dem.youngs_modulus, 1e7);
  EXPECT_EQ(mill.dem.rayleigh_fraction, 0.2);
  EXPECT_EQ(mill.dem.settle_time, 0.25);
  EXPECT_EQ(mill.dem.duration, 1.6);
  EXPECT_EQ(mill.dem.record_interval, 0.002);
  EXPECT_EQ(mill.dem.contact_interval, 0);
  EXPECT_FALSE(mill.dem.contact_statistics);
  EXPECT_EQ(mill.dem.seed, 20121);
  EXPECT_EQ(mill.slurry.density, 1239);
  EXPECT_EQ(mill.slurry.plastic_viscosity, 0.0014);
  EXPECT_EQ(mill.slurry.yield_stress, 0.16);
  EXPECT_EQ(mill.flow.start.level, -0.012);
  EXPECT_EQ(mill.resolution.cell_size, 0.003);
  EXPECT_EQ(mill.resolution.layers, 8);
}

TEST(ReadMill, fills_in_the_documented_defaults) {
  const Mill mill = read(with(example_mill, "title: example\n", ""));
  EXPECT_EQ(mill.title, "mill");
  EXPECT_EQ(mill.slurry.surface_tension, 0.07);
  EXPECT_EQ(mill.slurry.viscosity_ratio, 1000);
  EXPECT_EQ(mill.air.density, 1.2);
  EXPECT_EQ(mill.air.viscosity, 1.8e-5);
  EXPECT_DOUBLE_EQ(mill.charge.start_radius, 0.06 - 0.008 - 0.004);
  EXPECT_DOUBLE_EQ(mill.charge.start_length, 0.98 * 0.024);
}

TEST(ReadMill, fills_in_dimensions_that_sources_seldom_give) {
  EXPECT_EQ(read(with(example_mill, "    width: 0.006\n", "")).geometry.lifters.width, 0.008);
  const Lifters bare = read(with(example_mill, "    height: 0.008\n    width: 0.006\n", "")).geometry.lifters;
  EXPECT_DOUBLE_EQ(bare.height, 0.06 / 15);
  EXPECT_DOUBLE_EQ(bare.width, 0.06 / 15);
  // 60 lifters of 8 mm leave 5.45 mm to each at their tops
  const double pitch = 2 * 0.052 * std::tan(std::acos(-1.0) / 60);
  EXPECT_DOUBLE_EQ(read(with(example_mill, "count: 12\n    height: 0.008\n    width: 0.006",
                             "count: 60\n    height: 0.008"))
                       .geometry.lifters.width,
                   pitch / 2);

  const Geometry open =
      read(with(example_mill, "speed:", "  grates: {sectors: 6}\n  pulp_lifters: {layers: 2}\nspeed:"))
          .geometry;
  EXPECT_DOUBLE_EQ(open.grates->outer_radius, 0.93 * 0.052);
  EXPECT_DOUBLE_EQ(open.grates->inner_radius, 0.69 * 0.93 * 0.052);
  EXPECT_DOUBLE_EQ(open.pulp_lifters->depth, 0.11 * 0.12);
  EXPECT_DOUBLE_EQ(open.pulp_lifters->discharge_radius, 0.52 * 0.69 * 0.93 * 0.052);
  // No smaller than the smallest circle of the mesh
  const Geometry narrow =
      read(with(example_mill,
                "speed:", "  grates: {outer_radius: 0.02, sectors: 6}\n  pulp_lifters: {layers: 2}\nspeed:"))
          .geometry;
  EXPECT_DOUBLE_EQ(narrow.grates->inner_radius, 0.69 * 0.02);
  EXPECT_DOUBLE_EQ(narrow.pulp_lifters->discharge_radius, 0.25 * 0.052);
}

TEST(ReadMill, takes_a_pools_level_from_the_slurry_unless_it_is_given) {
  EXPECT_FALSE(read(example_mill).dem.pool_level);
  const std::string wet = with(example_mill, "seed: 20121", "seed: 20121\n  fluid: buoyancy");
  EXPECT_EQ(read(wet).dem.pool_level, -0.012);
  EXPECT_EQ(read(with(wet, "fluid: buoyancy", "fluid: buoyancy\n  fluid_level: 0.01")).dem.pool_level, 0.01);
  const std::string message = refusal(with(wet, "  level: -0.012\n", ""));
  EXPECT_NE(message.find("key 'dem.fluid_level' is missing: expected a height in m"), std::string::npos)
      << message;
}

TEST(ReadMill, turns_clockwise_with_negative_speed) {
  const double critical = std::sqrt(9.81 / 0.06);
  EXPECT_DOUBLE_EQ(read(example_mill).angular_velocity, -0.5 * critical);
  EXPECT_DOUBLE_EQ(read(with(example_mill, "sense: clockwise", "sense: anticlockwise")).angular_velocity,
                   0.5 * critical);
}

TEST(ReadMill, takes_a_signed_angular_velocity_instead_of_a_fraction) {
  const std::string speed = "fraction_of_critical: 0.5\n  sense: clockwise";
  EXPECT_EQ(read(with(example_mill, speed, "angular_velocity: -6.4")).angular_velocity, -6.4);
  EXPECT_EQ(
      refusal("  sense", "  angular_velocity: 1\n  sense"),
      "mill.yaml:11: key 'speed.fraction_of_critical' = 0.5: expected either angular_velocity alone, or "
      "sense with fraction_of_critical or rpm");
}

TEST(ReadMill, takes_turns_per_minute_instead_of_a_fraction) {
  const auto turning = [](const std::string& speed) {
    return with(example_mill, "fraction_of_critical: 0.5\n  sense: clockwise", speed);
  };
  const double pi = std::acos(-1.0);
  EXPECT_NEAR(read(turning("rpm: 60\n  sense: clockwise")).angular_velocity, -2 * pi, 1e-14);
  EXPECT_NEAR(read(turning("rpm: 30\n  sense: anticlockwise")).angular_velocity, pi, 1e-14);
  EXPECT_TRUE(says(refusal(turning("rpm: 60")), "key 'speed.sense' is missing"));
  // 0.001 to 3 times sqrt(9.81/0.06) = 12.787 rad/s
  EXPECT_TRUE(says(refusal(turning("rpm: -60\n  sense: clockwise")),
                   "key 'speed.rpm' = -60: expected a speed in turns per minute from 0.122104 to 366.312"));
  EXPECT_TRUE(says(refusal("  sense", "  rpm: 60\n  sense"),
                   "key 'speed.rpm' = 60: expected either this key or fraction_of_critical"));
  EXPECT_TRUE(says(refusal(turning("angular_velocity: 1\n  rpm: 60")),
                   "key 'speed.rpm' = 60: expected either angular_velocity alone, or sense with"));
}

TEST(ReadMill, scales_the_masses_from_the_reference_length_to_the_mills) {
  const Mill mill = read(with(example_mill, "  classes", "  reference_length: 0.12\n  classes"));
  ASSERT_EQ(mill.charge.classes.size(), 2u);
  EXPECT_EQ(mill.charge.classes[0].diameter, 0.008);
  EXPECT_DOUBLE_EQ(mill.charge.classes[0].mass, 0.02 / 5);
  EXPECT_DOUBLE_EQ(mill.charge.classes[1].mass, 0.03 / 5);
}

TEST(ReadMill, fills_a_share_of_a_smooth_drum_in_bulk_with_one_size) {
  std::string text = example_mill.substr(0, example_mill.find("  classes")) +
                     "  fill: 0.3\n  diameter: 0.005\n  packing: 0.55\n" +
                     example_mill.substr(example_mill.find("materials"));
  text = with(text, "count: 12\n    height: 0.008\n    width: 0.006", "count: 0");
  const Mill mill = read(text);
  ASSERT_EQ(mill.charge.classes.size(), 1u);
  EXPECT_EQ(mill.charge.classes[0].diameter, 0.005);
  EXPECT_NEAR(mill.charge.classes[0].mass, 0.3 * 0.55 * 2700 * std::acos(-1.0) * 0.06 * 0.06 * 0.024, 1e-15);
}

TEST(ReadMill, takes_a_smooth_drum_with_or_without_the_size_of_its_lifters) {
  const Mill mill = read(with(example_mill, "count: 12", "count: 0"));
  EXPECT_EQ(mill.geometry.lifters.count, 0);
  EXPECT_EQ(mill.geometry.lifters.height, 0);
  EXPECT_EQ(mill.geometry.lifters.width, 0);
  const std::string lifters = "count: 12\n    height: 0.008\n    width: 0.006";
  EXPECT_EQ(refusal(lifters, "count: 0"), "accepted");
  EXPECT_EQ(refusal(lifters, "count: 0\n    height: 0\n    width: 0"), "accepted");
}

TEST(ReadMill, names_a_misspelt_key_and_the_nearest_known_one) {
  EXPECT_EQ(refusal("count:", "cuont:"),
            "mill.yaml:7: key 'geometry.lifters.cuont' is unknown: did you mean 'count'? known here: count, "
            "height, width, top_width");
  EXPECT_EQ(refusal("slurry:", "fluid:").substr(0, 60),
            std::string("mill.yaml:29: key 'fluid' is unknown: known here: title, geometry").substr(0, 60));
}

TEST(ReadMill, names_a_missing_key_and_its_section) {
  EXPECT_EQ(refusal("    count: 12\n", ""),
            "mill.yaml:6: key 'geometry.lifters.count' is missing: expected a whole number of lifters from 0 "
            "to 1000");
  EXPECT_EQ(refusal("diameter: 0.008, ", ""),
            "mill.yaml:15: key 'charge.classes[0].diameter' is missing: expected a ball's diameter above 0 "
            "and below "
            "the mill's length, 0.024 m");
}

TEST(ReadMill, refuses_a_lifter_longer_than_the_radius) {
  EXPECT_EQ(refusal("height: 0.008", "height: 0.07"),
            "mill.yaml:8: key 'geometry.lifters.height' = 0.07: expected a length above 0 and below the "
            "radius, 0.06 m");
}

TEST(ReadMill, refuses_lifters_that_overlap_or_reach_through_the_shell) {
  // 2 (0.06 - 0.008) tan(15 degrees) = 0.02787; chord of the shell 0.052 from the axis: 0.05987
  EXPECT_NE(
      refusal("width: 0.006", "width: 0.028").find("below the pitch of the lifters at their tops, 0.0278"),
      std::string::npos);
  EXPECT_EQ(refusal("width: 0.006", "width: 0.0278"), "accepted");
  EXPECT_NE(refusal(with(with(example_mill, "count: 12", "count: 1"), "width: 0.006", "width: 0.06"))
                .find("below the shell's chord at the height of the lifters' tops, 0.0598"),
            std::string::npos);
}

TEST(ReadMill, takes_lifters_as_rectangles_unless_their_tops_have_a_width) {
  EXPECT_EQ(read(example_mill).geometry.lifters.top_width, 0.006);
  const std::string with_top = "width: 0.006\n    top_width: 0.004";
  EXPECT_EQ(read(with(example_mill, "width: 0.006", with_top)).geometry.lifters.top_width, 0.004);
  // Feet may be wider than the tops' pitch, up to their own: 0.12 sin(15 degrees) = 0.03106
  EXPECT_EQ(refusal("width: 0.006", "width: 0.03\n    top_width: 0.004"), "accepted");
  EXPECT_NE(refusal("width: 0.006", "width: 0.032\n    top_width: 0.004")
                .find("below the pitch of the lifters' feet on the shell, 0.0310"),
            std::string::npos);
  EXPECT_NE(
      refusal("width: 0.006", "width: 0.006\n    top_width: 0.007")
          .find("mill.yaml:10: key 'geometry.lifters.top_width' = 0.007: expected a length above 0, not "
                "above the width, 0.006 m"),
      std::string::npos);
}

TEST(ReadMill, takes_an_inlet_by_radius_or_area) {
  const auto inlet = [](const std::string& value) {
    return read(with(example_mill, "speed:", "  inlet: {" + value + "}\nspeed:")).geometry.inlet;
  };
  EXPECT_FALSE(read(example_mill).geometry.inlet);
  EXPECT_EQ(inlet("radius: 0.02")->radius, 0.02);
  EXPECT_DOUBLE_EQ(inlet("area: 0.001")->radius, std::sqrt(0.001 / std::acos(-1.0)));
}

const std::string grates_lines = "  grates: {inner_radius: 0.03, outer_radius: 0.045, sectors: 6}\n";
const std::string pulp_lifters_lines = "  pulp_lifters: {depth: 0.01, layers: 2, discharge_radius: 0.02}\n";

TEST(ReadMill, takes_grates_that_are_whole_rings_unless_their_share_is_given) {
  const Mill mill = read(with(example_mill, "speed:", grates_lines + pulp_lifters_lines + "speed:"));
  ASSERT_TRUE(mill.geometry.grates && mill.geometry.pulp_lifters);
  EXPECT_EQ(mill.geometry.grates->inner_radius, 0.03);
  EXPECT_EQ(mill.geometry.grates->outer_radius, 0.045);
  EXPECT_EQ(mill.geometry.grates->sectors, 6);
  EXPECT_EQ(mill.geometry.grates->sector_share, 1);
  EXPECT_EQ(mill.geometry.grates->open_fraction, 1);
  EXPECT_EQ(mill.geometry.grates->pegged, 0);
  EXPECT_EQ(mill.geometry.pulp_lifters->depth, 0.01);
  EXPECT_EQ(mill.geometry.pulp_lifters->layers, 2);
  EXPECT_EQ(mill.geometry.pulp_lifters->discharge_radius, 0.02);
}

TEST(ReadMill, holes_of_grates_may_be_plugged_without_other_balls_or_mesh) {
  const auto pegged = [](const std::string& holes) {
    return read(with(with(example_mill, "speed:", grates_lines + pulp_lifters_lines + "speed:"), "sectors: 6",
                     "sectors: 6, open_fraction: " + holes));
  };
  const Mill clean = pegged("0.4"), plugged = pegged("0.4, pegged: 0.25");
  EXPECT_DOUBLE_EQ(clean.geometry.grates->open(), 0.4);
  EXPECT_DOUBLE_EQ(plugged.geometry.grates->open(), 0.3);
  EXPECT_EQ(clean.fingerprint.walls, plugged.fingerprint.walls);
  EXPECT_EQ(clean.fingerprint.charge, plugged.fingerprint.charge);
  EXPECT_NE(clean.fingerprint.flow, plugged.fingerprint.flow);
  EXPECT_EQ(clean.fingerprint.walls, pegged("0.5").fingerprint.walls);
  EXPECT_EQ(clean.fingerprint.averages, pegged("0.4, sector_share: 0.7").fingerprint.averages);
  EXPECT_NE(clean.fingerprint.flow, pegged("0.4, sector_share: 0.7").fingerprint.flow);
}

TEST(ReadMill, holes_of_grates_need_slurryFoam) {
  const auto refused = [](const std::string& holes) {
    return refusal(with(with(example_mill, "speed:", grates_lines + pulp_lifters_lines + "speed:"),
                        "sectors: 6", "sectors: 6, open_fraction: " + holes) +
                   "flow: {solver: interFoam}\n");
  };
  EXPECT_NE(
      refused("0.4").find("'flow.solver' = interFoam: expected slurryFoam: only it knows the resistance"),
      std::string::npos)
      << refused("0.4");
  EXPECT_EQ(refused("1").find("resistance"), std::string::npos) << refused("1");
}

TEST(ReadMill, refuses_openings_that_a_mill_cannot_have) {
  const auto refused = [](const std::string& from, const std::string& to, const std::string& message) {
    const std::string text =
        with(example_mill, "speed:", grates_lines + pulp_lifters_lines + "  inlet: {radius: 0.02}\nspeed:");
    EXPECT_NE(refusal(with(text, from, to)).find(message), std::string::npos)
        << refusal(with(text, from, to));
  };
  refused("ends: plain", "ends: periodic",
          "'geometry.inlet' = {…}: expected this key with 'ends: plain' only");
  refused(grates_lines, "",
          "mill.yaml:10: key 'geometry.pulp_lifters' = {…}: expected this key with the key grates only");
  refused("radius: 0.02}\nspeed", "radius: 0.06}\nspeed",
          "'geometry.inlet.radius' = 0.06: expected a length (or the key area) above 0 and below the radius "
          "inside "
          "the lifters, 0.052 m");
  refused("{radius: 0.02}", "{radius: 0.02, area: 0.001}",
          "'geometry.inlet.radius' = 0.02: expected either area");
  refused("{radius: 0.02}", "{area: 0.01}",
          "'geometry.inlet.area' = 0.01: expected an area above 0 and below");
  refused("outer_radius: 0.045", "outer_radius: 0.053", "'geometry.grates.outer_radius' = 0.053");
  refused("inner_radius: 0.03, outer_radius: 0.045", "outer_radius: 0.012",
          "'geometry.grates.outer_radius' = 0.012: expected a length above 0.013 m");
  refused("inner_radius: 0.03", "inner_radius: 0.046",
          "'geometry.grates.inner_radius' = 0.046: expected a length of 0.013 m (a quarter of the radius "
          "inside the "
          "lifters) or more and not above the outer radius, 0.045 m");
  refused("inner_radius: 0.03", "inner_radius: 0.0449",
          "expected a length at least 0.5 % below outer_radius");
  refused("sectors: 6", "sectors: 0", "'geometry.grates.sectors' = 0: expected a whole number of sectors");
  refused("sectors: 6", "sectors: 6, sector_share: 1.1", "'geometry.grates.sector_share' = 1.1");
  refused("sectors: 6", "sectors: 6, open_fraction: 0", "'geometry.grates.open_fraction' = 0");
  refused("sectors: 6", "sectors: 6, open_fraction: 0.1, pegged: 0.995",
          "'geometry.grates.pegged' = 0.995: expected a share of the holes of 0 or more and up to 0.99");
  refused("layers: 2", "layers: 1",
          "'geometry.pulp_lifters.layers' = 1: expected a whole number of layers from 2");
  refused("discharge_radius: 0.02", "discharge_radius: 0.031",
          "'geometry.pulp_lifters.discharge_radius' = 0.031");
}

TEST(ReadMill, takes_counts_of_cells_instead_of_their_size) {
  const std::string counts = "counts: {gap: 11, lifter: 3, height: 5, ring: 9}";
  const Resolution resolution = read(with(example_mill, "cell_size: 0.003", counts)).resolution;
  ASSERT_TRUE(resolution.counts);
  EXPECT_EQ(resolution.counts->gap, 11);
  EXPECT_EQ(resolution.counts->lifter, 3);
  EXPECT_EQ(resolution.counts->height, 5);
  EXPECT_EQ(resolution.counts->ring, 9);
  EXPECT_EQ(resolution.cell_size, 0);
  EXPECT_FALSE(read(example_mill).resolution.counts);
}

TEST(ReadMill, takes_a_core_of_half_the_columns_inside_openings) {
  const auto with_core = [](const std::string& gap, const std::string& core) {
    const std::string counts =
        "counts: {gap: " + gap + ", lifter: 3, height: 5, ring: 9, core: " + core + "}";
    return with(example_mill, "cell_size: 0.003", counts);
  };
  const auto opened = [](const std::string& text) { return with(text, "speed:", grates_lines + "speed:"); };
  const auto halved = [](const std::string& text) { return read(text).resolution.counts->halved; };
  EXPECT_TRUE(halved(opened(with_core("11", "21"))));
  EXPECT_FALSE(halved(opened(with_core("11", "42"))));
  EXPECT_FALSE(halved(with_core("11", "42")));
  EXPECT_NE(refusal(opened(with_core("11", "20")))
                .find("'resolution.counts.core' = 20: expected 42 or 21, a quarter or an eighth of the cells "
                      "around the mill"),
            std::string::npos);
  EXPECT_NE(
      refusal(with_core("11", "21"))
          .find("'resolution.counts.core' = 21: expected 42, a quarter of the cells around the mill (half "
                "of it with openings, and a multiple of 8 from 40 on around)"),
      std::string::npos);
  // 12 times 13 cells around, and 12 times 2
  EXPECT_NE(refusal(opened(with_core("10", "19"))).find("expected 39, a quarter of the cells"),
            std::string::npos);
  EXPECT_NE(
      refusal(with(opened(with_core("1", "3")), "lifter: 3", "lifter: 1")).find("expected 6, a quarter"),
      std::string::npos);
}

TEST(ReadMill, refuses_counts_that_the_blocks_cannot_have) {
  const std::string counts = "counts: {gap: 11, lifter: 3, height: 5, ring: 9}";
  const auto refused = [&](const std::string& text, const std::string& from, const std::string& to) {
    return refusal(with(with(text, "cell_size: 0.003", counts), from, to));
  };
  EXPECT_NE(
      refused(example_mill, "layers: 8", "cell_size: 0.003\n  layers: 8").find("either cell_size or counts"),
      std::string::npos);
  EXPECT_NE(refused(example_mill, "ring: 9", "ring: 0").find("a whole number of cells from 1 to 100000"),
            std::string::npos);
  EXPECT_NE(
      refused(with(example_mill, "count: 12", "count: 11"), "gap: 11", "gap: 10")
          .find(
              "'resolution.counts.gap' = 10: expected a number that makes the cells around the mill, 143, a "
              "multiple of four"),
      std::string::npos);
  EXPECT_NE(refused(with(example_mill, "speed:", grates_lines + "speed:"), "ring: 9", "ring: 2")
                .find("'resolution.counts.ring' = 2: expected a whole number of cells from 3 to 100000"),
            std::string::npos);
  EXPECT_NE(refused(example_mill, "gap: 11, lifter: 3", "gap: 11000, lifter: 3000").find("at most 1e8 cells"),
            std::string::npos);
}

struct Refused {
  std::string from;
  std::string to;
  std::string message;  ///< what the message must hold
};

class Refusal : public testing::TestWithParam<Refused> {};

TEST_P(Refusal, names_line_key_value_and_what_was_expected) {
  const std::string message = refusal(GetParam().from, GetParam().to);
  EXPECT_NE(message.find(GetParam().message), std::string::npos) << message;
}

INSTANTIATE_TEST_SUITE_P(
    OfNumbers, Refusal,
    testing::Values(
        Refused{"diameter: 0.12", "diameter: -0.12",
                "mill.yaml:3: key 'geometry.diameter' = -0.12: expected a length"},
        Refused{"length: 0.024", "length: 0",
                "mill.yaml:4: key 'geometry.length' = 0: expected a length in m above 0"},
        Refused{"length: 0.024", "length: .nan", "'geometry.length' = .nan"},
        Refused{"length: 0.024", "length: inf", "'geometry.length' = inf"},
        Refused{"length: 0.024", "length: 1e400", "'geometry.length' = 1e400"},
        Refused{"length: 0.024", "length: 24 mm", "'geometry.length' = 24 mm: expected a length in m"},
        Refused{"length: 0.024", "length: \"0.024\"", "'geometry.length' = \"0.024\": expected a length"},
        Refused{"length: 0.024", "length:", "'geometry.length' = (nothing)"},
        Refused{"length: 0.024", "length: [1, 2]", "'geometry.length' = […]"},
        Refused{"length: 0.024", "length: 0.005",
                "mill.yaml:15: key 'charge.classes[0].diameter' = 0.008: expected a "
                "ball's diameter above 0 and below the mill's length, 0.005 m"},
        Refused{"ends: plain", "ends: open", "'geometry.ends' = open: expected one of plain, periodic"},
        Refused{"count: 12", "count: 12.5", "'geometry.lifters.count' = 12.5: expected a whole number"},
        Refused{"count: 12", "count: -1", "'geometry.lifters.count' = -1"},
        Refused{"fraction_of_critical: 0.5", "fraction_of_critical: 0", "'speed.fraction_of_critical' = 0"},
        Refused{"fraction_of_critical: 0.5", "fraction_of_critical: 75",
                "'speed.fraction_of_critical' = 75: expected a fraction of the critical speed from 0.001 to "
                "3, 0.75 for 75 %"},
        Refused{"sense: clockwise", "sense: left", "expected one of clockwise, anticlockwise"},
        Refused{"mass: 0.02", "mass: -0.02",
                "'charge.classes[0].mass' = -0.02: expected a mass in kg (of the mill full of"},
        Refused{"mass: 0.02", "mass: 2", "'charge.classes[0].mass' = 2: expected a mass in kg"},
        Refused{"mass: 0.02", "mass: 0.5", "'charge.classes' = […]: expected balls that fit"},
        Refused{"density: 2700", "density: 0", "mill.yaml:18: key 'materials.ball.density' = 0"},
        Refused{"poisson_ratio: 0.23", "poisson_ratio: 0.5", "'materials.ball.poisson_ratio' = 0.5"},
        Refused{"poisson_ratio: 0.23", "poisson_ratio: 0", "'materials.ball.poisson_ratio' = 0"},
        Refused{"restitution: 0.8", "restitution: 1.1", "'materials.ball_ball.restitution' = 1.1"},
        Refused{"restitution: 0.8", "restitution: 0.05",
                "'materials.ball_ball.restitution' = 0.05: expected a coefficient of restitution above 0.05 "
                "and up to 1"},
        Refused{"friction: 0.94", "friction: -0.1", "'materials.ball_ball.friction' = -0.1"},
        Refused{"rayleigh_fraction: 0.2", "rayleigh_fraction: 2", "'dem.rayleigh_fraction' = 2"},
        Refused{"record_interval: 0.002", "record_interval: 2", "'dem.record_interval' = 2"},
        Refused{"seed: 20121", "contact_interval: -1\n  seed: 20121", "'dem.contact_interval' = -1"},
        Refused{"seed: 20121", "contact_interval: 2\n  seed: 20121",
                "'dem.contact_interval' = 2: expected 0 for no contacts, or a time in s from 1.6e-06 s to "
                "that of the duration"},
        Refused{"seed: 20121", "seed: 0", "'dem.seed' = 0"},
        Refused{"seed: 20121", "fluid: water\n  seed: 20121",
                "'dem.fluid' = water: expected one of none, buoyancy"},
        Refused{"seed: 20121", "fluid_level: 0\n  seed: 20121",
                "'dem.fluid_level' = 0: expected this key with dem.fluid buoyancy only"},
        Refused{"seed: 20121", "fluid: buoyancy\n  fluid_level: 0.07\n  seed: 20121",
                "'dem.fluid_level' = 0.07: expected a height in m within the radius"},
        Refused{"level: -0.012", "level: 0.061",
                "'slurry.level' = 0.061: expected a height in m within the radius"},
        Refused{"yield_stress: 0.16", "yield_stress: -1", "'slurry.yield_stress' = -1"},
        Refused{"cell_size: 0.003", "cell_size: 0.06", "'resolution.cell_size' = 0.06"},
        Refused{"cell_size: 0.003", "cell_size: 1e-7", "at most 1e8 cells"},
        Refused{"layers: 8", "layers: 0", "'resolution.layers' = 0"},
        Refused{"layers: 8", "layers: 1",
                "mill.yaml:36: key 'resolution.layers' = 1: expected 2 or more layers between two walls"},
        Refused{"layers: 8", "layers: 8\n  last_layer: 3mm",
                "'resolution.last_layer' = 3mm: expected a thickness in m from 0.000487"},
        Refused{"layers: 8", "layers: 8\n  last_layer: 0.0002",
                "(each layer 1.5 times as thick as the next) to 0.003 m (all equal)"},
        Refused{"layers: 8", "layers: 8\n  last_layer: 0.0031", "'resolution.last_layer' = 0.0031"},
        Refused{"layers: 8", "layers: 2000\n  last_layer: 0",
                "'resolution.last_layer' = 0: expected a thickness in m from 2.4e-07 m to 1.2e-05 m"},
        Refused{"  classes", "  start_radius: 0.053\n  classes", "'charge.start_radius' = 0.053"},
        Refused{"  classes", "  start_length: 0.03\n  classes", "'charge.start_length' = 0.03"},
        Refused{"  classes", "  fill: 0.3\n  classes",
                "'charge.fill' = 0.3: expected either classes, or fill"}));

TEST(ReadMill, refuses_a_repeated_key) {
  EXPECT_EQ(refusal("    width: 0.006", "    width: 0.006\n    height: 0.007"),
            "mill.yaml:10: key 'geometry.lifters.height' is given twice: expected once");
}

TEST(ReadMill, says_why_a_file_is_no_description) {
  EXPECT_NE(refusal("ends: plain", "ends: [plain").find("not valid YAML"), std::string::npos);
  EXPECT_NE(refusal(std::string()).find("mill.yaml:1: the file is empty: expected a mill"),
            std::string::npos);
  EXPECT_NE(refusal(std::string("# nothing\n")).find("the file is empty"), std::string::npos);
  EXPECT_NE(refusal(std::string("- 1\n- 2\n")).find("mill.yaml:1: not a map"), std::string::npos);
  EXPECT_NE(refusal(example_mill + "---\n" + example_mill).find("holds 2 YAML documents"), std::string::npos);
  const TemporaryFolder folder;
  try {
    read_mill(folder.path() / "none.yaml");
    FAIL();
  } catch (const MillError& error) {
    EXPECT_NE(std::string(error.what()).find("none.yaml: cannot be read"), std::string::npos);
  }
  EXPECT_THROW(read_mill(folder.path()), MillError);
}

TEST(CriticalSpeed, of_the_published_mills) {
  Geometry geometry;
  geometry.diameter = 0.12;
  EXPECT_NEAR(critical_speed(geometry), 12.79, 0.005);
  geometry.diameter = 0.3;
  EXPECT_NEAR(critical_speed(geometry), 8.087, 0.0005);
}

const std::string named_materials = R"(  ball: glass
  wall: HDPE
)";

std::string with_named_materials() {
  const auto begin = example_mill.find("  ball: {");
  const auto end = example_mill.find("dem:\n");
  return example_mill.substr(0, begin) + named_materials + example_mill.substr(end);
}

TEST(ReadMill, knows_materials_and_their_contacts_by_name) {
  const Mill mill = read(with_named_materials());
  EXPECT_EQ(mill.ball.density, 2700);
  EXPECT_NEAR(mill.ball.youngs_modulus / (2 * (1 + mill.ball.poisson_ratio)), 26.42e9, 1);
  EXPECT_EQ(mill.ball_ball.restitution, 0.8);
  EXPECT_EQ(mill.ball_ball.friction, 0.94);
  EXPECT_EQ(mill.ball_wall.restitution, 0.703);
  EXPECT_EQ(mill.ball_wall.friction, 0.287);
  EXPECT_EQ(mill.ball_wall.rolling_friction, 0.01);
}

TEST(ReadMill, takes_a_contact_by_name_beside_materials_of_its_own) {
  const std::string text =
      with(example_mill, "ball_wall: {restitution: 0.703, friction: 0.287, rolling_friction: 0.02}",
           "ball_wall: glass-nylon");
  EXPECT_EQ(read(text).ball_wall.restitution, 0.279);
  EXPECT_EQ(read(text).ball_wall.friction, 0.532);
}

TEST(ReadMill, names_what_it_knows_when_a_material_or_contact_is_not) {
  EXPECT_TRUE(
      says(refusal(with(with_named_materials(), "HDPE", "rubber")),
           "key 'materials.wall' = rubber: expected one of HDPE, aluminium, glass, nylon, perspex, or a "
           "map {density, youngs_modulus, poisson_ratio}"));
  EXPECT_TRUE(says(refusal(with(with_named_materials(), "  wall: HDPE\n", "")),
                   "key 'materials.wall' is missing: expected one of HDPE, aluminium"));
  EXPECT_TRUE(
      says(refusal(with(with_named_materials(), "wall: HDPE", "wall: HDPE\n  ball_wall: glass-rubber")),
           "key 'materials.ball_wall' = glass-rubber: expected one of glass-HDPE, glass-aluminium, "
           "glass-glass, glass-nylon, glass-perspex, or a map {restitution, friction, rolling_friction}"));
}

TEST(ReadMill, asks_for_a_contact_that_no_table_has) {
  const auto missing = [](const std::string& ball) {
    return refusal(with(with_named_materials(), "ball: glass", "ball: " + ball));
  };
  const std::string expected =
      "key 'materials.ball_ball' is missing: expected one of glass-HDPE, glass-aluminium, glass-glass, "
      "glass-nylon, glass-perspex, or a map {restitution, friction, rolling_friction}, because no contact ";
  EXPECT_TRUE(says(missing("aluminium"), expected + "'aluminium-aluminium' is known"));
  EXPECT_TRUE(says(missing("{density: 7800, youngs_modulus: 2e11, poisson_ratio: 0.3}"),
                   expected + "of these materials is known"));
}

TEST(ReadMill, takes_an_overlap_instead_of_a_modulus) {
  const Mill mill = read(with(example_mill, "youngs_modulus: 1.0e7", "largest_overlap: 0.05"));
  EXPECT_EQ(mill.dem.youngs_modulus, 0);
  EXPECT_EQ(mill.dem.largest_overlap, 0.05);
  EXPECT_NE(refusal("  youngs_modulus: 1.0e7", "  youngs_modulus: 1.0e7\n  largest_overlap: 0.05")
                .find("'dem.largest_overlap'"),
            std::string::npos);
  EXPECT_NE(refusal("youngs_modulus: 1.0e7", "largest_overlap: 0.3").find("up to 0.15"), std::string::npos);
}

TEST(ReadMill, has_an_overlap_where_it_says_neither) {
  const Mill mill = read(with(example_mill, "  youngs_modulus: 1.0e7\n", ""));
  EXPECT_EQ(mill.dem.largest_overlap, default_largest_overlap);
}

TEST(ReadMill, takes_fines_up_to_the_largest_ball) {
  EXPECT_EQ(read(with(example_mill, "charge:\n", "charge:\n  fines_below: 0.003\n")).charge.fines_below,
            0.003);
  EXPECT_NE(refusal("charge:\n", "charge:\n  fines_below: 0.02\n").find("'charge.fines_below' = 0.02"),
            std::string::npos);
}

TEST(ReadMill, takes_a_periodic_slice_of_a_whole_mill) {
  const Mill whole = read(example_mill);
  const Mill slice = read(with(example_mill, "  ends: plain", "  slice: 0.018\n  ends: plain"));
  EXPECT_EQ(slice.geometry.length, 0.018);
  EXPECT_EQ(slice.geometry.ends, Ends::periodic);
  EXPECT_EQ(slice.resolution.layers, 6);
  EXPECT_NEAR(slice.charge.classes[0].mass, whole.charge.classes[0].mass * 0.75, 1e-15);
  EXPECT_NE(refusal("  ends: plain", "  slice: 0.03\n  ends: plain").find("'geometry.slice' = 0.03"),
            std::string::npos);
}

// In less than two diameters a ball could touch the same ball on both sides
TEST(ReadMill, refuses_a_period_of_less_than_two_of_the_largest_balls) {
  EXPECT_EQ(
      refusal("  ends: plain", "  slice: 0.0159\n  ends: plain"),
      "mill.yaml:5: key 'geometry.slice' = 0.0159: expected a length in m of at least twice the largest "
      "ball's diameter, 0.016 m, and up to the mill's, 0.024 m");
  EXPECT_EQ(refusal("  ends: plain", "  slice: 0.016\n  ends: plain"), "accepted");
  const std::string periodic = with(example_mill, "ends: plain", "ends: periodic");
  EXPECT_EQ(
      refusal(with(periodic, "length: 0.024", "length: 0.0158")),
      "mill.yaml:15: key 'charge.classes[0].diameter' = 0.008: expected a ball's diameter above 0 and up "
      "to half of the periodic mill's length, 0.0079 m");
  EXPECT_EQ(refusal(with(periodic, "length: 0.024", "length: 0.016")), "accepted");
  EXPECT_EQ(refusal("length: 0.024", "length: 0.0158"), "accepted");
}

TEST(ReadMill, takes_the_last_of_layers_that_grow) {
  EXPECT_EQ(read(example_mill).resolution.last_layer, 0);
  const std::string graded = with(example_mill, "layers: 8", "layers: 8\n  last_layer: 0.001");
  EXPECT_EQ(read(graded).resolution.last_layer, 0.001);
  EXPECT_EQ(read(with(example_mill, "layers: 8", "layers: 8\n  last_layer: 0.003")).resolution.last_layer,
            0.003);
  // Bounds as a refusal shows them, of 7 layers: 0.024 / 7 and 0.024 0.5 / (1.5^7 - 1)
  for (const char* bound : {"0.00342857", "0.000745994"}) {
    const std::string seven = std::string("layers: 7\n  last_layer: ") + bound;
    EXPECT_EQ(refusal("layers: 8", seven), "accepted");
  }
}

TEST(ReadMill, has_equal_layers_where_the_ends_are_periodic) {
  const std::string graded = with(example_mill, "layers: 8", "layers: 8\n  last_layer: 0.001");
  EXPECT_EQ(read(with(graded, "  ends: plain", "  slice: 0.018\n  ends: plain")).resolution.last_layer, 0);
  EXPECT_NE(refusal(with(graded, "ends: plain", "ends: periodic"))
                .find("'resolution.last_layer' = 0.001: expected this key with plain ends only"),
            std::string::npos);
}

TEST(ReadMill, takes_one_layer_where_the_ends_are_periodic) {
  EXPECT_EQ(read(with(with(example_mill, "  ends: plain", "  slice: 0.016\n  ends: plain"), "layers: 8",
                      "layers: 2"))
                .resolution.layers,
            1);
  EXPECT_EQ(read(with(with(example_mill, "ends: plain", "ends: periodic"), "layers: 8", "layers: 1"))
                .resolution.layers,
            1);
}

}  // namespace
}  // namespace millfoam::meshing
