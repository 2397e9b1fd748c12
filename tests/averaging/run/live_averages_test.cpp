// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/run/live_averages.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "averaging/mesh/mesh_file.hpp"
#include "averaging/run/average_run.hpp"
#include "averaging/run/program.hpp"
#include "tests/averaging/mesh_support.hpp"
#include "tests/averaging/test_support.hpp"

namespace millfoam::averaging {
namespace {

namespace fs = std::filesystem;

/// Two ranks one after the other: what rank 1 gives is added when rank 0 asks for its sums.
struct TwoRanks {
  struct Rank : Communicator {
    Rank(TwoRanks& all, int number) : all_(all), number_(number) {}
    int rank() const override { return number_; }
    int size() const override { return 2; }
    void sum(std::vector<double>& numbers) override {
      if (number_ == 1) {
        all_.given = numbers;
        return;
      }
      ASSERT_EQ(all_.given.size(), numbers.size());
      for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] += all_.given[i];
    }
    TwoRanks& all_;
    int number_;
  };
  std::vector<double> given;
  Rank first{*this, 0}, second{*this, 1};
};

/// Balls of 0.1 and 0.07 m that move through the periodic box [0, 2) x [0, 1) x [0, 1) of 4 x 2 x 1 voxels,
/// with a record every 100 steps of 1e-4 s, from step 0 on.
struct Live : ::testing::Test {
  TemporaryFolder folder;
  Communicator alone;
  AverageRequest request{BoxGrid({0, 0, 0}, {2, 1, 1}, {4, 2, 1}, {true, false, false})};
  LiveRun run{{1e-4, std::nullopt, 0.2}, 0, 100, 5};
  LiveFiles files{folder / "averages_1"};
  std::vector<std::string> notes;

  Live() { request.windows = {{0.05, folder / "live.h5"}}; }

  static ParticleRecord record(long long step) {
    ParticleRecord all;
    all.step = step;
    const double time = 1e-4 * static_cast<double>(step);
    for (int i = 0; i < 5; ++i) {
      const double speed = 0.8 + 0.3 * i, phase = 0.37 * i;
      all.particles.push_back(
          {i + 1,
           {std::fmod(phase + speed * time, 2.0), 0.5 + 0.3 * std::sin(7 * time + i), 0.5},
           {speed, 2.1 * std::cos(7 * time + i), 0.1 * i},
           i % 2 == 0 ? 0.1 : 0.07});
    }
    return all;
  }

  std::unique_ptr<LiveAverages> begin(std::optional<long long> resumed = std::nullopt) {
    return std::make_unique<LiveAverages>(request, run, files, "id", resumed, alone);
  }
  static void add(LiveAverages& averages, long long first, long long last) {
    for (long long step = first; step <= last; step += 100) averages.add(record(step));
  }
  std::vector<SolidsSummary> finish(long long step, std::optional<double> steady_from = std::nullopt) {
    return finish_live(request, run, files, "id", {step, std::nullopt, steady_from, "millDem test"},
                       [this](const std::string& sentence) { notes.push_back(sentence); });
  }
  /// A run from its begin to a step.
  std::vector<SolidsSummary> whole_run(long long last) {
    const auto averages = begin();
    add(*averages, 0, last);
    averages->checkpoint();
    return finish(last);
  }
  std::string bytes(const fs::path& file) const {
    std::ifstream input(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(input), std::istreambuf_iterator<char>()};
  }
};

void expect_near(const std::vector<double>& found, const std::vector<double>& expected, double scale) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-12 * scale) << i;
}

void expect_same(const fs::path& one, const fs::path& other) {
  const SolidsReader found(one), expected(other);
  ASSERT_EQ(found.windows().size(), expected.windows().size());
  EXPECT_EQ(found.time0(), expected.time0());
  EXPECT_EQ(found.whole_run(), expected.whole_run());
  EXPECT_EQ(found.header().method, expected.header().method);
  for (std::size_t w = 0; w < found.windows().size(); ++w) {
    const TimeWindow &time = found.windows()[w], &expected_time = expected.windows()[w];
    EXPECT_EQ(time.begin, expected_time.begin);
    EXPECT_EQ(time.end, expected_time.end);
    EXPECT_EQ(time.records, expected_time.records);
    EXPECT_EQ(time.expected, expected_time.expected);
    EXPECT_EQ(time.starts_late, expected_time.starts_late);
    EXPECT_EQ(time.ends_short, expected_time.ends_short);
    const SolidsWindow mine = found.read_window(w), theirs = expected.read_window(w);
    expect_near(mine.solidity, theirs.solidity, 1);
    expect_near(mine.velocity, theirs.velocity, 2);
    expect_near(mine.diameter, theirs.diameter, 0.2);
    expect_near(mine.diameter43, theirs.diameter43, 0.2);
    const Ledger ledger = found.read_ledgers()[w], expected_ledger = expected.read_ledgers()[w];
    EXPECT_NEAR(ledger.deposited / expected_ledger.deposited, 1, 1e-12);
    EXPECT_NEAR(ledger.volume_in / expected_ledger.volume_in, 1, 1e-12);
  }
}

TEST_F(Live, OnACylinderThatTurnsAreThoseOfDumps) {
  for (long long step = 0; step <= 3000; step += 100)
    folder.write("dump" + std::to_string(step) + ".txt", dump_text(step, record(step).particles));
  CylinderRequest rings(CylinderGrid({0, 2.5}, {0, 1}, {5, 8, 2}));
  rings.turning = true;
  request.grid = rings;
  run.settings.angular_velocity = 3;
  whole_run(3000);
  AverageRequest later = request;
  later.dumps = (folder / "dump*.txt").string();
  later.timestep = 1e-4;
  later.angular_velocity = 3;
  later.windows[0].output = folder / "dumps.h5";
  average_run(later, {[](std::size_t, std::size_t) {}, [](const std::string&) {}}, alone);
  expect_same(folder / "live.h5", folder / "dumps.h5");
  EXPECT_EQ(std::get<CylinderGrid>(SolidsReader(folder / "live.h5").grid()).frame().angular_velocity, 3);
}

TEST_F(Live, AreThoseOfDumpsForAllWindowsAndEnds) {
  for (long long step = 0; step <= 10000; step += 100)
    folder.write("dump" + std::to_string(step) + ".txt", dump_text(step, record(step).particles, "pp mm pp"));
  struct Ends {
    std::optional<double> start, end;
  };
  for (const Ends& ends : {Ends{}, Ends{0.1, std::nullopt}, Ends{0.12, 0.83}}) {
    request.start = ends.start;
    request.end = ends.end;
    request.windows = {{0.05, folder / "a.h5"}, {0.07, folder / "b.h5"}, {std::nullopt, folder / "whole.h5"}};
    const std::vector<SolidsSummary> summaries = whole_run(10000);
    ASSERT_EQ(summaries.size(), 3U);
    EXPECT_EQ(summaries[0].header.program, "millDem test");
    AverageRequest later = request;
    later.dumps = (folder / "dump*.txt").string();
    later.timestep = 1e-4;
    for (WindowsRequest& windows : later.windows) windows.output.replace_extension(".dumps.h5");
    std::vector<std::string> of_dumps;
    average_run(later,
                {[](std::size_t, std::size_t) {}, [&](const std::string& note) { of_dumps.push_back(note); }},
                alone);
    for (std::size_t s = 0; s < 3; ++s) expect_same(request.windows[s].output, later.windows[s].output);
    EXPECT_EQ(notes, of_dumps);
    notes.clear();
  }
}

TEST_F(Live, OnTwoRanksAreThoseOfOne) {
  whole_run(5000);
  fs::rename(folder / "live.h5", folder / "one.h5");
  TwoRanks ranks;
  LiveAverages first(request, run, files, "id", std::nullopt, ranks.first);
  LiveAverages second(request, run, files, "id", std::nullopt, ranks.second);
  for (long long step = 0; step <= 5000; step += 100) {
    // The balls change sides
    const auto cut = static_cast<std::ptrdiff_t>(step / 100 % 6);
    const ParticleRecord all = record(step);
    ParticleRecord left = all, right = all;
    left.particles.erase(left.particles.begin() + cut, left.particles.end());
    right.particles.erase(right.particles.begin(), right.particles.begin() + cut);
    second.add(right);
    first.add(left);
  }
  second.checkpoint();
  first.checkpoint();
  finish(5000);
  expect_same(folder / "live.h5", folder / "one.h5");
}

TEST_F(Live, ResumeFromTheirLastStateToTheSameBytes) {
  request.windows = {{0.05, folder / "live.h5"}, {std::nullopt, folder / "whole.h5"}};
  whole_run(5000);
  const std::string windows = bytes(folder / "live.h5"), whole = bytes(folder / "whole.h5");
  for (const long long kept : {0, 400, 500, 3300}) {
    {
      const auto killed = begin();
      add(*killed, 0, kept);
      killed->checkpoint();
      // Windows that are closed after it are made again
      add(*killed, kept + 100, kept + 1200);
    }
    const auto resumed = begin(kept);
    add(*resumed, kept + 100, 5000);
    resumed->checkpoint();
    finish(5000);
    EXPECT_EQ(bytes(folder / "live.h5"), windows) << kept;
    EXPECT_EQ(bytes(folder / "whole.h5"), whole) << kept;
  }
}

TEST_F(Live, OfARunThatIsMadeLongerAreThoseOfTheLongRun) {
  request.windows = {{0.05, folder / "live.h5"}, {std::nullopt, folder / "whole.h5"}};
  whole_run(5000);
  const std::string windows = bytes(folder / "live.h5"), whole = bytes(folder / "whole.h5");
  // To the middle of a window, to the first record of one, and to the last
  for (const long long end : {3200, 3500, 3900}) {
    whole_run(end);
    const auto longer = begin(end);
    add(*longer, end + 100, 5000);
    longer->checkpoint();
    finish(5000);
    EXPECT_EQ(bytes(folder / "live.h5"), windows) << end;
    EXPECT_EQ(bytes(folder / "whole.h5"), whole) << end;
  }
}

TEST_F(Live, LeaveOutTheWindowsBeforeTheChargeIsSteady) {
  whole_run(5000);
  const std::vector<TimeWindow> all = SolidsReader(folder / "live.h5").windows();
  notes.clear();
  finish(5000, 0.201);
  const SolidsReader steady(folder / "live.h5");
  EXPECT_EQ(steady.windows().size(), all.size() - 5);
  EXPECT_EQ(steady.time0(), all[5].begin);
  ASSERT_EQ(notes.size(), 2U);
  expect_named(notes[1], {"5 windows begin before 0.201 s", "left out"});
  expect_named(message_of<WindowError>([&] { finish(5000, 0.6); }),
               {"all windows begin before 0.6 s", "dem.duration", "averages.start"});
}

TEST_F(Live, BallsBeyondCellsThatDoNotRepeatAsTheRunDoesAreTold) {
  LiveEnd end{2000, std::nullopt, std::nullopt, "millDem test"};
  end.box = DumpBox{{0, 0, 0}, {2, 1, 1}, false, {"pp", "ff", "ff"}};
  const auto finish_in_box = [&] {
    whole_run(2000);
    notes.clear();
    finish_live(request, run, files, "id", end,
                [this](const std::string& sentence) { notes.push_back(sentence); });
  };
  finish_in_box();
  for (const std::string& note : notes) EXPECT_EQ(note.find("warning"), std::string::npos) << note;
  request.grid = BoxGrid({0, 0, 0}, {2, 1, 1}, {4, 2, 1});
  finish_in_box();
  ASSERT_FALSE(notes.empty());
  expect_named(notes.back(), {"warning: ",
                              " % of the balls' volume lies outside the cells: the balls repeat "
                              "along x after 2 m",
                              "expected --periodic x"});
}

TEST_F(Live, FilesOfOtherAveragesAreNotThoseOfTheRun) {
  const auto averages = begin();
  add(*averages, 0, 2000);
  averages->checkpoint();
  RunMetadata metadata;
  metadata.file = folder.write("run.json", "{}");
  metadata.run_id = "0123456789abcdef";
  const LiveEnd end{2000, metadata, std::nullopt, "millDem test"};
  EXPECT_FALSE(are_finished(request, run, end)) << "there is no file";
  finish_live(request, run, files, "id", end, [](const std::string&) {});
  EXPECT_TRUE(are_finished(request, run, end));
  LiveEnd of_another_program = end;
  of_another_program.program = "millAverage test";
  EXPECT_TRUE(are_finished(request, run, of_another_program));

  const auto differ = [&](const std::string& what, const auto& change) {
    AverageRequest other = request;
    change(other);
    EXPECT_FALSE(are_finished(other, run, end)) << what;
  };
  differ("fingerprint", [](AverageRequest& other) { other.mill_averages = "0a1b"; });
  differ("whole run", [](AverageRequest& other) { other.windows[0].length.reset(); });
  differ("length", [](AverageRequest& other) { other.windows[0].length = 0.04; });
  differ("start", [](AverageRequest& other) { other.start = 0.05; });
  differ("end", [](AverageRequest& other) { other.end = 0.15; });
  differ("method", [](AverageRequest& other) { other.method = DepositionMethod::sample; });
  differ("cap", [](AverageRequest& other) { other.solidity_cap = 0.7; });
  differ("period", [](AverageRequest& other) { other.grid = BoxGrid({0, 0, 0}, {2, 1, 1}, {4, 2, 1}); });
  differ("extent", [](AverageRequest& other) {
    other.grid = BoxGrid({0, 0, 0}, {2, 1, 1.01}, {4, 2, 1}, {true, false, false});
  });
  differ("shape", [](AverageRequest& other) {
    other.grid = BoxGrid({0, 0, 0}, {2, 1, 1}, {4, 1, 2}, {true, false, false});
  });
  differ("kind", [](AverageRequest& other) {
    other.grid = CylinderRequest(CylinderGrid({0, 1}, {0, 1}, {2, 2, 2}));
  });
  LiveEnd steady = end;
  steady.steady_from = 0.1;
  EXPECT_FALSE(are_finished(request, run, steady));
  LiveEnd of_another_run = end;
  of_another_run.metadata->run_id = "fedcba9876543210";
  EXPECT_FALSE(are_finished(request, run, of_another_run));
}

TEST_F(Live, FilesOnACylinderAndOnAMeshAreComparedByTheirCells) {
  const RunMetadata metadata = [&] {
    RunMetadata found;
    found.file = folder.write("run.json", "{}");
    found.run_id = "0123456789abcdef";
    return found;
  }();
  const LiveEnd end{1000, metadata, std::nullopt, "millDem test"};
  const auto expect_only = [&](const GridRequest& grid, const GridRequest& other) {
    request.grid = grid;
    const auto averages = begin();
    add(*averages, 0, 1000);
    averages->checkpoint();
    finish_live(request, run, files, "id", end, [](const std::string&) {});
    EXPECT_TRUE(are_finished(request, run, end));
    request.grid = other;
    EXPECT_FALSE(are_finished(request, run, end));
  };
  run.settings.angular_velocity = 3;
  CylinderRequest lab(CylinderGrid({0, 2.5}, {0, 1}, {5, 8, 2})), turning = lab;
  lab.cylindrical = true;
  turning.turning = true;
  expect_only(lab, turning);
  MeshRequest cells;
  for (const int along : {3, 2}) {
    const TestMesh mesh = box_mesh({0, 0, 0}, {2, 1, 1}, {along, 2, 1});
    cells.file = folder / ("mesh_" + std::to_string(along) + ".h5");
    MeshWriter writer(cells.file, mesh.topology, 0);
    writer.append(0, mesh.points);
    writer.finish();
  }
  cells.at_rest = true;
  MeshRequest others = cells;
  others.file = folder / "mesh_3.h5";
  expect_only(cells, others);
  others = cells;
  others.at_rest = false;
  expect_only(cells, others);
}

TEST_F(Live, MissingBallsAndAGridInMillimetresAreRefusedAtTheRecord) {
  const auto averages = begin();
  ParticleRecord fewer = record(0);
  fewer.particles.pop_back();
  expect_named(message_of<std::runtime_error>([&] { averages->add(fewer); }),
               {"4 balls at step 0, expected 5"});
  request.grid = BoxGrid({0, 0, 0}, {2000, 1000, 1000}, {2, 1, 1});
  expect_named(message_of<std::invalid_argument>([&] { begin()->add(record(0)); }),
               {"the balls fill only", "x 0 to 2000", "expected metres"});
  request.grid = BoxGrid({5, 0, 0}, {6, 1, 1}, {2, 1, 1});
  expect_named(message_of<std::invalid_argument>([&] { begin()->add(record(0)); }),
               {"100 % of the balls' volume lies outside", "x 5 to 6"});
  request.largest_outside = 1;
  EXPECT_NO_THROW(begin()->add(record(0)));
}

TEST_F(Live, ResumeFromAWholeStateOfTheSameAveragesOnly) {
  whole_run(2000);
  EXPECT_TRUE(has_checkpoint(files, "id", 2000));
  EXPECT_FALSE(has_checkpoint(files, "another", 2000));
  EXPECT_FALSE(has_checkpoint(files, "id", 1900));
  expect_named(message_of<SolidsFileError>([&] { begin(1900); }),
               {"averages_1.1900", "is not the state of these averages after step 1900", "--resume"});
  const fs::path state = files.checkpoint(2000);
  fs::copy(state, files.checkpoint(1900));
  EXPECT_FALSE(has_checkpoint(files, "id", 1900)) << "it is that of another step";
  // Windows are missing
  fs::resize_file(files.journal(0), fs::file_size(files.journal(0)) - 1);
  expect_named(message_of<SolidsFileError>([&] { begin(2000); }),
               {"averages_1.series_1.journal", "lacks windows"});
  fs::remove(files.journal(0));
  EXPECT_FALSE(has_checkpoint(files, "id", 2000));
  whole_run(2000);
  fs::resize_file(state, fs::file_size(state) - 8);
  EXPECT_FALSE(has_checkpoint(files, "id", 2000));
}

TEST_F(Live, NeedAWindowForEachRecordInterval) {
  request.windows[0].length = 0.005;
  expect_named(message_of<WindowError>([&] { plan_live(request, run, 5000); }),
               {"0.005 s is less than the 0.01 s between two records"});
  request.windows[0].length = 0.05;
  request.start = 0.7;
  EXPECT_THROW(plan_live(request, run, 5000), WindowError);
}

}  // namespace
}  // namespace millfoam::averaging
