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

/// The message with which a mill is refused.
std::string refusal(const std::string& text, const std::vector<std::string>& set = {}) {
  try {
    read(text, set);
  } catch (const MillError& error) {
    return error.what();
  }
  return "";
}

/// Names a part of the message, without the name of the temporary file.
::testing::AssertionResult says(const std::string& message, const std::string& part) {
  if (message.find(part) != std::string::npos) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << "'" << message << "' does not say '" << part << "'";
}

TEST(StirredMill, turns_its_impeller_in_a_shell_at_rest) {
  const Mill mill = read(stirred_mill);
  EXPECT_EQ(mill.machine(), Machine::stirred);
  EXPECT_EQ(read(example_mill).machine(), Machine::tumbling);
  EXPECT_DOUBLE_EQ(mill.angular_velocity, 31.416);
  EXPECT_DOUBLE_EQ(impeller_radius(*mill.geometry.impeller), 0.0705);
  EXPECT_DOUBLE_EQ(impeller_top(*mill.geometry.impeller), 0.0775);
}

TEST(StirredMill, speed_of_the_tips_is_that_of_the_pins) {
  const std::string tips =
      with(stirred_mill, "{angular_velocity: 31.416}", "{tip_speed: 1.846, sense: clockwise}");
  EXPECT_NEAR(read(tips).angular_velocity, -1.846 / 0.0705, 1e-12);
  EXPECT_NEAR(read(stirred_mill, {"speed.tip_speed=1.477"}).angular_velocity, 20.95, 0.01);
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
    const Mill mill = read(stirred_mill, {"geometry.diameter=" + std::to_string(diameter),
                                          "geometry.impeller.pins[0].length=" + std::to_string(length),
                                          "geometry.impeller.pins[1].length=" + std::to_string(length)});
    const ChargeNumbers charge = count_charge(mill);
    EXPECT_NEAR(static_cast<double>(charge.balls) / static_cast<double>(balls), 1, 1e-3);
    EXPECT_NEAR(charge.volume / slurry, 1, 1e-3);
  }
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
  EXPECT_TRUE(says(set("charge.diameter=0.008"), "the gap between the impeller and the shell, 0.007 m"));
  EXPECT_TRUE(says(set("charge.level=0.5"), "up to the mill's"));
  EXPECT_TRUE(says(set("speed.tip_speed=500"), "a speed of the pins' tips"));
  EXPECT_TRUE(says(set("flow.turns=3"), "only the dry run is computed"));
  EXPECT_TRUE(says(set("machine=planetary"), "tumbling"));
  EXPECT_TRUE(says(set("geometry.lifters.count=3"), "'geometry.lifters' is unknown"));
}

TEST(StirredMill, resolved_it_is_the_same_mill) {
  const TemporaryFolder folder;
  const MillDescription first = describe(stirred_mill, {"dem.contact_interval=0.01"});
  const Json one = resolved_mill(first, "test");
  const Json two = resolved_mill(describe_mill(folder.write("mill.json", one.dump(2))), "test");
  EXPECT_EQ(one["mill"], two["mill"]);
  EXPECT_EQ(one["derived"], two["derived"]);
  EXPECT_EQ(one["fingerprint"], two["fingerprint"]);
  EXPECT_EQ(one["derived"]["machine"], "stirred");
  EXPECT_NEAR(one["derived"]["geometry"]["impeller"]["gap_m"].get<double>(), 0.007, 1e-12);
  EXPECT_NEAR(one["derived"]["speed"]["tip_speed_m_s"].get<double>(), 2.2148, 1e-4);
}

TEST(StirredMill, tumbling_mills_keep_their_fingerprints) {
  const MillFingerprints usual = read(example_mill).fingerprint;
  const MillFingerprints named = read("machine: tumbling\n" + example_mill).fingerprint;
  EXPECT_EQ(usual.flow, named.flow);
  EXPECT_EQ(usual.charge, named.charge);
}

}  // namespace
}  // namespace millfoam::meshing
