// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/case_folder.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <map>

#include "dem_driver/segments.hpp"
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
  for (const char* name : {"dump.0.txt", "dump.50.txt", "run.txt", "dump.0.gz", "notes.txt"})
    touch(folder.dumps() / name);
  EXPECT_EQ(prepare_folders(folder), 2u);
  EXPECT_TRUE(find_dumps(folder).empty());
  EXPECT_FALSE(std::filesystem::exists(folder.run_file()));
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

TEST(CaseFolder, TheRunFileGivesTimestepIntervalAndSpeedToFullPrecision) {
  const TemporaryFolder temporary;
  const CaseFolder folder{temporary.path()};
  const auto mill = small_mill();
  const DemPlan plan = plan_dem(mill);
  prepare_folders(folder);
  write_run_file(folder, mill, plan);
  std::ifstream in(folder.run_file());
  std::map<std::string, double> entries;
  std::string key;
  for (double value = 0; in >> key >> value;) entries[key] = value;
  EXPECT_EQ(entries,
            (std::map<std::string, double>{{"timestep", plan.step.value},
                                           {"interval", static_cast<double>(plan.step.steps_per_record)},
                                           {"angular_velocity", -12}}));
}

}  // namespace
}  // namespace millfoam::dem_driver
