// SPDX-License-Identifier: GPL-3.0-or-later
// Dumps that LAMMPS 29 Sep 2021 wrote itself, by data/lammps/in.drum: 63 balls fall into a drum.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "averaging/dumps/dump_header.hpp"
#include "averaging/dumps/dump_input.hpp"
#include "averaging/dumps/dump_reader.hpp"
#include "tests/averaging/test_support.hpp"

namespace millfoam::averaging {
namespace {

constexpr double density = 2500, length = 0.04;

std::filesystem::path lammps_file(const std::string& name) {
  return std::filesystem::path(TEST_DATA_DIR) / "lammps" / name;
}

/// In the order of their ids.
std::vector<Particle> balls_of(const std::string& name) {
  std::vector<Particle> balls = read_dump(lammps_file(name)).particles;
  std::sort(balls.begin(), balls.end(), [](const Particle& a, const Particle& b) { return a.id < b.id; });
  return balls;
}

/// What LAMMPS' log says of all balls together.
struct Totals {
  double mass = 0;                 ///< kg
  double kinetic = 0;              ///< J
  std::array<double, 3> moment{};  ///< mass times position, kg m
};

Totals totals_of(const std::vector<Particle>& balls) {
  Totals totals;
  for (const Particle& ball : balls) {
    const double mass = density * sphere_volume(ball.radius);
    totals.mass += mass;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      totals.kinetic += mass / 2 * ball.velocity[axis] * ball.velocity[axis];
      totals.moment[axis] += mass * ball.position[axis];
    }
  }
  return totals;
}

TEST(LammpsDump, HeaderBeginsWithUnitsAndTimeAndHasABoxWithPeriodicEnds) {
  DumpInput input(lammps_file("drum.40000.txt"));
  TextLines lines = input.lines();
  ASSERT_EQ(lines.peek(), "ITEM: UNITS");
  const DumpHeader header = read_header(lines);
  EXPECT_EQ(header.step, 40000);
  EXPECT_EQ(header.count, 63);
  ASSERT_TRUE(header.box);
  EXPECT_EQ(header.box->lower, (std::array<double, 3>{-0.05, -0.05, 0}));
  EXPECT_EQ(header.box->upper, (std::array<double, 3>{0.05, 0.05, length}));
  EXPECT_FALSE(header.box->tilted);
  EXPECT_EQ(read_dump_header(lammps_file("drum.20000.txt")).step, 20000);
}

TEST(LammpsDump, HasTheMassAndTheEnergyThatLammpsPrints) {
  const std::vector<Particle> balls = balls_of("drum.40000.txt");
  ASSERT_EQ(balls.size(), 63U);
  EXPECT_EQ(std::count_if(balls.begin(), balls.end(), [](const Particle& p) { return p.radius == 0.005; }),
            41);
  EXPECT_EQ(std::count_if(balls.begin(), balls.end(), [](const Particle& p) { return p.radius == 0.003; }),
            22);
  for (std::size_t p = 0; p < balls.size(); ++p) EXPECT_EQ(balls[p].id, static_cast<long long>(p) + 1);
  const Totals totals = totals_of(balls);
  EXPECT_NEAR(totals.mass / 0.059889228, 1, 1e-8);
  EXPECT_NEAR(totals.kinetic / 0.0109036889, 1, 2e-8);
  EXPECT_NEAR(totals.moment[0] / totals.mass / 0.00819565436, 1, 2e-8);
  EXPECT_NEAR(totals.moment[1] / totals.mass / -0.0228502335, 1, 2e-8);
}

TEST(LammpsDump, UnwrappedPositionsHaveTheCentreThatLammpsPrints) {
  const Totals totals = totals_of(balls_of("unwrapped.40000.txt"));
  EXPECT_NEAR(totals.moment[2] / totals.mass / 0.019307788, 1, 1e-5);
}

TEST(LammpsDump, PlainGzipScaledAndUnwrappedAreTheSameBalls) {
  const std::vector<Particle> plain = balls_of("drum.40000.txt");
  // What 9, 9 and LAMMPS' usual 6 digits leave open
  const std::vector<std::pair<std::string, double>> others{
      {"sorted.40000.gz", 1e-9}, {"scaled.40000.txt", 1e-9}, {"unwrapped.40000.txt", 6e-6}};
  for (const auto& [name, error] : others) {
    const std::vector<Particle> other = balls_of(name);
    ASSERT_EQ(other.size(), plain.size()) << name;
    for (std::size_t p = 0; p < plain.size(); ++p) {
      EXPECT_EQ(other[p].radius, plain[p].radius);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(other[p].velocity[axis], plain[p].velocity[axis], error) << name;
        const double apart = other[p].position[axis] - plain[p].position[axis];
        const double turns = axis == 2 ? std::round(apart / length) : 0;
        EXPECT_NEAR(apart, turns * length, error) << name << ", ball " << plain[p].id;
      }
    }
  }
}

TEST(LammpsDump, DumpsOfTheStyleAtomHaveNoVelocities) {
  const std::string refusal = message_of<DumpError>([] { read_dump(lammps_file("atom.40000.txt")); });
  expect_named(refusal, {"atom.40000.txt:9", "'vx' is missing", "id type xs ys zs"});
}

TEST(LammpsDump, OtherUnitsThanSiAreRefused) {
  const std::string rest = dump_text(5, {{1, {0, 0, 0}, {0, 0, 0}, 0.1}});
  EXPECT_EQ(parse_dump("ITEM: UNITS\nsi\n" + rest, "dump").particles.size(), 1U);
  expect_named(refusal_of_dump("ITEM: UNITS\ncgs\n" + rest), {"dump7.txt:2", "'cgs'", "si"});
}

}  // namespace
}  // namespace millfoam::averaging
