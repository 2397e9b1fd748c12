// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/disk_room.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "dem_driver/forecast.hpp"
#include "small_mill.hpp"

namespace millfoam::dem_driver {
namespace {

using tests::message_of;
using tests::small_mill;
using tests::TemporaryFolder;

TEST(DiskRoom, TheLeastIsLessThanWhatRunsTakeButNotHalfOfIt) {
  auto mill = small_mill();
  mill.dem.contact_interval = 0.01;
  const DemPlan plan = plan_dem(mill);
  // 101 and 255 bytes per ball were measured in dumps and contacts.
  const double taken = forecast(plan, {1e5, 101, 5e7, 255}, 1).disk;
  EXPECT_LT(least_disk(plan, 0), taken);
  EXPECT_GT(least_disk(plan, 0), taken / 2);
}

TEST(DiskRoom, AResumedRunNeedsRoomForTheRestOnly) {
  const DemPlan plan = plan_dem(small_mill());
  const double restart = least_disk(plan, plan.turning_steps);
  EXPECT_NEAR((least_disk(plan, plan.turning_steps / 2) - restart) / (least_disk(plan, 0) - restart), 0.5,
              1e-9);
}

TEST(DiskRoom, ARunThatCannotFitIsRefusedWithBothNumbers) {
  const TemporaryFolder temporary;
  DemPlan plan = plan_dem(small_mill());
  EXPECT_EQ(message_of([&] { require_room({temporary.path()}, plan, 0); }), "");
  plan.charge.classes.front().count = 1000000000000;
  const std::string message = message_of([&] { require_room({temporary.path()}, plan, 0); });
  EXPECT_NE(message.find("the disk has room for "), std::string::npos) << message;
  EXPECT_NE(message.find("GB, expected at least 2.6e+06 GB for 31 dumps of 1000000000100 balls"),
            std::string::npos)
      << message;
}

TEST(DiskRoom, TheDumpsThatAreRemovedFirstCountAsRoom) {
  const TemporaryFolder temporary;
  const CaseFolder folder{temporary.path()};
  std::filesystem::create_directories(folder.dumps());
  // A sparse file: it has this length, but takes no room.
  const auto dump = folder.dumps() / "dump.100.txt";
  std::ofstream(dump).close();
  DemPlan plan = plan_dem(small_mill());
  const double needed = 4 * static_cast<double>(std::filesystem::space(temporary.path()).available) + 1e9;
  plan.charge.classes.front().count = static_cast<long>(needed / 2600);
  EXPECT_NE(message_of([&] { require_room(folder, plan, 0); }), "");
  std::filesystem::resize_file(dump, static_cast<std::uintmax_t>(1.1 * needed));
  EXPECT_EQ(message_of([&] { require_room(folder, plan, 0); }), "");
  plan.turning_steps *= 2;
  EXPECT_NE(message_of([&] { require_room(folder, plan, 100); }), "");
}

TEST(DiskRoom, AFullDiskIsTold) {
  const TemporaryFolder temporary;
  EXPECT_EQ(free_in_words(temporary.path(), 1000000000000000).find("the disk is full, "), 0u);
  EXPECT_NE(free_in_words(temporary.path(), 1).find("ulimit"), std::string::npos);
}

}  // namespace
}  // namespace millfoam::dem_driver
