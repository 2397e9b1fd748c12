// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/dumps/dump_rows.hpp"

#include <gtest/gtest.h>

#include "tests/averaging/dumps/dump_support.hpp"

namespace millfoam::averaging {
namespace {

TEST(DumpRows, AnyRecordWrittenIsReadBack) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const std::vector<Particle> balls = random_balls(seed * seed, seed);
    expect_same(parse_dump(dump_text(100, balls), "dump").particles, balls);
  }
}

TEST(DumpRows, PiecesOfAnySizeGiveTheSame) {
  const std::string text = short_text(random_balls(40, 2));
  const std::vector<Particle> expected = parse_dump(text, "dump").particles;
  for (std::size_t piece = 1; piece < 300; piece += 1 + piece / 8) {
    std::size_t given = 0;
    std::string present;
    const auto more = [&](std::string_view rest) {
      std::string next = std::string(rest) + text.substr(given, piece);
      given = std::min(text.size(), given + piece);
      present.swap(next);
      return std::string_view(present);
    };
    TextLines lines(more, "dump");
    expect_same(read_record(lines, text.size()).particles, expected);
  }
}

TEST(DumpRows, ParticlesThatComeAndGoAreTheRecordsOwn) {
  const std::vector<Particle> balls = random_balls(9, 3);
  for (std::size_t count : {9U, 4U, 0U, 7U}) {
    const std::vector<Particle> some(balls.begin(), balls.begin() + static_cast<std::ptrdiff_t>(count));
    expect_same(parse_dump(dump_text(1, some), "dump").particles, some);
  }
}

TEST(DumpRows, ADoubledIdIsToldWithBothLines) {
  std::vector<Particle> balls = random_balls(30, 4);
  balls[20].id = balls[3].id;
  expect_named(refusal_of_dump(dump_text(1, balls)),
               {"dump7.txt:30", "particle " + std::to_string(balls[3].id) + " appears twice", "line 13"});
}

}  // namespace
}  // namespace millfoam::averaging
