// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/files/window_journal.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "averaging/files/read_pieces.hpp"
#include "tests/averaging/test_support.hpp"

namespace millfoam::averaging {
namespace {

/// A file in memory, of which one call gives seven bytes at most and every third call is interrupted.
struct SlowFile {
  std::vector<char> content = std::vector<char>(100);
  int calls = 0;
  int failing = -1;  ///< the call that fails

  SlowFile() { std::iota(content.begin(), content.end(), '\0'); }

  std::string read(std::size_t size, off_t begin) {
    std::string found(size, 'x');
    const auto got = read_pieces(found.data(), size, begin, [&](void* data, std::size_t most, off_t at) {
      if (++calls == failing || calls % 3 == 0) {
        errno = calls == failing ? EIO : EINTR;
        return ssize_t{-1};
      }
      const std::size_t left = content.size() - std::min(content.size(), static_cast<std::size_t>(at));
      const std::size_t piece = std::min({most, left, std::size_t{7}});
      std::copy_n(content.begin() + at, piece, static_cast<char*>(data));
      return static_cast<ssize_t>(piece);
    });
    if (got < 0) return "error";
    found.resize(static_cast<std::size_t>(got));
    return found;
  }
};

TEST(ReadPieces, GiveAllBytesOfARange) {
  SlowFile file;
  EXPECT_EQ(file.read(50, 20), std::string(file.content.begin() + 20, file.content.begin() + 70));
  EXPECT_GT(file.calls, 50 / 7);
  EXPECT_EQ(file.read(0, 20), "");
}

TEST(ReadPieces, EndWithTheFile) {
  SlowFile file;
  EXPECT_EQ(file.read(50, 80), std::string(file.content.begin() + 80, file.content.end()));
}

TEST(ReadPieces, AnErrorIsNoEnd) {
  SlowFile file;
  file.failing = 2;
  EXPECT_EQ(file.read(50, 20), "error");
}

WindowAverage window_of(std::size_t cells, double value) {
  WindowAverage window;
  window.time = {value, value + 1, 3, false, true};
  window.mean = {std::vector<double>(cells, value),
                 std::vector<double>(3 * cells, value),
                 std::vector<double>(cells, value),
                 std::vector<double>(cells, value),
                 {}};
  for (auto* field : {&window.number, &window.solidity_deviation, &window.granular_temperature})
    field->assign(cells, value);
  window.velocity_deviation.assign(3 * cells, value);
  return window;
}

TEST(WindowJournal, GivesBackItsWindowsAndNamesOneThatIsCutShort) {
  const TemporaryFolder folder;
  const std::size_t cells = 1000;
  WindowJournal journal(folder / "journal", 17, cells, false, 0);
  for (const double value : {0.25, 0.5}) journal.append(window_of(cells, value));
  EXPECT_EQ(journal.read(0).mean.solidity, std::vector<double>(cells, 0.25));
  EXPECT_EQ(journal.read(1).mean.velocity, std::vector<double>(3 * cells, 0.5));
  EXPECT_EQ(journal.read(1).time.records, 3);
  std::filesystem::resize_file(folder / "journal", std::filesystem::file_size(folder / "journal") - 8);
  EXPECT_EQ(journal.read(0).mean.solidity, std::vector<double>(cells, 0.25));
  expect_named(message_of<SolidsFileError>([&] { journal.read(1); }), {"journal: window 1 is damaged"});
}

}  // namespace
}  // namespace millfoam::averaging
