// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/resumption.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <sstream>

#include "dem_driver/folder_preparation.hpp"
#include "dem_driver/record_rows.hpp"
#include "dem_driver/run_file.hpp"
#include "small_mill.hpp"

namespace millfoam::dem_driver {
namespace {

using tests::message_of;
using tests::small_mill;
using tests::TemporaryFolder;

const std::string deck = "# small drum\nprocessors 1 1 1\nrun 300 upto\n";
const std::string other_deck = "# another drum\nprocessors 1 1 1\nrun 300 upto\n";

DemPlan plan_of(double duration) {
  meshing::Mill mill = small_mill();
  mill.dem.duration = duration;
  return plan_dem(mill);
}

/// A folder with the files of a run of 0.3 s that matter to the next one.
class Resumption : public ::testing::Test {
 protected:
  Resumption() { prepare_folders(folder_); }

  static void write(const std::filesystem::path& file, const std::string& text) {
    std::ofstream(file, std::ios::binary) << text;
  }
  static std::string read(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  std::filesystem::path restart(long step) const {
    return folder_.dem() / ("restart." + std::to_string(step));
  }
  /// What a run has left that has reached a step.
  void run_to(long step) const {
    write(folder_.deck(), deck);
    for (long at = 0; at <= step; at += plan_.step.steps_per_record) {
      std::ofstream out(folder_.dumps() / ("dump." + std::to_string(at) + ".txt"));
      out << "ITEM: TIMESTEP\n" << at << "\nITEM: NUMBER OF ATOMS\n250\nBOX\n0 1\n0 1\n0 1\nITEM: ATOMS id\n";
      for (int ball = 1; ball <= 250; ++ball) out << ball << '\n';
    }
    tests::write_rows(folder_, plan_, step);
    tests::write_restart(restart(step), {250});
  }
  void complete_run() const {
    run_to(plan_.end_step());
    write_run_file(folder_, small_mill(), plan_);
  }
  std::optional<long> step(const DemPlan& plan, const std::string& deck_of_plan = deck) {
    return resumable(folder_, plan, deck_of_plan, said_);
  }
  /// Refused, and nothing is taken away.
  void expect_refused(const DemPlan& plan, const std::string& words, const std::string& deck_of_plan = deck) {
    const std::string message = message_of([&] { step(plan, deck_of_plan); });
    EXPECT_NE(message.find(words), std::string::npos) << message;
    EXPECT_NE(message.find("cannot be resumed; without --resume, or when its dem/ and dumps/ are removed"),
              std::string::npos)
        << message;
  }

  TemporaryFolder temporary_;
  CaseFolder folder_{temporary_.path()};
  DemPlan plan_ = plan_of(0.3);
  DemPlan longer_ = plan_of(0.4);
  std::ostringstream said_;
};

TEST_F(Resumption, AnEmptyFolderHasNoRun) {
  EXPECT_EQ(step(plan_), std::nullopt);
}

TEST_F(Resumption, AnInterruptedRunResumesAtItsLastRestartFile) {
  run_to(plan_.restart_steps);
  EXPECT_EQ(step(plan_), plan_.restart_steps);
  expect_refused(plan_, "another mill.yaml", other_deck);
}

TEST_F(Resumption, AnInterruptedRunWithoutAWholeRestartFileIsNotReplaced) {
  run_to(plan_.restart_steps);
  write(restart(plan_.restart_steps), "cut");
  expect_refused(plan_, "expected one from which the interrupted run is resumed");
  EXPECT_NE(said_.str().find("is not complete and is not used"), std::string::npos);
}

TEST_F(Resumption, AnInterruptedRunBeforeItsFirstRestartFileStartsAgain) {
  run_to(plan_.restart_steps);
  std::filesystem::remove(restart(plan_.restart_steps));
  EXPECT_EQ(step(plan_), std::nullopt);
}

TEST_F(Resumption, ARunWithALostOrACutRowResumesAtTheRestartFileBeforeIt) {
  run_to(2 * plan_.restart_steps);
  tests::write_restart(restart(plan_.restart_steps), {250});
  EXPECT_EQ(step(plan_), 2 * plan_.restart_steps);
  const auto file = folder_.dem() / "energy.0.txt";
  const std::string rows = read(file);
  const std::string lost = std::to_string(plan_.restart_steps + plan_.step.steps_per_record);
  const auto at = rows.find('\n' + lost + ' ') + 1;
  const auto end = rows.find('\n', at);
  // The whole line, a part of it, its line end
  for (const auto begin : {at, at + 2, end}) {
    write(file, rows.substr(0, begin) + rows.substr(end + 1));
    EXPECT_EQ(step(plan_), plan_.restart_steps) << begin - at;
    EXPECT_NE(said_.str().find(file.string() + ": "), std::string::npos) << said_.str();
    EXPECT_NE(said_.str().find("step " + lost), std::string::npos) << said_.str();
  }
  cut_rows_after(folder_, plan_, plan_.restart_steps);
  EXPECT_EQ(read(file), rows.substr(0, at));
  write(file, "");
  expect_refused(plan_, "with all dumps and rows of torque and energy before it");
}

TEST_F(Resumption, ACompleteRunIsKeptWithoutItsRestartFileToo) {
  complete_run();
  EXPECT_EQ(step(plan_), plan_.end_step());
  write(restart(plan_.end_step()), "damaged");
  EXPECT_EQ(step(plan_), plan_.end_step());
  std::filesystem::remove(restart(plan_.end_step()));
  EXPECT_EQ(step(plan_), plan_.end_step());
  expect_refused(plan_, "another mill.yaml", other_deck);
}

TEST_F(Resumption, ACompleteRunIsKeptWithoutTheStateOfItsAverages) {
  plan_.averages = {"id"};
  complete_run();
  EXPECT_EQ(step(plan_), plan_.end_step());
}

TEST_F(Resumption, ACompleteRunOfWhichDumpsAreLostIsNotTakenForWhole) {
  complete_run();
  std::filesystem::remove(restart(plan_.end_step()));
  std::filesystem::remove(folder_.dumps() / "dump.0.txt");
  expect_refused(plan_, "30 dumps up to step " + std::to_string(plan_.end_step()) + ", expected 31");
}

TEST_F(Resumption, ACompleteRunIsMadeLongerFromItsRestartFileOrNotAtAll) {
  complete_run();
  EXPECT_EQ(step(longer_), plan_.end_step());
  std::filesystem::remove(restart(plan_.end_step()));
  expect_refused(longer_, "no complete restart file");
  write(restart(plan_.end_step()), "damaged");
  expect_refused(longer_, "no complete restart file");
  tests::write_restart(restart(plan_.end_step()), {250});
  longer_.averages = {"id"};
  expect_refused(longer_, "no complete restart file with the averages of its step");
}

TEST_F(Resumption, ARunMayHaveOtherRanksAndAnotherLengthButNoOtherDeck) {
  const auto deck_of = [](const std::string& ranks, const std::string& steps, const std::string& seed) {
    return "processors " + ranks + "\ninsert " + seed + "\nthermo " + steps + "\nfix h all ave/histo " +
           steps + " 1 0 5\nrun " + steps + " upto every 10\n";
  };
  run_to(plan_.restart_steps);
  write(folder_.deck(), deck_of("1 1 1", "300", "7"));
  EXPECT_EQ(step(plan_, deck_of("2 1 1", "400", "7")), plan_.restart_steps);
  expect_refused(plan_, "another mill.yaml", deck_of("1 1 1", "300", "8"));
  // Not the length of a stage before the mill turns
  write(folder_.deck(), deck + "run 50\n");
  expect_refused(plan_, "another mill.yaml", deck + "run 60\n");
}

TEST_F(Resumption, ADeckThatMakesOtherFoldersIsOfTheSameRun) {
  run_to(plan_.restart_steps);
  EXPECT_EQ(step(plan_, deck + "shell mkdir ../dumps\n"), plan_.restart_steps);
  expect_refused(plan_, "another mill.yaml", deck + "shell mv a b\n");
}

TEST_F(Resumption, ACompleteRunIsNotMadeShorter) {
  complete_run();
  std::filesystem::remove(restart(plan_.end_step()));
  expect_refused(plan_of(0.2), "at least the 0.3 s");
}

TEST_F(Resumption, ACompleteRunWithoutItsDeckIsNotReplaced) {
  complete_run();
  std::filesystem::remove(folder_.deck());
  expect_refused(plan_, folder_.deck().string() + ": no such file");
}

TEST_F(Resumption, ARunFileThatIsDamagedIsNamed) {
  complete_run();
  write(folder_.run_file(), "{");
  expect_refused(plan_, folder_.run_file().string() + ":1: this is not JSON");
  write(folder_.run_file(), R"({"timestep_s": 0, "duration_s": 1})");
  expect_refused(plan_, folder_.run_file().string() + ": key 'timestep_s' is 0, expected a positive number");
  write(folder_.run_file(), R"({"timestep_s": 1e-5, "duration_s": 1e12})");
  expect_refused(plan_,
                 folder_.run_file().string() +
                     ": key 'duration_s' is 1000000000000.0, expected a number of steps of 'timestep_s'");
  write(folder_.run_file(), R"({"timestep_s": 1e-5})");
  expect_refused(plan_,
                 folder_.run_file().string() + ": key 'duration_s' is missing, expected a time in s above 0");
}

TEST_F(Resumption, ADeckAloneIsOneOfTheRunThatIsThere) {
  const auto refusal = [&](const std::string& deck_alone) {
    return message_of([&] { require_deck_of_run(folder_, deck_alone); });
  };
  EXPECT_EQ(refusal(deck), "");
  write(folder_.deck(), deck);
  EXPECT_EQ(refusal(other_deck), "") << "nothing was run with the deck that is there";
  run_to(plan_.restart_steps);
  EXPECT_EQ(refusal(deck), "");
  const std::string message = refusal(other_deck);
  EXPECT_EQ(message.find(folder_.deck().string() + ": the existing run has another mill.yaml"), 0u)
      << message;
  EXPECT_NE(message.find("a run without --deck-only and --resume replaces it"), std::string::npos) << message;
  std::filesystem::remove(restart(plan_.restart_steps));
  EXPECT_NE(refusal(other_deck), "") << "there are dumps";
  prepare_folders(folder_);
  write_run_file(folder_, small_mill(), plan_);
  EXPECT_NE(refusal(other_deck), "") << "there is a complete run without dumps";
  std::filesystem::remove(folder_.deck());
  EXPECT_NE(refusal(deck), "") << "there is a complete run without a deck";
}

/// A deck that begins with the last state of another run, at a step.
std::string deck_from(long begin) {
  return "read_restart restart." + std::to_string(begin) + '\n' + deck;
}

TEST_F(Resumption, ADeckAloneGetsTheRestartFileWithWhichItBegins) {
  const auto state_at = [&](long begin, const std::string& text) {
    const auto file = temporary_.path() / ("other." + std::to_string(begin));
    write(file, text);
    return LastState{file, begin, "id"};
  };
  const auto write_alone = [&](const std::string& text, const std::optional<LastState>& state) {
    prepare_deck_alone(folder_, text, state);
    write(folder_.deck(), text);
  };
  const long begin = plan_.restart_steps;
  write_alone(deck_from(2 * begin), state_at(2 * begin, "one"));
  EXPECT_EQ(read(restart(2 * begin)), "one");
  // No run has begun: another deck takes its place, and its restart file that of the deck before
  write_alone(deck_from(begin), state_at(begin, "two"));
  EXPECT_EQ(read(restart(begin)), "two");
  EXPECT_FALSE(std::filesystem::exists(restart(2 * begin)));
  write_alone(deck, std::nullopt);
  EXPECT_FALSE(std::filesystem::exists(restart(begin)));
}

TEST_F(Resumption, ADeckAloneTakesNoRestartFileOfARunAway) {
  const long begin = plan_.restart_steps;
  write(folder_.deck(), deck_from(begin));
  write(restart(2 * begin), "the run's");
  const auto file = temporary_.path() / "other";
  write(file, "the other's");
  prepare_deck_alone(folder_, deck_from(begin), LastState{file, begin, "id"});
  EXPECT_EQ(read(restart(begin)), "the other's");
  EXPECT_EQ(read(restart(2 * begin)), "the run's");
  EXPECT_NE(message_of([&] { prepare_deck_alone(folder_, other_deck, std::nullopt); }), "");
  // Without its deck it cannot be resumed, but it is not removed
  std::filesystem::remove(folder_.deck());
  prepare_deck_alone(folder_, other_deck, std::nullopt);
  EXPECT_EQ(read(restart(2 * begin)), "the run's");
}

}  // namespace
}  // namespace millfoam::dem_driver
