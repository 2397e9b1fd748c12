// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <zlib.h>

#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "averaging/dumps/dump_reader.hpp"
#include "averaging/dumps/dump_rows.hpp"
#include "averaging/dumps/quick_number.hpp"
#include "averaging/dumps/unique_ids.hpp"
#include "tests/averaging/test_support.hpp"

namespace millfoam::averaging {
namespace {

std::vector<Particle> random_balls(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> number(-1, 1);
  std::vector<Particle> balls(count);
  long long id = 0;
  for (Particle& ball : balls) {
    ball.id = id += 1 + static_cast<long long>(random() % 3);
    ball.position = {number(random), number(random) * 1e-5, number(random) * 1e5};
    ball.velocity = {0, number(random) * 1e-300, number(random)};
    ball.radius = 1e-3 + std::abs(number(random));
  }
  std::shuffle(balls.begin(), balls.end(), random);
  return balls;
}

void expect_same(const std::vector<Particle>& found, const std::vector<Particle>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  std::size_t different = 0;
  for (std::size_t p = 0; p < found.size(); ++p) {
    const Particle &a = found[p], &b = expected[p];
    different +=
        a.id == b.id && a.position == b.position && a.velocity == b.velocity && a.radius == b.radius ? 0 : 1;
  }
  EXPECT_EQ(different, 0U);
}

/// The text with its numbers as LIGGGHTS prints them, "%g".
std::string short_text(const std::vector<Particle>& balls) {
  std::ostringstream text;
  text << "ITEM: TIMESTEP\n100\nITEM: NUMBER OF ATOMS\n"
       << balls.size() << "\nITEM: ATOMS id x y z vx vy vz radius \n";
  for (const Particle& p : balls) {
    text << p.id;
    for (const double value : p.position) text << ' ' << value;
    for (const double value : p.velocity) text << ' ' << value;
    text << ' ' << p.radius << " \n";
  }
  return text.str();
}

TEST(DumpProperties, AnyRecordWrittenIsReadBack) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const std::vector<Particle> balls = random_balls(seed * seed, seed);
    expect_same(parse_dump(dump_text(100, balls), "dump").particles, balls);
  }
}

TEST(DumpProperties, AFileIsReadAsItsTextWhereverItsBlocksEnd) {
  // More than several blocks; rows of numbers short and long, which two ways of reading share.
  const TemporaryFolder folder;
  const std::vector<Particle> balls = random_balls(12000, 1);
  expect_same(read_dump(folder.write("long.txt", dump_text(100, balls))).particles, balls);
  const std::string text = short_text(balls);
  expect_same(read_dump(folder.write("short.txt", text)).particles, parse_dump(text, "dump").particles);
}

TEST(DumpProperties, PiecesOfAnySizeGiveTheSame) {
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

TEST(DumpProperties, AMillionBallsAreReadPlainAndCompressed) {
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

TEST(DumpProperties, ParticlesThatComeAndGoAreTheRecordsOwn) {
  const std::vector<Particle> balls = random_balls(9, 3);
  for (std::size_t count : {9U, 4U, 0U, 7U}) {
    const std::vector<Particle> some(balls.begin(), balls.begin() + static_cast<std::ptrdiff_t>(count));
    expect_same(parse_dump(dump_text(1, some), "dump").particles, some);
  }
}

TEST(DumpProperties, ADoubledIdIsToldWithBothLines) {
  std::vector<Particle> balls = random_balls(30, 4);
  balls[20].id = balls[3].id;
  expect_named(refusal_of_dump(dump_text(1, balls)),
               {"dump7.txt:30", "particle " + std::to_string(balls[3].id) + " is there twice", "line 13"});
}

TEST(UniqueIds, TwinsAreFoundAmongDenseAndSparseIds) {
  const auto with_ids = [](const std::vector<long long>& ids) {
    std::vector<Particle> particles(ids.size());
    for (std::size_t p = 0; p < ids.size(); ++p) particles[p].id = ids[p];
    return particles;
  };
  constexpr long long least = std::numeric_limits<long long>::min(),
                      most = std::numeric_limits<long long>::max();
  EXPECT_FALSE(find_twins(with_ids({})));
  EXPECT_FALSE(find_twins(with_ids({5})));
  EXPECT_FALSE(find_twins(with_ids({3, 1, 2, -4})));
  EXPECT_FALSE(find_twins(with_ids({least, most, 0})));
  EXPECT_EQ(find_twins(with_ids({3, 1, 2, 1})), std::pair(std::size_t{1}, std::size_t{3}));
  EXPECT_EQ(find_twins(with_ids({most, least, 0, most})), std::pair(std::size_t{0}, std::size_t{3}));
}

TEST(DumpProperties, FilesThatAreNoDumpsAreRefused) {
  const TemporaryFolder folder;
  std::mt19937 random(9);
  std::string garbage(300000, ' ');
  for (char& c : garbage) c = static_cast<char>(random());
  for (const std::string& text : {std::string(), std::string("\n"), std::string(3000000, '\0'), garbage,
                                  std::string(3000000, 'x'), "ITEM: " + std::string(3000000, 'x') + "\n"}) {
    const auto file = folder.write("dump.txt", text);
    EXPECT_THROW(read_dump(file), DumpError);
    EXPECT_THROW(read_dump_step(file), DumpError);
  }
  EXPECT_THROW(read_dump(folder / ""), DumpError);
}

TEST(DumpProperties, AHeaderAloneIsRefused) {
  const std::string text = dump_text(1, random_balls(2, 1));
  const std::size_t columns = text.find("ITEM: ATOMS");
  expect_named(refusal_of_dump(text.substr(0, columns)), {"dump7.txt:9", "ends here", "truncated"});
  expect_named(refusal_of_dump(text.substr(0, text.find('\n', columns) + 1)),
               {"dump7.txt:10", "particle 1 of 2", "truncated"});
}

TEST(DumpProperties, ALineWithoutEndIsNotReadForEver) {
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

TEST(DumpProperties, CountsThatCannotBeAreRefused) {
  std::string text = dump_text(1, random_balls(2, 1));
  const std::size_t place = text.find("ATOMS\n2") + 6;
  for (const std::string count :
       {"-1", "9000000000000000000", "90000000000000000000", "2.0", "1e9", "", "two", "3"}) {
    std::string broken = text;
    expect_named(refusal_of_dump(broken.replace(place, 1, count)), {"dump7.txt:"});
  }
}

TEST(DumpProperties, AnItemThatIsThereTwiceIsRefused) {
  std::string text = dump_text(1, random_balls(2, 1));
  expect_named(refusal_of_dump("ITEM: TIMESTEP\n4\n" + text), {"dump7.txt:3", "'ITEM: TIMESTEP'", "twice"});
  expect_named(
      refusal_of_dump(text.substr(0, text.find("ITEM: BOX")) + text.substr(text.find("ITEM: NUMBER"))),
      {"dump7.txt:5", "'ITEM: NUMBER OF ATOMS'", "twice"});
}

TEST(DumpProperties, SeveralGzipStreamsInAFileAreOneText) {
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

TEST(DumpProperties, AGzipDumpWithAnyByteBrokenIsRefusedOrRead) {
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

/// What QuickNumber makes of a word, which must be what std::from_chars makes of it, or nothing.
bool agrees(const std::string& word, bool& easy) {
  const std::string text = word + " \n          ";
  double quick = 0, careful = 0;
  const char* const stop = QuickNumber::read(text.data(), text.data() + text.size(), quick);
  easy = stop == text.data() + word.size();
  if (!easy) return true;
  const auto [end, failure] = std::from_chars(word.data(), word.data() + word.size(), careful);
  return failure == std::errc{} && end == word.data() + word.size() &&
         std::memcmp(&quick, &careful, sizeof quick) == 0;
}

TEST(QuickNumber, AgreesWithTheStandardLibraryToTheLastBit) {
  std::mt19937_64 random(11);
  int easy_ones = 0;
  for (int n = 0; n < 200000; ++n) {
    std::ostringstream word;
    word.precision(static_cast<int>(1 + random() % 17));
    const double magnitude = std::pow(10.0, static_cast<double>(random() % 44) - 22);
    const double value = magnitude * (static_cast<double>(random() >> 11U) * 0x1p-52 - 1);
    if (random() % 3 == 0) word << std::fixed;
    word << value;
    bool easy = false;
    ASSERT_TRUE(agrees(word.str(), easy)) << word.str();
    easy_ones += easy ? 1 : 0;
  }
  EXPECT_GT(easy_ones, 100000);
}

TEST(QuickNumber, LeavesTheHardOnesAndWhatIsNoNumber) {
  for (const std::string word :
       {"0", "-0", "-0.0", "12345678", "123456789", "1234567.25", "0.00000001", "1.", ".5", "1e22", "1e-22",
        "9007199254740992", "0000000000000000001", "5e00", "5e+01"}) {
    bool easy = false;
    EXPECT_TRUE(agrees(word, easy)) << word;
    EXPECT_TRUE(easy) << word;
  }
  for (const std::string word : {"",
                                 "-",
                                 ".",
                                 "-.",
                                 "e5",
                                 "1e",
                                 "1e+",
                                 "1e-",
                                 "1e1000",
                                 "1e23",
                                 "1e-23",
                                 "9007199254740993",
                                 "18446744073709551617",
                                 "12345678901234567890123",
                                 "nan",
                                 "inf",
                                 "+1",
                                 "1x",
                                 "0x10",
                                 "--1",
                                 "1e-",
                                 "1d5",
                                 "1,5",
                                 "1.5.5"}) {
    bool easy = true;
    EXPECT_TRUE(agrees(word, easy)) << word;
    EXPECT_FALSE(easy) << word;
  }
}

}  // namespace
}  // namespace millfoam::averaging
