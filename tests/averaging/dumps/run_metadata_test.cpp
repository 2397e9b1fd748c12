// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/dumps/run_metadata.hpp"

#include <gtest/gtest.h>

#include "tests/averaging/test_support.hpp"

namespace millfoam::averaging {
namespace {

struct Metadata : ::testing::Test {
  TemporaryFolder folder;

  RunMetadata read(const std::string& text) const {
    return read_run_metadata(folder.write("run.json", text).parent_path()).value();
  }
  std::string refusal(const std::string& text) const {
    return message_of<DumpError>([&] { read(text); });
  }
};

TEST_F(Metadata, GiveWhatTheDryRunWas) {
  const RunMetadata metadata =
      read(R"({"format": "millfoam-dumps", "program": "millDem 1", "mill": {"charge": "0a1b"},
    "timestep_s": 2e-06, "interval": 1000, "angular_velocity_rad_s": -6.395, "duration_s": 3})");
  EXPECT_EQ(metadata.timestep, 2e-6);
  EXPECT_EQ(metadata.interval, 1000);
  EXPECT_EQ(metadata.angular_velocity, -6.395);
  EXPECT_EQ(metadata.mill_charge, "0a1b");
  EXPECT_FALSE(metadata.fines_share);
}

TEST_F(Metadata, MayLackAnyKey) {
  for (const char* text : {"{}", R"({"timestep_s": null, "mill": {}})", R"({"mill": null})"}) {
    const RunMetadata metadata = read(text);
    EXPECT_FALSE(metadata.timestep || metadata.interval || metadata.angular_velocity || metadata.fines_share);
    EXPECT_EQ(metadata.mill_charge, "");
  }
  EXPECT_FALSE(read_run_metadata(folder / "elsewhere"));
}

TEST_F(Metadata, AreIdentifiedByTheirBytes) {
  // By another program of the definition, which gives "foobar" the published 85944171f73967e8.
  EXPECT_EQ(read("{}").run_id, "08f44b07b5901a25");
  EXPECT_NE(read("{ }").run_id, read("{}").run_id);
}

TEST_F(Metadata, GiveTheShareOfTheFinesByMass) {
  EXPECT_EQ(read(R"({"fines_mass_kg": 1, "charge_mass_kg": 3})").fines_share, 0.25);
  EXPECT_EQ(read(R"({"fines_mass_kg": 0, "charge_mass_kg": 3})").fines_share, 0);
  EXPECT_FALSE(read(R"({"fines_mass_kg": 0, "charge_mass_kg": 0})").fines_share);
  EXPECT_FALSE(read(R"({"fines_mass_kg": 1})").fines_share);
}

TEST_F(Metadata, AValueThatCannotBeIsRefusedByFileAndKey) {
  const std::vector<std::vector<std::string>> cases{
      {R"({"timestep_s": "zero"})", "timestep_s", "\"zero\"", "positive"},
      {R"({"timestep_s": 0})", "timestep_s", "is 0", "positive"},
      {R"({"timestep_s": [1]})", "timestep_s", "[1]", "positive"},
      {R"({"interval": 10.5})", "interval", "10.5", "whole"},
      {R"({"interval": -10})", "interval", "-10", "positive"},
      {R"({"angular_velocity_rad_s": true})", "angular_velocity_rad_s", "true", "finite"},
      {R"({"fines_mass_kg": -1})", "fines_mass_kg", "-1", "kg"},
      {R"({"mill": "0a1b"})", "'mill'", "\"0a1b\"", "object"},
      {R"({"mill": {"charge": 17}})", "mill.charge", "17", "text"},
      {R"({"format": "millfoam-plan"})", "format", "millfoam-plan", "millfoam-dumps"}};
  for (const std::vector<std::string>& parts : cases) {
    const std::string message = refusal(parts[0]);
    expect_named(message, {"run.json: key", parts[1], parts[2], parts[3]});
  }
}

TEST_F(Metadata, TextThatIsNoObjectIsRefusedWithItsLine) {
  expect_named(refusal("{\n\"interval\": 10,\ntimestep 1\n}"), {"run.json:3: ", "JSON"});
  expect_named(refusal("timestep 1e-4\ninterval 100\n"), {"run.json:1: ", "JSON"});
  expect_named(refusal(""), {"run.json:1: ", "JSON"});
  expect_named(refusal("{\"timestep_s\": 1e999}"), {"run.json", "1e999"});
  expect_named(refusal("[1, 2]"), {"run.json: expected an object"});
}

TEST_F(Metadata, ATimestepThatContradictsThemIsRefusedWithBothValues) {
  const RunMetadata metadata = read(R"({"timestep_s": 2e-06})");
  EXPECT_EQ(agreed_timestep({}, metadata), 2e-6);
  EXPECT_EQ(agreed_timestep(2e-6, metadata), 2e-6);
  const auto other = [&] { agreed_timestep(1e-5, metadata); };
  expect_named(message_of<DumpError>(other), {"1e-05", "2e-06", "run.json", "timestep_s"});
}

TEST_F(Metadata, WithoutThemTheTimestepMustBeGiven) {
  EXPECT_EQ(agreed_timestep(1e-6, std::nullopt), 1e-6);
  expect_named(message_of<DumpError>([] { agreed_timestep(std::nullopt, std::nullopt); }),
               {"--dt", "run.json", "timestep_s"});
  expect_named(message_of<DumpError>([] { agreed_timestep(-1e-6, std::nullopt); }), {"-1e-06", "positive"});
}

TEST_F(Metadata, AnAngularVelocityThatContradictsTheOptionIsRefused) {
  const RunMetadata metadata = read(R"({"angular_velocity_rad_s": -6.4})");
  EXPECT_EQ(agreed_angular_velocity(std::nullopt, metadata), -6.4);
  EXPECT_EQ(agreed_angular_velocity(-6.4, metadata), -6.4);
  EXPECT_EQ(agreed_angular_velocity(3.0, std::nullopt), 3.0);
  EXPECT_EQ(agreed_angular_velocity(std::nullopt, std::nullopt), std::nullopt);
  expect_named(message_of<DumpError>([&] { agreed_angular_velocity(3.0, metadata); }),
               {"--speed", "3", "-6.4", "run.json", "angular_velocity_rad_s"});
}

}  // namespace
}  // namespace millfoam::averaging
