// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/averages_order.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <variant>

#include "dem_driver/contact_record.hpp"
#include "dem_driver/deck.hpp"
#include "dem_driver/disk_room.hpp"
#include "dem_driver/folder_preparation.hpp"
#include "dem_driver/output_check.hpp"
#include "dem_driver/segments.hpp"
#include "small_mill.hpp"

namespace millfoam::dem_driver {
namespace {

namespace fs = std::filesystem;

using averaging::AverageRequest;
using averaging::BoxGrid;
using averaging::CylinderGrid;
using averaging::MeshRequest;
using tests::message_of;
using tests::small_mill;
using tests::TemporaryFolder;

struct Averages : ::testing::Test {
  fs::path before = fs::current_path();  ///< the working folder, which tests may change
  TemporaryFolder temporary;
  CaseFolder folder{temporary.path()};
  AveragesOrder order{{{1.0 / 3e5, -12.5, 0.0028}, 200, 100, 250}, {}};

  Averages() {
    fs::create_directories(folder.dem());
    fs::create_directories(folder.walls());
    for (const char* name : {"shell.stl", "lifters.stl", "mesh.h5", "turn.txt"}) write(name, name);
  }
  ~Averages() override { fs::current_path(before); }
  fs::path place(const std::string& name) const { return folder.walls() / name; }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(place(name), std::ios::binary) << text;
  }
  AverageRequest box() const {
    AverageRequest request(BoxGrid({-0.02, -0.02, 0}, {0.02, 0.02, 0.012}, {7, 7, 3}, {false, false, true}));
    request.walls = {place("shell.stl"), place("lifters.stl")};
    request.windows = {{0.1 / 3, temporary.path() / "solids.h5"},
                       {std::nullopt, temporary.path() / "whole.h5"}};
    request.start = 0.1;
    return request;
  }
  AverageRequest cells() const {
    MeshRequest mesh;
    mesh.file = place("mesh.h5");
    mesh.motion = {"rotation table " + place("turn.txt").string() + " axis 0 0 1",
                   "translation velocity 1 0 0"};
    mesh.period_z = 0.012;
    mesh.smoothed = true;
    AverageRequest request(mesh);
    request.windows = {{0.05, temporary.path() / "cells.h5"}};
    request.end = 0.7;
    request.method = averaging::DepositionMethod::sample;
    request.template_points = 9;
    request.solidity_cap = 0.63;
    request.largest_outside = 0.8;
    return request;
  }
};

TEST_F(Averages, AreReadBackAsTheyWereOrdered) {
  // A folder with a blank in its name would end the name of a table
  averaging::CylinderRequest rings(CylinderGrid({0.001, 0.02}, {0, 0.012}, {4, 8, 2}, true));
  rings.turning = true;
  for (const AverageRequest& request : {box(), AverageRequest(rings)})
    order.averages.push_back({averages_id(request), request});
  write_averages_order(folder.averages_order(), small_mill(), order);
  const AveragesOrder found = read_averages_order(folder.averages_order());
  EXPECT_EQ(found.run.settings.timestep, order.run.settings.timestep);
  EXPECT_EQ(found.run.settings.angular_velocity, order.run.settings.angular_velocity);
  EXPECT_EQ(found.run.settings.sauter_diameter, order.run.settings.sauter_diameter);
  EXPECT_EQ(found.run.begin, 200);
  EXPECT_EQ(found.run.interval, 100);
  EXPECT_EQ(found.run.balls, 250);
  ASSERT_EQ(found.averages.size(), 2U);
  for (std::size_t n = 0; n < 2; ++n) {
    EXPECT_EQ(found.averages[n].id, order.averages[n].id);
    // Which has every setting
    EXPECT_EQ(averages_id(found.averages[n].request), order.averages[n].id);
  }
  EXPECT_TRUE(std::get<averaging::CylinderRequest>(found.averages[1].request.grid).turning);
  const AverageRequest& first = found.averages[0].request;
  EXPECT_EQ(std::get<BoxGrid>(first.grid).upper(), std::get<BoxGrid>(box().grid).upper());
  EXPECT_EQ(first.windows[0].length, 0.1 / 3);
  EXPECT_FALSE(first.windows[1].length);
  EXPECT_TRUE(fs::equivalent(first.walls[1], place("lifters.stl")));
}

TEST_F(Averages, OfAMeshAreReadBackWithItsFilesFoundFromTheFolderOfTheOrder) {
  fs::current_path(temporary.path());
  AverageRequest request = cells();
  auto& mesh = std::get<MeshRequest>(request.grid);
  mesh.file = "walls/mesh.h5";
  mesh.motion[0] = "rotation table walls/turn.txt axis 0 0 1";
  order.averages = {{averages_id(request), request}};
  write_averages_order(folder.averages_order(), small_mill(), order);
  fs::current_path(folder.dem());
  const AverageRequest found = read_averages_order("averages.json").averages.at(0).request;
  const auto& cells_of = std::get<MeshRequest>(found.grid);
  EXPECT_EQ(cells_of.file, "../walls/mesh.h5");
  ASSERT_EQ(cells_of.motion.size(), 2U);
  EXPECT_EQ(cells_of.motion[0], "rotation table ../walls/turn.txt axis 0 0 1");
  EXPECT_EQ(cells_of.motion[1], "translation velocity 1 0 0");
  EXPECT_EQ(averages_id(found), order.averages[0].id);
}

TEST_F(Averages, HaveAnIdThatChangesWithAllThatChangesThemButNotWithTheNameOfTheirFile) {
  const std::string id = averages_id(box());
  AverageRequest same = box();
  same.windows[0].output = "other.h5";
  EXPECT_EQ(averages_id(same), id);
  const auto change = [&](auto&& action) {
    AverageRequest other = box();
    action(other);
    EXPECT_NE(averages_id(other), id);
  };
  change([](AverageRequest& r) { r.start = 0.2; });
  change([](AverageRequest& r) { r.end = 0.2; });
  change([](AverageRequest& r) { r.windows[0].length = 0.04; });
  change([](AverageRequest& r) { r.windows.pop_back(); });
  change([](AverageRequest& r) { r.solidity_cap = 0.6; });
  change([](AverageRequest& r) { r.method = averaging::DepositionMethod::sample; });
  change([](AverageRequest& r) { r.grid = BoxGrid({-0.02, -0.02, 0}, {0.02, 0.02, 0.012}, {7, 7, 3}); });
  write("shell.stl", "another wall");
  EXPECT_NE(averages_id(box()), id);
}

TEST_F(Averages, OfAFileThatIsDamagedAreRefusedByName) {
  const auto refusal = [&] { return message_of([&] { read_averages_order(folder.averages_order()); }); };
  EXPECT_NE(refusal().find("averages.json: cannot be read"), std::string::npos);
  std::ofstream(folder.averages_order()) << "{\"format\": \"millfoam-fluid\"}";
  EXPECT_NE(refusal().find("is not of the format millfoam-live-averages"), std::string::npos);
  order.averages = {{averages_id(box()), box()}};
  write_averages_order(folder.averages_order(), small_mill(), order);
  auto json = tests::read_json(folder.averages_order());
  json["averages"][0].erase("method");
  std::ofstream(folder.averages_order()) << json;
  EXPECT_NE(refusal().find("key 'averages[0].method' is missing"), std::string::npos) << refusal();
}

TEST_F(Averages, TakePartInTheDeckWhichHasNoDumpsWhereNoneAreWished) {
  auto mill = small_mill();
  const auto deck_of = [&](const DemPlan& plan) {
    std::ostringstream out;
    write_deck(out, mill, plan, {"shell"}, 1);
    return out.str();
  };
  EXPECT_EQ(deck_of(plan_dem(mill)).find("averages"), std::string::npos);
  mill.dem.dumps = false;
  DemPlan plan = plan_dem(mill);
  EXPECT_EQ(plan.dumps, 0);
  EXPECT_EQ(plan.records, 31);
  plan.averages = {"0123456789abcdef", "fedcba9876543210"};
  const std::string deck = deck_of(plan);
  EXPECT_NE(deck.find("# averages 0123456789abcdef fedcba9876543210: need millLiggghts and averages.json\n"
                      "fix averages all external pf/callback 1 1\n"),
            std::string::npos);
  EXPECT_EQ(deck.find("dump "), std::string::npos);
  EXPECT_NE(deck.find("variable now equal step\n"), std::string::npos);
}

TEST_F(Averages, AreNeededByARestartFileAndGoWithIt) {
  DemPlan plan = plan_dem(small_mill());
  plan.dumps = 0;
  plan.averages = {averages_id(box())};
  const averaging::LiveFiles files = averages_files(folder.dem(), 0);
  averaging::Communicator alone;
  const averaging::LiveRun run{{plan.step.value, 0, 0.0025}, 0, plan.restart_steps, 0};
  AverageRequest request(BoxGrid({0, 0, 0}, {1, 1, 1}, {2, 2, 2}));
  request.windows = {{std::nullopt, {}}};
  averaging::LiveAverages averages(request, run, files, plan.averages[0], std::nullopt, alone);
  for (long part = 0; part <= 3; ++part) {
    averages.add({part * plan.restart_steps, {}, {}});
    averages.checkpoint();
    if (part > 0)
      tests::write_restart(folder.dem() / ("restart." + std::to_string(part * plan.restart_steps)), {250});
  }
  tests::write_rows(folder, plan, 3 * plan.restart_steps);
  EXPECT_EQ(last_good_restart(folder, plan), 3 * plan.restart_steps);
  // So do the open contacts where they are followed
  plan.watches_contacts = true;
  write_contact_state(folder.dem(), plan.restart_steps, {});
  EXPECT_EQ(last_good_restart(folder, plan), plan.restart_steps);
  plan.watches_contacts = false;
  const fs::path later = folder.dem() / ("torque." + std::to_string(3 * plan.restart_steps) + ".txt");
  const fs::path earlier = folder.dem() / ("torque." + std::to_string(2 * plan.restart_steps) + ".txt");
  for (const fs::path& history : {earlier, later}) std::ofstream(history) << "# a history\n";
  fs::resize_file(files.checkpoint(3 * plan.restart_steps), 10);
  EXPECT_EQ(last_good_restart(folder, plan), 2 * plan.restart_steps);
  OutputCheck check(folder, plan, 0);
  EXPECT_EQ(message_of([&] { check.restart(2 * plan.restart_steps); }), "");
  const std::string message = message_of([&] { check.restart(3 * plan.restart_steps); });
  EXPECT_NE(message.find("there is no state of the averages of this step"), std::string::npos) << message;
  EXPECT_NE(message.find("--resume continues from step " + std::to_string(2 * plan.restart_steps)),
            std::string::npos)
      << message;
  remove_restarts_after(folder, 2 * plan.restart_steps);
  remove_restarts_before(folder, 2 * plan.restart_steps);
  EXPECT_TRUE(fs::exists(files.checkpoint(2 * plan.restart_steps)));
  EXPECT_FALSE(fs::exists(files.checkpoint(plan.restart_steps)));
  EXPECT_FALSE(fs::exists(files.checkpoint(3 * plan.restart_steps)));
  EXPECT_TRUE(fs::exists(files.journal(0)));
  EXPECT_TRUE(fs::exists(earlier));
  EXPECT_FALSE(fs::exists(later)) << "it begins after the step";
  prepare_folders(folder);
  EXPECT_TRUE(find_averages(folder).empty());
}

TEST_F(Averages, WithoutDumpsNeedLessRoomOnTheDisk) {
  auto mill = small_mill();
  const double dumps = least_disk(plan_dem(mill), 0);
  mill.dem.dumps = false;
  DemPlan plan = plan_dem(mill);
  const double none = least_disk(plan, 0);
  EXPECT_LT(none, dumps / 5);
  plan.averages_bytes = 1e6;
  EXPECT_NEAR(least_disk(plan, 0) - none, 1e6, 1);
  EXPECT_NEAR(least_disk(plan, plan.turning_steps / 2) - none, 5e5, 1);
  mill.averages.live = true;
  mill.averages.voxels.shape = {5, 4, 3};
  mill.averages.window = mill.dem.duration / 7;
  EXPECT_NEAR(plan_dem(mill).averages_bytes, 7 * 60 * 13 * 8, 1);
}

}  // namespace
}  // namespace millfoam::dem_driver
