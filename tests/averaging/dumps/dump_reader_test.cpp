// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/dumps/dump_reader.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>

#include "tests/averaging/test_support.hpp"

namespace millfoam::averaging {
namespace {

const std::vector<Particle> two_balls{{7, {0.25, -0.5, 1e-3}, {1, -2, 3.5e-2}, 0.004},
                                      {3, {-0.125, 0.75, 0.5}, {0, 0, -1}, 0.001}};

void expect_two_balls(const ParticleRecord& record) {
  EXPECT_EQ(record.step, 1200);
  ASSERT_EQ(record.particles.size(), 2U);
  for (std::size_t p = 0; p < 2; ++p) {
    EXPECT_EQ(record.particles[p].id, two_balls[p].id);
    EXPECT_EQ(record.particles[p].position, two_balls[p].position);
    EXPECT_EQ(record.particles[p].velocity, two_balls[p].velocity);
    EXPECT_EQ(record.particles[p].radius, two_balls[p].radius);
  }
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t place = text.find(from);
  EXPECT_NE(place, std::string::npos) << from;
  return text.replace(place, from.size(), to);
}

void write_gzip(const std::filesystem::path& path, const std::string& text) {
  gzFile file = gzopen(path.c_str(), "wb");
  ASSERT_EQ(gzwrite(file, text.data(), static_cast<unsigned>(text.size())), static_cast<int>(text.size()));
  gzclose(file);
}

TEST(DumpReader, ReadsWhatLiggghtsWrites) {
  expect_two_balls(parse_dump(dump_text(1200, two_balls), "dump"));
}

TEST(DumpReader, FindsColumnsByNameInAnyOrder) {
  expect_two_balls(parse_dump(
      "ITEM: TIMESTEP\n1200\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS ff ff ff\n-1 1\n-1 1\n-1 1\n"
      "ITEM: ATOMS radius omegax vz vy vx fx z y x mol id\n"
      "0.004 9 3.5e-2 -2 1 nan 1e-3 -0.5 0.25 steel 7\n"
      "0.001 9 -1 0 0 nan 0.5 0.75 -0.125 glass 3\n",
      "dump"));
}

TEST(DumpReader, ToleratesWindowsLineEndsAndUnknownItems) {
  std::string text = dump_text(1200, two_balls);
  text = replaced(text, "ITEM: NUMBER", "ITEM: UNITS\nsi\nITEM: NUMBER");
  std::string windows;
  for (const char c : text) windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
  expect_two_balls(parse_dump(windows, "dump"));
}

TEST(DumpReader, ReadsARecordWithoutParticles) {
  EXPECT_TRUE(parse_dump(dump_text(5, {}), "dump").particles.empty());
}

TEST(DumpReader, GzipGivesTheSameAsPlainText) {
  const TemporaryFolder folder;
  const std::string text = dump_text(1200, two_balls);
  write_gzip(folder / "dump.txt.gz", text);
  expect_two_balls(read_dump(folder / "dump.txt.gz"));
  expect_two_balls(read_dump(folder.write("dump.txt", text)));
  EXPECT_EQ(read_dump_header(folder / "dump.txt.gz").step, 1200);
  EXPECT_EQ(read_dump_header(folder / "dump.txt").step, 1200);
}

TEST(DumpReader, ADumpCutAtAnyByteIsRefused) {
  const std::string text = dump_text(1200, two_balls);
  for (std::size_t length = 0; length < text.size(); ++length) {
    EXPECT_THROW(parse_dump(text.substr(0, length), "dump"), DumpError) << "cut after " << length << " bytes";
  }
}

TEST(DumpReader, AGzipDumpCutAtAnyByteIsRefused) {
  const TemporaryFolder folder;
  write_gzip(folder / "whole.gz", dump_text(1200, two_balls));
  std::ifstream input(folder / "whole.gz", std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(input), std::istreambuf_iterator<char>()};
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    const auto cut = folder.write("cut.gz", bytes.substr(0, length));
    EXPECT_THROW(read_dump(cut), DumpError) << "cut after " << length << " bytes";
  }
}

TEST(DumpReader, ADumpWithAnyByteBrokenIsReadOrRefusedButNeverWorse) {
  const std::string text = dump_text(1200, two_balls);
  for (std::size_t place = 0; place < text.size(); ++place) {
    for (const char c : {'\0', '\n', '-', '9', ' ', 'I', '\xff'}) {
      std::string broken = text;
      broken[place] = c;
      try {
        EXPECT_LE(parse_dump(broken, "dump").particles.size(), 2U);
      } catch (const DumpError&) {
      }
    }
  }
}

TEST(DumpReader, TruncationIsToldWithItsLineAndCount) {
  const std::string text = dump_text(1200, two_balls);
  expect_named(refusal_of_dump(text.substr(0, text.rfind("3 1 -0.125"))),
               {"dump7.txt:11", "particle 2 of 2", "truncated"});
  expect_named(refusal_of_dump(text.substr(0, text.size() - 3)), {"dump7.txt:11", "ends within this line"});
}

TEST(DumpReader, AMissingColumnIsNamedWithThoseThatAreThere) {
  expect_named(refusal_of_dump(replaced(dump_text(1200, two_balls), " vy ", " vyy ")),
               {"dump7.txt:9", "'vy' is missing", "id type x y z vx vyy vz radius"});
}

TEST(DumpReader, AValueThatIsNoFiniteNumberIsToldWithItsPlace) {
  const std::string text = dump_text(1200, two_balls);
  for (const std::string word : {"nan", "-nan", "inf", "0.75x", "abc", "1e999"}) {
    expect_named(refusal_of_dump(replaced(text, " 0.75 ", " " + word + " ")),
                 {"dump7.txt:11", "'y'", "'" + word + "'"});
  }
}

TEST(DumpReader, ARadiusThatIsNotPositiveIsRefused) {
  const std::string text = dump_text(1200, two_balls);
  expect_named(refusal_of_dump(replaced(text, "0.0040000000000000001", "-0.004")),
               {"dump7.txt:10", "radius", "-0.004"});
  expect_named(refusal_of_dump(replaced(text, "0.0040000000000000001", "0")),
               {"dump7.txt:10", "radius", "positive"});
}

TEST(DumpReader, AVelocityThatNoBallHasIsRefusedWithItsColumn) {
  const Particle ball{1, {0, 0, 0}, {1, -1e6, 1}, 0.1};
  EXPECT_EQ(parse_dump(dump_text(5, {ball}), "dump").particles[0].velocity[1], -1e6);
  for (const double velocity : {1e200, -1.1e6}) {
    Particle fast = ball;
    fast.velocity[2] = velocity;
    expect_named(refusal_of_dump(dump_text(5, {ball, fast})),
                 {"dump7.txt:11", "column 'vz' is ", "expected a velocity of at most 1e+06 m/s"});
  }
}

TEST(DumpReader, RowsOfTheWrongLengthAreRefused) {
  const std::string text = dump_text(1200, two_balls);
  expect_named(refusal_of_dump(replaced(text, "-0.125 0.75", "-0.125")),
               {"dump7.txt:11", "8 values", "expected 9"});
  expect_named(refusal_of_dump(replaced(text, "-0.125 0.75", "-0.125 1 0.75")),
               {"dump7.txt:11", "more values", "expected 9"});
}

TEST(DumpReader, MoreThanOneRecordOrTooManyRowsAreRefused) {
  const std::string text = dump_text(1200, two_balls);
  expect_named(refusal_of_dump(text + dump_text(1400, two_balls)), {"dump7.txt:12", "second record"});
  expect_named(refusal_of_dump(text + "9 1 0 0 0 0 0 0 1\n"), {"dump7.txt:12", "more rows", "2"});
}

TEST(DumpReader, AFileThatIsNoDumpIsRefused) {
  const TemporaryFolder folder;
  const auto notes = folder.write("notes.txt", "timestep 1e-5\n");
  expect_named(message_of<DumpError>([&] { read_dump_header(notes); }),
               {"notes.txt:1", "timestep 1e-5", "ITEM"});
  expect_named(message_of<DumpError>([&] { read_dump(folder / "gone.txt"); }), {"gone.txt", "open"});
}

TEST(DumpReader, AnAbsurdNumberOfAtomsIsRefusedAndNotReserved) {
  const std::string text = replaced(dump_text(1200, two_balls), "ATOMS\n2", "ATOMS\n9000000000000000000");
  expect_named(refusal_of_dump(text), {"dump7.txt:12", "particle 3 of 9000000000000000000"});
}

}  // namespace
}  // namespace millfoam::averaging
