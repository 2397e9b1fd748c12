// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/mesh/motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "tests/averaging/test_support.hpp"

namespace millfoam::averaging {
namespace {

using Eigen::Vector3d;

void expect_near(const Vector3d& found, const Vector3d& expected) {
  EXPECT_LT((found - expected).norm(), 1e-14) << found.transpose() << " and " << expected.transpose();
}

std::string motion_refusal(const std::vector<std::string>& texts) {
  return message_of<std::invalid_argument>([&] { parse_motion(texts); });
}

TEST(Motion, WithoutTextIsRest) {
  EXPECT_TRUE(parse_motion({})->place(3).isApprox(Eigen::Isometry3d::Identity()));
}

TEST(Motion, RotationIsRightHandedAboutZ) {
  const auto motion = parse_motion({"rotation speed 2"});
  expect_near(motion->place(pi / 4) * Vector3d(1, 0, 5), Vector3d(0, 1, 5));
}

TEST(Motion, RotationLeavesItsAxisWhereItIs) {
  const auto motion = parse_motion({"rotation speed -3 axis 1 2 3 origin 4 5 6"});
  expect_near(motion->place(1.7) * Vector3d(5, 7, 9), Vector3d(5, 7, 9));
}

TEST(Motion, TranslationGoesItsVelocityTimesTheTime) {
  expect_near(parse_motion({"translation velocity 1 -2 0.5"})->place(2) * Vector3d(1, 1, 1),
              Vector3d(3, -3, 2));
}

TEST(Motion, TheFirstOfSeveralIsAppliedFirst) {
  const std::string quarter = "rotation speed " + std::to_string(pi / 2),
                    shift = "translation velocity 1 0 0";
  EXPECT_LT((parse_motion({quarter, shift})->place(1) * Vector3d(1, 0, 0) - Vector3d(1, 1, 0)).norm(), 1e-6);
  EXPECT_LT((parse_motion({shift, quarter})->place(1) * Vector3d(1, 0, 0) - Vector3d(0, 2, 0)).norm(), 1e-6);
}

TEST(Motion, AngleOfATableIsTheIntegralOfItsSpeed) {
  const TemporaryFolder folder;
  const auto table = folder.write("speed.txt", "# s rad/s\n0 0\n1 2\n\n3 2 # steady\n4 0\n");
  const auto motion = parse_motion({"rotation table " + table.string()});
  // Under the speed's lines: 1 until 1 s, 4 more until 3 s, then 2 x - x^2.
  for (const auto& [time, angle] : {std::pair{0.5, 0.25}, {1.0, 1.0}, {2.0, 3.0}, {3.5, 5.75}, {4.0, 6.0}}) {
    expect_near(motion->place(time) * Vector3d(1, 0, 0), Vector3d(std::cos(angle), std::sin(angle), 0));
  }
}

TEST(Motion, TranslationTableIsLinearBetweenItsTimes) {
  const TemporaryFolder folder;
  const auto table = folder.write("path.txt", "0 0 0 0\r\n2 4 -2 1\r\n");
  expect_near(parse_motion({"translation table " + table.string()})->place(0.5) * Vector3d(0, 0, 0),
              Vector3d(1, -0.5, 0.25));
}

TEST(Motion, OutsideATableIsRefusedWithTheTime) {
  const TemporaryFolder folder;
  const auto motion = parse_motion({"rotation table " + folder.write("speed.txt", "0 1\n2 1\n").string()});
  EXPECT_NO_THROW(motion->place(2));
  // Steps times the time-step
  EXPECT_NO_THROW(motion->place(2 * (1 + 1e-15)));
  EXPECT_NO_THROW(motion->place(-1e-15));
  for (const double time : {-0.1, 2.5, std::nan("")}) {
    expect_named(message_of<std::out_of_range>([&] { motion->place(time); }),
                 {(folder / "speed.txt").string() + ": time ", "outside", "from 0 to 2 s"});
  }
}

TEST(Motion, ThatIsNotKnownIsRefusedWithItsText) {
  expect_named(motion_refusal({"rotaton speed 2"}), {"'rotaton speed 2'", "'rotation' or 'translation'"});
  expect_named(motion_refusal({"rotation sped 2"}), {"'sped'", "'speed' or 'table'"});
  expect_named(motion_refusal({"rotation speed fast"}), {"'fast'", "rad/s"});
  expect_named(motion_refusal({"rotation speed"}), {"it ends", "rad/s"});
  expect_named(motion_refusal({"rotation speed 1 axis 0 0 0"}), {"no direction"});
  expect_named(motion_refusal({"rotation speed 1 axis 0 1"}), {"it ends", "axis"});
  expect_named(motion_refusal({"rotation speed 1 about z"}), {"'about'", "'axis' or 'origin'"});
  expect_named(motion_refusal({"translation speed 1 0 0"}), {"'speed'", "'velocity' or 'table'"});
  expect_named(motion_refusal({"translation velocity 1 0 0 0"}), {"'0'"});
  expect_named(motion_refusal({""}), {"it ends", "'rotation' or 'translation'"});
}

TEST(Motion, ATableWithErrorsIsRefusedWithFileAndLine) {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& text) {
    return motion_refusal({"rotation table " + folder.write("speed.txt", text).string()});
  };
  expect_named(refused("0 1\n1 x\n"), {"speed.txt:2", "'x'"});
  expect_named(refused("0 1\n1\n"), {"speed.txt:2", "1 numbers", "a time and 1 value"});
  expect_named(refused("0 1\n# pause\n0 2\n"), {"speed.txt:3", "does not follow"});
  expect_named(refused("0 inf\n"), {"speed.txt:1", "'inf'"});
  expect_named(refused("0 1\n"), {"speed.txt", "two or more"});
  expect_named(motion_refusal({"translation table " + (folder / "none.txt").string()}),
               {"none.txt", "cannot read"});
}

}  // namespace
}  // namespace millfoam::averaging
