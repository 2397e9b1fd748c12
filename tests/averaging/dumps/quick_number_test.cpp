// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/dumps/quick_number.hpp"

#include <gtest/gtest.h>

#include <charconv>
#include <cmath>
#include <cstring>
#include <random>
#include <sstream>
#include <string>

namespace millfoam::averaging {
namespace {

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
