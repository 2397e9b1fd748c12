// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/dumps/dump_columns.hpp"

#include <gtest/gtest.h>

#include "averaging/dumps/dump_reader.hpp"
#include "tests/averaging/test_support.hpp"

namespace millfoam::averaging {
namespace {

/// A dump of one row in the box [-1, 1] x [0, 4] x [0.5, 0.75].
std::string one_row(const std::string& columns, const std::string& row) {
  return "ITEM: TIMESTEP\n10\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS ff ff pp\n-1 1\n0 4\n0.5 "
         "0.75\nITEM: ATOMS " +
         columns + " \n" + row + " \n";
}

ParticleRecord read_row(const std::string& columns, const std::string& row) {
  return parse_dump(one_row(columns, row), "dump1.txt");
}

std::string refusal(const std::string& columns, const std::string& row) {
  return message_of<DumpError>([&] { read_row(columns, row); });
}

TEST(DumpPositions, ScaledOnesAreTakenToTheRecordsBox) {
  const ParticleRecord record = read_row("id xs ys zs vx vy vz radius", "1 0.25 0.5 1.0 0 0 0 0.01");
  EXPECT_EQ(record.particles[0].position, (Vector3{-0.5, 2, 0.75}));
}

TEST(DumpPositions, ABoxThatChangesChangesScaledPositionsWithIt) {
  std::string text = one_row("id xs ys zs vx vy vz radius", "1 0.25 0.5 1.0 0 0 0 0.01");
  text.replace(text.find("-1 1"), 4, "-3 5");
  EXPECT_EQ(parse_dump(text, "dump").particles[0].position, (Vector3{-1, 2, 0.75}));
}

TEST(DumpPositions, UnwrappedOnesAreTakenAsTheyAre) {
  const Vector3 far{7, -0.5, 12};
  EXPECT_EQ(read_row("id xu yu zu vx vy vz radius", "1 7 -0.5 12 0 0 0 0.01").particles[0].position, far);
  EXPECT_EQ(read_row("vx vy vz zsu ysu xsu radius id", "0 0 0 46 -0.125 4 0.01 1").particles[0].position,
            far);
}

TEST(DumpPositions, TwoKindsOrAMixAreRefused) {
  expect_named(refusal("id x y z xs ys zs vx vy vz radius", "1 0 0 0 0 0 0 0 0 0 0.01"),
               {"dump1.txt:9", "'x' and 'xs'", "two kinds"});
  expect_named(refusal("id xu yu z vx vy vz radius", "1 0 0 0 0 0 0 0.01"), {"'xu' and 'z'", "two kinds"});
  expect_named(refusal("id xs ys vx vy vz radius", "1 0 0 0 0 0 0.01"), {"'zs' is missing"});
  expect_named(refusal("id x y z y vx vy vz radius", "1 0 0 0 0 0 0 0 0.01"), {"'y' appears twice"});
}

TEST(DumpPositions, ScaledOnesNeedABoxAlongTheAxes) {
  std::string text = one_row("id xs ys zs vx vy vz radius", "1 0 0 0 0 0 0 0.01");
  std::string tilted = text;
  tilted.replace(tilted.find("ff ff pp\n-1 1\n0 4\n0.5 0.75"), 26,
                 "xy xz yz ff ff pp\n-1 1 0.1\n0 4 0\n0.5 0.75 0");
  const auto message = [](const std::string& dump) {
    return message_of<DumpError>([&] { parse_dump(dump, "dump1.txt"); });
  };
  expect_named(message(tilted), {"dump1.txt:9", "triclinic", "'x y z'"});
  text.erase(text.find("ITEM: BOX"), text.find("ITEM: ATOMS") - text.find("ITEM: BOX"));
  expect_named(message(text), {"dump1.txt:5", "BOX BOUNDS", "missing"});
}

TEST(DumpPositions, OthersMayBeInATiltedBox) {
  std::string text = one_row("id x y z vx vy vz radius", "1 0.25 0.5 1 0 0 0 0.01");
  text.replace(text.find("ff ff pp\n-1 1\n0 4\n0.5 0.75"), 26,
               "xy xz yz ff ff pp\n-1 1 0.1\n0 4 0\n0.5 0.75 0");
  EXPECT_EQ(parse_dump(text, "dump").particles[0].position, (Vector3{0.25, 0.5, 1}));
}

TEST(DumpPositions, AScaledOneThatOverflowsIsRefused) {
  expect_named(refusal("id xs ys zs vx vy vz radius", "1 0 1e308 0 0 0 0 0.01"),
               {"dump1.txt:10", "'ys'", "too large"});
}

const std::string ellipsoid = "id x y z vx vy vz shapex shapey shapez quat1 quat2 quat3 quat4";

TEST(DumpShapes, SuperquadricsAreRead) {
  const ParticleRecord record = read_row(ellipsoid + " blockiness1 blockiness2",
                                         "1 0.1 0.2 0.3 1 2 3 0.01 0.02 0.03 0.5 -0.5 0.5 -0.5 8 4");
  ASSERT_EQ(record.shapes.size(), 1U);
  EXPECT_EQ(record.shapes[0].half_axes, (Vector3{0.01, 0.02, 0.03}));
  EXPECT_EQ(record.shapes[0].blockiness, (std::array<double, 2>{8, 4}));
  EXPECT_EQ(record.shapes[0].quaternion, (std::array<double, 4>{0.5, -0.5, 0.5, -0.5}));
  EXPECT_EQ(record.particles[0].position, (Vector3{0.1, 0.2, 0.3}));
}

TEST(DumpShapes, WithoutBlocknessTheyAreEllipsoidsInTheSphereOfTheirLongestAxis) {
  const ParticleRecord record = read_row(ellipsoid, "1 0 0 0 0 0 0 0.01 0.03 0.02 1 0 0 0");
  EXPECT_EQ(record.shapes[0].blockiness, (std::array<double, 2>{2, 2}));
  EXPECT_EQ(record.particles[0].radius, 0.03);
}

TEST(DumpShapes, WithoutThemAllAreSpheres) {
  EXPECT_TRUE(read_row("id x y z vx vy vz radius", "1 0 0 0 0 0 0 0.01").shapes.empty());
}

TEST(DumpShapes, AQuaternionIsMadeOfLengthOne) {
  const ParticleRecord record = read_row(ellipsoid, "1 0 0 0 0 0 0 0.01 0.03 0.02 0.9 0 1.2 0");
  EXPECT_NEAR(record.shapes[0].quaternion[0], 0.6, 1e-15);
  EXPECT_NEAR(record.shapes[0].quaternion[2], 0.8, 1e-15);
}

TEST(DumpShapes, ThoseThatCannotBeAreRefused) {
  const std::string with = ellipsoid + " blockiness1 blockiness2";
  expect_named(refusal(with, "1 0 0 0 0 0 0 0.01 0 0.02 1 0 0 0 2 2"),
               {"dump1.txt:10", "'shapey' is 0", "positive"});
  expect_named(refusal(with, "1 0 0 0 0 0 0 0.01 0.02 0.02 1 0 0 0 2 1.5"),
               {"'blockiness2' is 1.5", "2 or more"});
  expect_named(refusal(with, "1 0 0 0 0 0 0 0.01 0.02 0.02 0 0 0 0 2 2"),
               {"dump1.txt:10", "quat1", "length 0"});
  expect_named(refusal(with, "1 0 0 0 0 0 0 0.01 0.02 nan 1 0 0 0 2 2"), {"'shapez' is 'nan'"});
}

TEST(DumpShapes, ColumnsThatAreNotCompleteAreRefused) {
  expect_named(refusal("id x y z vx vy vz radius shapex shapey shapez", ""),
               {"dump1.txt:9", "'quat1' is missing", "superquadric"});
  expect_named(refusal("id x y z vx vy vz radius quat1 quat2 quat3 quat4", ""), {"'shapex' is missing"});
  expect_named(refusal("id x y z vx vy vz radius blockiness1 blockiness2", ""), {"'shapex' is missing"});
  expect_named(refusal(ellipsoid + " blockiness2", ""), {"'blockiness1' is missing"});
  expect_named(refusal(ellipsoid + " roundness1 roundness2", ""), {"'roundness1'", "blockiness1"});
}

}  // namespace
}  // namespace millfoam::averaging
