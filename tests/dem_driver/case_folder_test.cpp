// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/case_folder.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <optional>
#include <thread>

#include "dem_driver/folder_preparation.hpp"
#include "dem_driver/run_file.hpp"
#include "dem_driver/segments.hpp"
#include "dem_driver/wall_parts.hpp"
#include "millfoam_version.hpp"
#include "small_mill.hpp"

namespace millfoam::dem_driver {
namespace {

using tests::message_of;
using tests::small_mill;
using tests::TemporaryFolder;

void touch(const std::filesystem::path& file) {
  std::filesystem::create_directories(file.parent_path());
  std::ofstream(file) << "x\n";
}

TEST(CaseFolder, OnlyDumpsAndRunFileOfAnEarlierRunAreRemoved) {
  const TemporaryFolder temporary;
  const CaseFolder folder{temporary.path()};
  for (const char* name : {"dump.0.txt", "dump.50.txt", "run.json", "results.json", "dump.0.gz", "notes.txt"})
    touch(folder.dumps() / name);
  EXPECT_EQ(prepare_folders(folder), 2u);
  EXPECT_TRUE(find_dumps(folder).empty());
  EXPECT_FALSE(std::filesystem::exists(folder.run_file()));
  EXPECT_FALSE(std::filesystem::exists(folder.results()));
  EXPECT_TRUE(std::filesystem::exists(folder.dumps() / "dump.0.gz"));
  EXPECT_TRUE(std::filesystem::exists(folder.dumps() / "notes.txt"));
}

void touch_contacts(const CaseFolder& folder, const std::vector<int>& steps) {
  for (const std::string kind : contact_kinds)
    for (const int step : steps) touch(folder.contacts() / (kind + '.' + std::to_string(step) + ".txt"));
}

TEST(CaseFolder, ContactsOfAnEarlierRunAreRemovedAndNothingElse) {
  const TemporaryFolder temporary;
  const CaseFolder folder{temporary.path()};
  touch_contacts(folder, {0, 50});
  touch(folder.contacts() / "spectra.csv");
  EXPECT_EQ(prepare_folders(folder), 0u);
  for (const char* kind : contact_kinds) EXPECT_TRUE(find_contacts(folder, kind).empty());
  EXPECT_TRUE(std::filesystem::exists(folder.contacts() / "spectra.csv"));
}

TEST(CaseFolder, ContactsAfterTheRestartFileGoWithTheDumps) {
  const TemporaryFolder temporary;
  const CaseFolder folder{temporary.path()};
  touch_contacts(folder, {0, 50, 100});
  remove_dumps_after(folder, 60);
  for (const char* kind : contact_kinds) {
    const auto left = find_contacts(folder, kind);
    ASSERT_EQ(left.size(), 2u) << kind;
    EXPECT_EQ(left.back().step, 50);
  }
}

TEST(CaseFolder, ContactsThatAreMissingAreCounted) {
  const TemporaryFolder temporary;
  const CaseFolder folder{temporary.path()};
  DemPlan plan;
  EXPECT_EQ(contacts_complaint(folder, plan, 120), "");
  plan.contact_steps = 50;
  touch_contacts(folder, {0, 50, 100, 150});
  EXPECT_EQ(contacts_complaint(folder, plan, 120), "");
  std::filesystem::remove(folder.contacts() / "walls.50.txt");
  EXPECT_EQ(contacts_complaint(folder, plan, 120),
            folder.contacts().string() + ": 2 walls up to step 120, expected 3");
  EXPECT_EQ(contacts_complaint(folder, plan, 49), "");
}

TEST(CaseFolder, IsLockedByOneRunAtATime) {
  const TemporaryFolder temporary;
  const CaseFolder folder{temporary.path()};
  prepare_folders(folder);
  {
    const averaging::FileLock first = lock_folder(folder);
    EXPECT_EQ(message_of([&] { lock_folder(folder, std::chrono::milliseconds(150)); }),
              folder.dem().string() + ": another millDem runs in this folder, expected one at a time");
  }
  EXPECT_EQ(message_of([&] { lock_folder(folder, std::chrono::milliseconds(0)); }), "");
}

TEST(CaseFolder, LockWaitsForProgramsThatAKilledRunHasLeft) {
  const TemporaryFolder temporary;
  const CaseFolder folder{temporary.path()};
  prepare_folders(folder);
  std::optional<averaging::FileLock> first(lock_folder(folder));
  std::thread ends([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(250));
    first.reset();
  });
  EXPECT_EQ(message_of([&] { lock_folder(folder); }), "");
  ends.join();
}

TEST(CaseFolder, AMissingWallIsNamed) {
  const TemporaryFolder temporary;
  const CaseFolder folder{temporary.path()};
  auto mill = small_mill();
  mill.geometry.ends = meshing::Ends::plain;
  mill.geometry.lifters = {4, 0.002, 0.002};
  tests::write_drum(folder, mill.geometry);
  for (const char* part : {"lifters.stl", "feedEnd.stl"})
    std::filesystem::copy_file(folder.walls() / "shell.stl", folder.walls() / part);
  const std::string message = message_of([&] { find_walls(folder, mill); });
  EXPECT_NE(message.find("dischargeEnd.stl"), std::string::npos);
  EXPECT_NE(message.find("millMesh"), std::string::npos);
}

TEST(CaseFolder, APeriodicSliceHasNoEndsEvenIfTheirFilesLieThere) {
  const TemporaryFolder temporary;
  const CaseFolder folder{temporary.path()};
  tests::write_drum(folder, small_mill().geometry);
  touch(folder.walls() / "feedEnd.stl");
  EXPECT_EQ(find_walls(folder, small_mill()), std::vector<std::string>{"shell"});
}

TEST(CaseFolder, LiftersFromCadAreThereWithoutAnyInTheMill) {
  const TemporaryFolder temporary;
  const CaseFolder folder{temporary.path()};
  const auto mill = small_mill();
  ASSERT_EQ(mill.geometry.lifters.count, 0);
  tests::write_drum(folder, mill.geometry);
  std::filesystem::copy_file(folder.walls() / "shell.stl", folder.walls() / "lifters.stl");
  EXPECT_EQ(find_walls(folder, mill), (std::vector<std::string>{"shell", "lifters"}));
}

TEST(CaseFolder, AWallThatIsCutIsNamed) {
  const TemporaryFolder temporary;
  const CaseFolder folder{temporary.path()};
  tests::write_drum(folder, small_mill().geometry);
  const auto shell = folder.walls() / "shell.stl";
  std::filesystem::resize_file(shell, std::filesystem::file_size(shell) / 2);
  const std::string message = message_of([&] { find_walls(folder, small_mill()); });
  EXPECT_EQ(message.rfind(shell.string() + ':', 0), 0u) << message;
  EXPECT_NE(message.find("is cut short"), std::string::npos) << message;
}

TEST(CaseFolder, TheRunFileGivesWhatReadersOfTheDumpsNeedToFullPrecision) {
  const TemporaryFolder temporary;
  const CaseFolder folder{temporary.path()};
  auto mill = small_mill();
  mill.charge.fines_below = 0.0025;
  mill.fingerprint = {"w", "c", "a", "f"};
  const DemPlan plan = plan_dem(mill);
  prepare_folders(folder);
  write_run_file(folder, mill, plan);
  EXPECT_EQ(tests::read_json(folder.run_file()),
            (nlohmann::json{{"format", "millfoam-dumps"},
                            {"program", std::string("millDem ") + version()},
                            {"mill", {{"walls", "w"}, {"charge", "c"}}},
                            {"timestep_s", plan.step.value},
                            {"interval", plan.step.steps_per_record},
                            {"dumps", 31},
                            {"angular_velocity_rad_s", -12.0},
                            {"begin_s", 0.0},
                            {"duration_s", plan.duration()},
                            {"fluid", {{"kind", "none"}}},
                            {"charge_mass_kg", plan.charge.mass()},
                            {"fines_mass_kg", mill.charge.classes.at(0).mass}}));
  write_run_file(folder, mill, plan, {{"shell", "0123456789abcdef"}});
  EXPECT_EQ(tests::read_json(folder.run_file())["wall_files"],
            (nlohmann::json{{"shell", "0123456789abcdef"}}));
}

/// A drum with plain ends, whose shell is closed at both or only at its feed end.
void write_body(const CaseFolder& folder, const meshing::Geometry& geometry, bool closed_at_discharge) {
  std::filesystem::create_directories(folder.walls());
  std::ofstream out(folder.walls() / "shell.stl");
  out << "solid shell\n";
  tests::write_shell(out, geometry);
  tests::write_disc(out, geometry, 0);
  if (closed_at_discharge) tests::write_disc(out, geometry, geometry.length);
  out << "endsolid shell\n";
}

TEST(CaseFolder, AnEndMayBeMissingOnlyWhereTheShellClosesIt) {
  const TemporaryFolder temporary;
  const CaseFolder folder{temporary.path()};
  auto mill = small_mill();
  mill.geometry.ends = meshing::Ends::plain;
  write_body(folder, mill.geometry, true);
  EXPECT_EQ(find_walls(folder, mill), std::vector<std::string>{"shell"});
  write_body(folder, mill.geometry, false);
  EXPECT_EQ(message_of([&] { find_walls(folder, mill); }),
            (folder.walls() / "dischargeEnd.stl").string() +
                ": no such wall, and the others leave this end open, run millMesh first");
}

}  // namespace
}  // namespace millfoam::dem_driver
