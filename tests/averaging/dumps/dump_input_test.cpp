// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/dumps/dump_input.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

#include <random>

#include "tests/averaging/dumps/dump_support.hpp"

namespace millfoam::averaging {
namespace {

TEST(DumpInput, AFileIsReadAsItsTextWhereverItsBlocksEnd) {
  // More than several blocks; rows of numbers short and long, which two ways of reading share.
  const TemporaryFolder folder;
  const std::vector<Particle> balls = random_balls(12000, 1);
  expect_same(read_dump(folder.write("long.txt", dump_text(100, balls))).particles, balls);
  const std::string text = short_text(balls);
  expect_same(read_dump(folder.write("short.txt", text)).particles, parse_dump(text, "dump").particles);
}

TEST(DumpInput, AMillionBallsAreReadPlainAndCompressed) {
  const TemporaryFolder folder;
  std::vector<Particle> balls(1000000);
  long long id = 0;
  for (Particle& ball : balls) {
    ball.id = ++id;
    ball.position = {0.001 * static_cast<double>(id % 1000), 0.002, 0.003};
    ball.radius = 0.001;
  }
  const std::string text = short_text(balls);
  const auto plain = folder.write("dump.txt", text);
  EXPECT_EQ(read_dump(plain).particles.size(), balls.size());
  const auto compressed = folder / "dump.gz";
  gzFile file = gzopen(compressed.c_str(), "wb1");
  ASSERT_EQ(gzwrite(file, text.data(), static_cast<unsigned>(text.size())), static_cast<int>(text.size()));
  gzclose(file);
  const ParticleRecord record = read_dump(compressed);
  ASSERT_EQ(record.particles.size(), balls.size());
  EXPECT_EQ(record.particles.back().position[0], 0);
  EXPECT_EQ(record.particles[998].position[0], 0.999);
}

TEST(DumpInput, FilesThatAreNoDumpsAreRefused) {
  const TemporaryFolder folder;
  std::mt19937 random(9);
  std::string garbage(300000, ' ');
  for (char& c : garbage) c = static_cast<char>(random());
  for (const std::string& text : {std::string(), std::string("\n"), std::string(3000000, '\0'), garbage,
                                  std::string(3000000, 'x'), "ITEM: " + std::string(3000000, 'x') + "\n"}) {
    const auto file = folder.write("dump.txt", text);
    EXPECT_THROW(read_dump(file), DumpError);
    EXPECT_THROW(read_dump_header(file), DumpError);
  }
  EXPECT_THROW(read_dump(folder / ""), DumpError);
}

TEST(DumpInput, ALineWithoutEndIsNotReadForEver) {
  const TemporaryFolder folder;
  std::string text = dump_text(1, random_balls(2, 1));
  text += std::string(3000000, '1') + "\n";
  expect_named(message_of<DumpError>([&] { read_dump(folder.write("dump.txt", text)); }),
               {"dump.txt", "longer than"});
  text = dump_text(1, random_balls(2, 1));
  text.insert(text.find("ITEM: ATOMS"), "ITEM: COMMENT\n" + std::string(3000000, '1') + "\n");
  expect_named(message_of<DumpError>([&] { read_dump(folder.write("dump.txt", text)); }),
               {"dump.txt", "longer than"});
}

TEST(DumpInput, SeveralGzipStreamsInAFileAreOneText) {
  const TemporaryFolder folder;
  const std::vector<Particle> balls = random_balls(50, 6);
  const std::string text = dump_text(1, balls);
  const auto path = folder / "dump.gz";
  for (const std::string& part : {text.substr(0, 700), text.substr(700)}) {
    gzFile file = gzopen(path.c_str(), "ab");
    gzwrite(file, part.data(), static_cast<unsigned>(part.size()));
    gzclose(file);
  }
  expect_same(read_dump(path).particles, balls);
}

TEST(DumpInput, AGzipDumpWithAnyByteBrokenIsRefusedOrRead) {
  const TemporaryFolder folder;
  const std::vector<Particle> balls = random_balls(3, 7);
  const std::string text = dump_text(1, balls);
  const auto path = folder / "dump.gz";
  gzFile file = gzopen(path.c_str(), "wb");
  gzwrite(file, text.data(), static_cast<unsigned>(text.size()));
  gzclose(file);
  std::ifstream input(path, std::ios::binary);
  const std::string whole{std::istreambuf_iterator<char>(input), std::istreambuf_iterator<char>()};
  for (std::size_t place = 0; place < whole.size(); ++place) {
    std::string broken = whole;
    broken[place] = static_cast<char>(broken[place] ^ 0x21);
    try {
      // What is broken may be the file's time or name, which does not matter; its check sum finds the rest.
      expect_same(read_dump(folder.write("broken.gz", broken)).particles, balls);
    } catch (const DumpError&) {
    }
  }
}

}  // namespace
}  // namespace millfoam::averaging
