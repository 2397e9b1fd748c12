// SPDX-License-Identifier: GPL-3.0-or-later
// What millLiggghts leaves of the contacts, and the results that follow from it.
#include "dem_driver/contact_record.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "dem_driver/contact_results.hpp"
#include "dem_driver/segments.hpp"
#include "small_mill.hpp"

namespace millfoam::dem_driver {
namespace {

using tests::message_of;
using tests::small_mill;
using tests::TemporaryFolder;

class ContactRecordTest : public ::testing::Test {
 protected:
  ContactRecordTest() {
    std::filesystem::create_directories(folder_.dem());
    std::filesystem::create_directories(folder_.dumps());
    std::filesystem::create_directories(folder_.walls());
    tests::write_drum(folder_, small_mill().geometry);
    order_.diameters = {0.004, 0.002};
    order_.parts = order_.turning_parts = {"shell"};
    order_.timestep = 0.001;
    order_.cell_edge = 0.01;
    order_.end_step = 40;
    order_.block_steps = 10;
    order_.wall_steps = 20;
    order_.walls = folder_.walls();
  }
  /// A block with this work of two large balls, J, and one touch and collision of it.
  void write_block(ContactRecord& record, long step, double work) const {
    ContactSums sums(order_.kinds());
    sums.add_work(0, {work, 0, 0});
    sums.add_touch(0, work);
    sums.add_collision(0, {work, 0, 0});
    record.write(step, 10, 0.001 * static_cast<double>(step), sums);
  }

  TemporaryFolder temporary_;
  CaseFolder folder_{temporary_.path()};
  ContactOrder order_;
};

TEST_F(ContactRecordTest, TheOrderIsReadBackAsItWasWritten) {
  order_.angular_velocity = -6.25;
  order_.parts = {"impeller", "shell"};
  order_.turning_parts = {"impeller"};
  write_contact_order(folder_.contact_order(), small_mill(), order_);
  const ContactOrder read = read_contact_order(folder_.contact_order());
  EXPECT_EQ(read.diameters, order_.diameters);
  EXPECT_EQ(read.parts, order_.parts);
  EXPECT_EQ(read.turning_parts, order_.turning_parts);
  EXPECT_TRUE(read.turns(0));
  EXPECT_FALSE(read.turns(1));
  EXPECT_EQ(read.timestep, order_.timestep);
  EXPECT_EQ(read.angular_velocity, order_.angular_velocity);
  EXPECT_EQ(read.cell_edge, order_.cell_edge);
  EXPECT_EQ(read.end_step, order_.end_step);
  EXPECT_EQ(read.block_steps, order_.block_steps);
  EXPECT_EQ(read.wall_steps, order_.wall_steps);
  EXPECT_TRUE(std::filesystem::equivalent(read.walls, order_.walls));
  std::ofstream(folder_.contact_order()) << R"({"format": "millfoam-contacts", "diameters_m": [1]})";
  EXPECT_NE(message_of([&] { read_contact_order(folder_.contact_order()); }).find("key 'parts' is missing"),
            std::string::npos);
}

TEST_F(ContactRecordTest, ShapesOfTheSameVolumeAreOneClass) {
  auto mill = small_mill();
  const auto sizes = contact_order_of(mill, plan_dem(mill), {"shell"}, folder_.walls()).diameters;
  auto same = mill.charge.classes.back();
  same.shape = meshing::scaled_to({{1.5, 1, 1}, 4}, same.diameter);
  mill.charge.classes.push_back(same);
  mill.dem.curvature_limit = 10;
  ASSERT_EQ(plan_dem(mill).charge.classes.size(), sizes.size() + 1);
  EXPECT_EQ(contact_order_of(mill, plan_dem(mill), {"shell"}, folder_.walls()).diameters, sizes);
}

TEST_F(ContactRecordTest, TheStateIsReadBackAsItWasWritten) {
  ContactState state{{{3, 7, 1, 0, {1.0 / 3, 2e-9, -1e-20}}, {4, -2, 0, 0, {}}}, 12, {0, 0, 1.5, 0, -2}};
  write_contact_state(folder_.dem(), 30, state);
  const auto read = read_contact_state(folder_.dem(), 30);
  ASSERT_TRUE(read);
  ASSERT_EQ(read->open.size(), 2U);
  EXPECT_EQ(read->open[0].other, 7);
  EXPECT_EQ(read->open[0].work.normal, 1.0 / 3);
  EXPECT_EQ(read->open[0].work.rolling, -1e-20);
  EXPECT_EQ(read->open[1].other, -2);
  EXPECT_EQ(read->wall_steps, 12);
  EXPECT_EQ(read->wall_numbers, state.wall_numbers);
  EXPECT_FALSE(read_contact_state(folder_.dem(), 40));
}

TEST_F(ContactRecordTest, ADamagedStateIsRefusedWithItsLine) {
  const auto file = folder_.dem() / "contactState.30.txt";
  for (const auto& [text, place] :
       {std::pair{"2\n3 7 1 1 2 3\n", ":3: '', expected a contact"},
        {"0\n5 2\n7 1.5\nend\n", ":3: '7 1.5', expected a number of the walls"},
        {"0\n5 2\n1 1.5\n", ":4: '', expected a number of the walls, or 'end'"}}) {
    std::ofstream(file) << text;
    const std::string message = message_of([&] { read_contact_state(folder_.dem(), 30); });
    EXPECT_NE(message.find(file.string() + place), std::string::npos) << message;
  }
}

TEST_F(ContactRecordTest, ARunThatWasKilledAndResumedHasEachBlockOnce) {
  {
    ContactRecord killed(folder_.dem(), order_.kinds(), 0);
    write_block(killed, 10, 1);
    write_block(killed, 20, 2);
    write_block(killed, 30, 99);
    ContactRecord resumed(folder_.dem(), order_.kinds(), 20);
    write_block(resumed, 30, 3);
    write_block(resumed, 40, 4);
  }
  const auto blocks = read_contact_blocks(folder_, order_);
  ASSERT_EQ(blocks.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(blocks[i].sums.of(0).work.normal, static_cast<double>(i + 1));
  const auto span = sum_blocks(blocks, order_, 15);
  EXPECT_EQ(span.begin, 20);
  EXPECT_EQ(span.end, 40);
  EXPECT_NEAR(span.spin_gain, 0.02, 1e-12);
  EXPECT_EQ(span.sums.of(0).work.normal, 7);
  EXPECT_EQ(sum_blocks(blocks, order_, 0).begin, 10);
  EXPECT_EQ(sum_blocks(blocks, order_, 35).begin, 30);
}

TEST_F(ContactRecordTest, TheBalanceComparesTheContactsWithTheDriveAndTheGainOfTheSameSteps) {
  {
    ContactRecord record(folder_.dem(), order_.kinds(), 0);
    for (long step = 10; step <= 40; step += 10) write_block(record, step, 0.02);
    WallSums walls(order_.cells().size());
    ContactForce contact;
    for (int step = 0; step < 20; ++step) walls.add(5, contact, 0.3, {});
    record.write(20, 20, walls);
    record.write(40, 20, walls);
  }
  // 2 W are dissipated; 3.5 W of the drive less 0.5 W and, in spin, 1 W that the charge gains
  std::vector<DriveRow> rows;
  for (long step = 5; step <= 40; step += 5)
    rows.push_back({step, step <= 20 ? 100 : 3.5, 0.3, 0.5 * static_cast<double>(step) * order_.timestep});
  const auto contacts = gather_contacts(folder_, order_, rows, 20);
  EXPECT_NEAR(contacts.balance.power.total(), 2, 1e-12);
  EXPECT_NEAR(contacts.balance.drive, 3.5, 1e-12);
  EXPECT_NEAR(contacts.balance.gain, 1.5, 1e-12);
  EXPECT_NEAR(contacts.balance.ratio(), 1, 1e-12);
  // Of rows that begin later the gain is that of their time
  const std::vector<DriveRow> late(rows.begin() + 5, rows.end());
  ASSERT_EQ(late.front().step, 30);
  EXPECT_NEAR(gather_contacts(folder_, order_, late, 20).balance.gain, 1.5, 1e-12);
  EXPECT_NEAR(contacts.collisions_per_second(), 2 / 0.02, 1e-9);
  EXPECT_EQ(contacts.walls.begin, 20);
  EXPECT_NEAR(contacts.wall_torque(), 0.3, 1e-12);
  auto at_rest = contacts;
  at_rest.order.turning_parts.clear();
  EXPECT_EQ(at_rest.wall_torque(), 0);
  write_contact_files(folder_, contacts);
  std::ifstream power(folder_.contact_power());
  std::string head, row;
  std::getline(power, head);
  std::getline(power, row);
  EXPECT_EQ(row, "0,0.01,0.004,0.004,-1,2,0,0");
  const auto entry = nlohmann::json::parse(contact_entry(contacts));
  EXPECT_NEAR(entry["power"]["balls"]["normal_W"].get<double>(), 2, 1e-12);
}

TEST_F(ContactRecordTest, RestartFilesTakeTheirContactsWithThem) {
  for (const long step : {10, 20, 30}) {
    write_contact_state(folder_.dem(), step, {});
    std::ofstream(folder_.dem() / ("restart." + std::to_string(step))) << "x";
  }
  remove_restarts_before(folder_, 20);
  remove_restarts_after(folder_, 20);
  EXPECT_FALSE(read_contact_state(folder_.dem(), 10));
  EXPECT_TRUE(read_contact_state(folder_.dem(), 20));
  EXPECT_FALSE(read_contact_state(folder_.dem(), 30));
}

}  // namespace
}  // namespace millfoam::dem_driver
