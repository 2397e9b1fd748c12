// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/run/summary_file.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "averaging/run/program.hpp"
#include "tests/averaging/test_support.hpp"

namespace millfoam::averaging {
namespace {

using Json = nlohmann::ordered_json;

/// Two windows of 0.5 s from 1 s on, of one and of three records.
struct Summary : ::testing::Test {
  TemporaryFolder folder;
  SolidsSummary summary{"somewhere/solids.h5", {}, "box", {2, 3, 4}, {}};

  Summary() {
    summary.header.time0 = 1;
    summary.header.timestep = 1e-4;
    summary.header.method = "exact";
    WindowSummary window;
    window.time = {1, 1.5, 1, false, false};
    window.ledger = {8, 6, 2, 1};
    window.balls_per_cell = 10;
    window.occupied_cells = 4;
    window.occupied_volume = 1;
    window.ball_density = 80;
    window.mean_solidity = 0.3;
    window.largest_solidity = 0.5;
    summary.windows.push_back(window);
    window.time = {1.5, 2, 3, false, false, 3};
    window.ledger = {4, 4, 0, 1};
    window.balls_per_cell = 20;
    window.largest_solidity = 0.6;
    summary.windows.push_back(window);
  }

  Json json() const { return Json::parse(as_json(summary, program())); }
};

TEST_F(Summary, HoldsTheLedgerWindowByWindow) {
  const Json windows = json()["per_window"];
  EXPECT_EQ(windows["begin_s"], Json({1.0, 1.5}));
  EXPECT_EQ(windows["end_s"], Json({1.5, 2.0}));
  EXPECT_EQ(windows["records"], Json({1, 3}));
  EXPECT_EQ(windows["expected_records"], Json({nullptr, 3}));
  EXPECT_EQ(windows["starts_late"], Json({false, false}));
  EXPECT_EQ(windows["ends_short"], Json({false, false}));
  EXPECT_EQ(windows["volume_in_m3"], Json({8.0, 4.0}));
  EXPECT_EQ(windows["deposited_m3"], Json({6.0, 4.0}));
  EXPECT_EQ(windows["outside_m3"], Json({2.0, 0.0}));
  EXPECT_EQ(windows["clipped_m3"], Json({1.0, 1.0}));
  EXPECT_EQ(windows["balls_per_cell"], Json({10.0, 20.0}));
}

TEST_F(Summary, HoldsWhatThatComesTo) {
  const Json all = json();
  EXPECT_EQ(all.begin().key(), "format");
  EXPECT_EQ(all["format"], "millfoam-averages");
  EXPECT_EQ(all["program"], program());
  EXPECT_EQ(all["file"], "solids.h5");
  EXPECT_EQ(all["time0_s"], 1);
  EXPECT_EQ(all["end_s"], 2);
  EXPECT_EQ(all["windows"], 2);
  EXPECT_EQ(all["window_s"], 0.5);
  EXPECT_EQ(all["records"], 4);
  EXPECT_EQ(all["shape"], Json({2, 3, 4}));
  EXPECT_EQ(all["volume_in_m3"], 5) << "mean over the records";
  EXPECT_EQ(all["largest_outside"], 0.25);
  EXPECT_EQ(all["largest_clipped"], 0.25);
  EXPECT_EQ(all["balls_per_cell"], 15);
  EXPECT_EQ(all["largest_solidity"], 0.6);
  EXPECT_EQ(all["advice"], Json::array());
  ASSERT_EQ(all["warnings"].size(), 2U);
  expect_named(all["warnings"][0], {"25 % of the balls' volume lies outside the grid"});
  expect_named(all["warnings"][1], {"25 % of the balls' volume was moved out of cells outside of the walls"});
}

TEST_F(Summary, NamesTheMillAndTheRunWhereTheyAreKnown) {
  EXPECT_EQ(json()["mill"], Json::object());
  for (const char* key : {"run_id", "fines_share", "angular_velocity_rad_s", "solidity_cap"}) {
    EXPECT_TRUE(json().at(key).is_null()) << key;
  }
  summary.header.mill_charge = "00";
  summary.header.mill_averages = "11";
  summary.header.run_id = "22";
  EXPECT_EQ(json()["mill"], Json({{"charge", "00"}, {"averages", "11"}}));
  EXPECT_EQ(json()["run_id"], "22");
}

TEST_F(Summary, SaysWhenFinesAreLeftOut) {
  summary.header.fines_share = 0;
  EXPECT_EQ(json()["advice"], Json::array());
  summary.header.fines_share = 0.5;
  EXPECT_EQ(json()["fines_share"], 0.5);
  ASSERT_EQ(json()["advice"].size(), 1U);
  expect_named(json()["advice"][0], {"50.0 % of the charge's mass are fines"});
  expect_named(report(summary), {"advice: 50.0 % of the charge's mass are fines"});
}

TEST_F(Summary, WarnsOfBallsOutsideFromOnePercentOn) {
  for (WindowSummary& window : summary.windows) window.ledger.clipped = 0;
  for (const double part : {0.009, 0.011}) {
    for (WindowSummary& window : summary.windows) window.ledger.outside = part * window.ledger.volume_in;
    EXPECT_EQ(json()["warnings"].size(), part > noted_outside ? 1U : 0U);
  }
}

TEST_F(Summary, WarnsOfWallsThatCutBallsOffFromOnePercentOnUnlessACapMovesThem) {
  for (const double part : {0.009, 0.011}) {
    for (WindowSummary& window : summary.windows)
      window.ledger = {window.ledger.volume_in, window.ledger.deposited, 0, part * window.ledger.volume_in};
    EXPECT_EQ(json()["warnings"].size(), part > noted_clipped ? 1U : 0U);
  }
  summary.header.solidity_cap = 0.6;
  EXPECT_EQ(json()["warnings"].size(), 0U);
}

TEST_F(Summary, WarnsOfRecordsThatAreMissingInWindows) {
  for (WindowSummary& window : summary.windows) window.ledger = {4, 4, 0, 0};
  EXPECT_EQ(json()["warnings"], Json::array());
  summary.windows[1].time.expected = 5;
  EXPECT_EQ(json()["warnings"],
            Json({"records are missing in 1 of 2 windows: window 1 from 1.5 to 2 s has 3 of 5 "
                  "records"}));
  summary.windows[0].time.starts_late = summary.windows[0].time.ends_short = true;
  EXPECT_EQ(json()["per_window"]["starts_late"], Json({true, false}));
  expect_named(report(summary),
               {"warning: records are missing in 2 of 2 windows: window 0 from 1 to 1.5 s has 1 "
                "records, starts late, ends short, …"});
}

TEST_F(Summary, KeepsAdviceAndWarningsApart) {
  for (WindowSummary& window : summary.windows) window.ledger.clipped = 0;
  summary.windows[0].ledger.outside = 0;
  summary.windows[0].small_cells = 2;
  summary.windows[1].largest_solidity = 1.2;
  ASSERT_EQ(json()["advice"].size(), 1U);
  ASSERT_EQ(json()["warnings"].size(), 1U);
  expect_named(json()["advice"][0], {"25.0 % of the occupied cells are smaller than a ball"});
  expect_named(json()["warnings"][0], {"the largest solidity leaves no room"});
}

TEST_F(Summary, HasNullForWhatIsNoNumber) {
  summary.windows[0].balls_per_cell = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(json()["per_window"]["balls_per_cell"][0].is_null());
}

TEST_F(Summary, LiesBesideTheSolidsFile) {
  EXPECT_EQ(summary_path("a/solids.h5"), "a/solids.json");
  expect_named(message_of<SolidsFileError>([] { summary_path("solids.json"); }),
               {"solids.json", "solids.h5"});
}

TEST_F(Summary, ReplacesItsOwnKindOnly) {
  const std::filesystem::path file = folder / "solids.json";
  for (const double begin : {1.0, 3.0}) {
    summary.header.time0 = begin;
    require_summary_or_nothing(file);
    write_summary(file, summary, program());
    std::ifstream input(file);
    EXPECT_EQ(Json::parse(input)["time0_s"], begin);
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "solids.json.part"));
  for (const char* text : {R"({"format": "millfoam-mill"})", "[1]", "{}", "diameter: 1", ""}) {
    folder.write("solids.json", text);
    expect_named(message_of<SolidsFileError>([&] { require_summary_or_nothing(file); }),
                 {"solids.json", "exists and is not a millfoam-averages file"});
  }
}

TEST_F(Summary, ThatCannotBeWrittenIsToldByName) {
  const auto write = [&] { write_summary(folder / "none/solids.json", summary, program()); };
  expect_named(message_of<SolidsFileError>(write), {"none/solids.json", "cannot write"});
}

}  // namespace
}  // namespace millfoam::averaging
