// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/charge_plan.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <sstream>

#include "meshing/mill/mill_charge.hpp"
#include "meshing/surface/pi.hpp"
#include "small_mill.hpp"

namespace millfoam::dem_driver {
namespace {

using tests::message_of;
using tests::small_mill;

TEST(ChargePlan, TheCountIsTheMassOverTheMassOfOneBallRounded) {
  auto mill = small_mill();
  const double one = 2500 * pi / 6 * std::pow(0.002, 3);
  mill.charge.classes = {{0.002, 40.4 * one}};
  const auto plan = plan_charge(mill);
  EXPECT_EQ(plan.classes.at(0).count, 40);
  EXPECT_NEAR(plan.mass(), 40 * one, 1e-15);
  EXPECT_NEAR(plan.classes.at(0).mass_asked, 40.4 * one, 1e-15);
}

/// A stirred mill whose balls are released in a ring of 11 cm^3 above its pins.
meshing::Mill stirred_mill(double shaft_end, double top) {
  auto mill = small_mill();
  mill.geometry.ends = meshing::Ends::plain;
  mill.geometry.length = top + 0.011;
  mill.geometry.impeller = meshing::Impeller{0.008, shaft_end, {{top - 0.002, 0.03, 0.004, 0, 2}}};
  mill.charge.start_radius = 0.0195;
  mill.charge.start_core = 0.0045;
  mill.charge.start_bottom = top + 0.0005;
  mill.charge.start_length = 0.01;
  const double one = 2500 * pi / 6 * std::pow(0.003, 3);
  mill.charge.classes = {{0.003, 1000 * one}};  // 14 cm^3
  return mill;
}

TEST(ChargePlan, BallsOfAStirredMillFallBelowThePinsAndLeaveRoomForTheNext) {
  const auto plan = plan_charge(stirred_mill(0.004, 0.04));
  EXPECT_EQ(plan.balls(), 1000);
  EXPECT_GT(plan.rounds.size(), 1);
  EXPECT_GE(plan.round_settle_time, std::sqrt(2 * 0.051 / 9.81));
}

TEST(ChargePlan, BallsOfAStirredMillWithoutRoomAreRefusedByItsOwnKeys) {
  const auto message = message_of([] { plan_charge(stirred_mill(0.001, 0.006)); });
  EXPECT_NE(message.find("raise geometry.height"), std::string::npos) << message;
  EXPECT_EQ(message.find("start_radius"), std::string::npos) << message;
}

TEST(ChargePlan, SuperquadricsTakeTheRoomOfTheSpheresAroundThem) {
  auto mill = small_mill();
  const auto spheres = plan_charge(mill);
  for (auto& size : mill.charge.classes) size.shape = meshing::scaled_to({{2, 1, 1}, 4}, size.diameter);
  const auto plan = plan_charge(mill);
  EXPECT_TRUE(plan.has_shapes());
  EXPECT_FALSE(spheres.has_shapes());
  EXPECT_EQ(plan.balls(), spheres.balls());
  EXPECT_DOUBLE_EQ(plan.mass(), spheres.mass());
  EXPECT_GT(plan.rounds.size(), spheres.rounds.size());
  const double reach = meshing::bounding_radius(*mill.charge.classes.back().shape);
  EXPECT_DOUBLE_EQ(plan.rounds.front().front().reach(), reach);
  EXPECT_GT(plan.classes.front().surface(), spheres.classes.front().surface());
}

TEST(ChargePlan, LargestBallsComeFirst) {
  const auto plan = plan_charge(small_mill());
  double last = 1;
  for (const auto& round : plan.rounds)
    for (const auto& insertion : round) {
      EXPECT_LE(insertion.diameter, last);
      last = insertion.diameter;
    }
}

TEST(ChargePlan, EveryBallIsInExactlyOneInsertion) {
  auto mill = small_mill();
  for (auto& size : mill.charge.classes) size.mass *= 2;
  const auto plan = plan_charge(mill);
  std::map<double, long> inserted;
  for (const auto& round : plan.rounds)
    for (const auto& insertion : round) inserted[insertion.diameter] += insertion.count;
  EXPECT_EQ(inserted, (std::map<double, long>{{0.002, 200}, {0.003, 300}}));
}

TEST(ChargePlan, NoRoundFillsMoreThanItsShareOfTheStartCylinder) {
  auto mill = small_mill();
  for (auto& size : mill.charge.classes) size.mass *= 2;
  const auto plan = plan_charge(mill);
  EXPECT_GT(plan.rounds.size(), 1u);
  const double cylinder = pi * 0.018 * 0.018 * 0.012;
  for (const auto& round : plan.rounds) {
    double volume = 0;
    for (const auto& insertion : round)
      volume += static_cast<double>(insertion.count) * pi / 6 * std::pow(insertion.diameter, 3);
    EXPECT_LE(volume, 0.2 * cylinder);
  }
}

TEST(ChargePlan, AChargeThatDoesNotFitTheStartCylinderIsRefused) {
  auto mill = small_mill();
  mill.charge.classes.at(0).mass *= 50;
  const std::string message = message_of([&] { plan_charge(mill); });
  EXPECT_EQ(message.find("key 'charge.start_radius' = 0.018: expected a start cylinder"), 0u) << message;
  EXPECT_NE(message.find("left over"), std::string::npos) << message;
}

TEST(ChargePlan, AStartCylinderIsOnlyToBeRaisedWhereItCanBe) {
  auto mill = small_mill();
  mill.charge.classes.at(0).mass *= 50;
  const auto says = [&](const std::string& words) {
    return message_of([&] { plan_charge(mill); }).find(words) != std::string::npos;
  };
  // Balls of up to 3 mm in a smooth drum of 20 mm radius
  EXPECT_TRUE(
      says("left over; take fewer balls (charge.fill or charge.classes), or a larger charge.start_radius, "
           "up to 0.02 m"));
  EXPECT_FALSE(says("start_length"));
  mill.geometry.ends = meshing::Ends::plain;
  EXPECT_TRUE(
      says("or charge.classes), or a longer charge.start_length, up to 0.012 m, or a larger charge.start"));
  mill.charge.start_radius = 0.02 - 0.003 / 2;
  EXPECT_TRUE(says("up to 0.012 m"));
  EXPECT_FALSE(says("a larger charge.start_radius"));
  mill.charge.start_length = 0.012;
  EXPECT_FALSE(says("a longer charge.start_length"));
  EXPECT_TRUE(says("take fewer balls (charge.fill or charge.classes)"));
}

TEST(ChargePlan, ABallLargerThanTheStartCylinderIsRefusedWithItsDiameter) {
  auto mill = small_mill();
  mill.charge.classes = {{0.037, 1}};
  EXPECT_NE(message_of([&] { plan_charge(mill); }).find("0.037"), std::string::npos);
}

TEST(ChargePlan, AChargeLighterThanHalfABallIsRefused) {
  auto mill = small_mill();
  mill.charge.classes = {{0.003, 1e-6}};
  EXPECT_EQ(message_of([&] { plan_charge(mill); }),
            "key 'charge' = 1e-06 kg of balls of 0.003 m in this mill, which rounds to 0 balls: expected at "
            "least half of one ball's mass, 3.53429e-05 kg: raise the mass");
}

TEST(ChargePlan, AClassLighterThanHalfABallIsRefusedAsItWouldStillSetTheTimeStep) {
  auto mill = small_mill();
  mill.charge.classes.push_back({0.001, 0.49 * meshing::ball_mass(mill, 0.001)});
  EXPECT_EQ(message_of([&] { plan_charge(mill); }),
            "key 'charge.classes[2]' = 6.41409e-07 kg of balls of 0.001 m in this mill, which rounds to 0 "
            "balls: expected at least half of one ball's mass, 1.309e-06 kg: raise the mass, or leave the "
            "class out (small ones by charge.fines_below)");
  mill.charge.classes.back().mass = 0.51 * meshing::ball_mass(mill, 0.001);
  EXPECT_EQ(plan_charge(mill).classes.back().count, 1);
}

TEST(ChargePlan, MoreBallsThanCanBeCountedAreRefused) {
  auto mill = small_mill();
  mill.charge.classes.push_back({1e-9, 1});
  EXPECT_EQ(message_of([&] { plan_charge(mill); }).find("key 'charge.classes[2]' = 1 kg of balls of 1e-09 m"),
            0u);
}

TEST(ChargePlan, FinesMayBeLighterThanHalfABall) {
  auto mill = small_mill();
  mill.charge.classes.push_back({0.001, 1e-9});
  mill.charge.fines_below = 0.0015;
  EXPECT_EQ(plan_charge(mill).classes.size(), 2u);
}

TEST(ChargePlan, TheReportHasAskedAndRealisedMass) {
  auto mill = small_mill();
  const double one = 2500 * pi / 6 * std::pow(0.002, 3);
  mill.charge.classes = {{0.002, 49.6 * one}};
  std::ostringstream out;
  print_charge(out, plan_charge(mill));
  EXPECT_NE(out.str().find("0.0005194"), std::string::npos) << out.str();
  EXPECT_NE(out.str().find("0.0005236"), std::string::npos) << out.str();
}

TEST(ChargePlan, FinesAreInTheBooksAndNotInTheMill) {
  auto mill = small_mill();
  mill.charge.fines_below = 0.0025;
  const auto plan = plan_charge(mill);
  EXPECT_EQ(plan.balls(), 150);
  ASSERT_EQ(plan.fines.size(), 1u);
  EXPECT_EQ(plan.fines[0].count, 100);
  EXPECT_NEAR(plan.fines[0].surface(), 100 * pi * 0.002 * 0.002, 1e-15);
  std::ostringstream books;
  write_charge_books(books, plan);
  EXPECT_NE(books.str().find("\n0.003,150,"), std::string::npos) << books.str();
  EXPECT_NE(books.str().find("\n0.002,100,"), std::string::npos) << books.str();
  std::ostringstream report;
  print_charge(report, plan);
  EXPECT_NE(report.str().find("fines, not simulated: 2 mm, 100 balls"), std::string::npos) << report.str();
}

}  // namespace
}  // namespace millfoam::dem_driver
