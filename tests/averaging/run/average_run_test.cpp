// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/run/average_run.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "averaging/dumps/run_metadata.hpp"
#include "averaging/files/output_lock.hpp"
#include "averaging/mesh/mesh_file.hpp"
#include "averaging/run/program.hpp"
#include "averaging/run/summary_file.hpp"
#include "averaging/statistics/redistribution.hpp"
#include "averaging/statistics/time_windows.hpp"
#include "tests/averaging/mesh_support.hpp"
#include "tests/averaging/test_support.hpp"

namespace millfoam::averaging {
namespace {

constexpr double inside = 4.0 / 3.0 * pi * 1e-3, outside = 4.0 / 3.0 * pi * 1.25e-4;

/// A closed box as text of an STL file.
std::string stl_box(const Vector3& lower, const Vector3& upper) {
  const int faces[][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {1, 3, 7, 5}, {3, 2, 6, 7}, {2, 0, 4, 6}};
  std::ostringstream text;
  text << "solid box\n";
  for (const auto& face : faces) {
    for (const auto& [b, c] : {std::pair{1, 2}, std::pair{2, 3}}) {
      text << "facet normal 0 0 0\nouter loop\n";
      for (const int corner : {face[0], face[b], face[c]}) {
        text << "vertex";
        for (int axis = 0; axis < 3; ++axis)
          text << ' ' << ((corner >> axis) % 2 == 0 ? lower : upper)[static_cast<std::size_t>(axis)];
        text << '\n';
      }
      text << "endloop\nendfacet\n";
    }
  }
  text << "endsolid box\n";
  return text.str();
}

/// Dumps every 100 steps of 1e-4 s, from 0 on: a ball of 0.1 m that moves at 1 m/s along x from (0.2, 0.5,
/// 0.5) in the box [0, 2) x [0, 1) x [0, 1) of two voxels, and a ball far outside.
struct AverageRun : ::testing::Test {
  TemporaryFolder folder;
  std::vector<std::string> notes;
  AverageRequest request{BoxGrid({0, 0, 0}, {2, 1, 1}, {2, 1, 1})};

  AverageRun() {
    for (int r = 0; r <= 150; ++r) {
      const double x = 0.2 + 0.01 * r;
      folder.write("dump" + std::to_string(100 * r) + ".txt",
                   dump_text(100 * r, {{1, {x, 0.5, 0.5}, {1, 0, 0}, 0.1}, {2, {0, 5, 0}, {}, 0.05}}));
    }
    request.dumps = (folder / "dump*.txt").string();
    request.timestep = 1e-4;
    request.windows = {{0.05, folder / "solids.h5"}};
  }

  std::string all_notes() const {
    std::string text;
    for (const std::string& note : notes) text += note + '\n';
    return text;
  }

  const std::filesystem::path& output() const { return request.windows[0].output; }

  SolidsSummary run() {
    Communicator alone;
    return average_run(
        request, {[](std::size_t, std::size_t) {}, [this](const std::string& s) { notes.push_back(s); }},
        alone)[0];
  }

  /// Runs until `dumps` are averaged and stops there, as a run that is killed would.
  void run_and_stop(std::size_t dumps) {
    Communicator alone;
    const auto stop = [dumps](std::size_t done, std::size_t) {
      if (done >= dumps) throw std::runtime_error("stopped");
    };
    EXPECT_THROW(average_run(request, {stop, [](const std::string&) {}}, alone), std::runtime_error);
  }

  std::string bytes(const std::filesystem::path& file) const {
    std::ifstream input(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(input), std::istreambuf_iterator<char>()};
  }
};

TEST_F(AverageRun, WritesWindowsWithTheVolumeWhereTheBallIs) {
  run();
  const SolidsReader solids(output());
  ASSERT_EQ(solids.windows().size(), 30U);
  EXPECT_EQ(solids.windows()[3].records, 5);
  EXPECT_NEAR(solids.windows()[3].begin, 0.15, 1e-15);
  EXPECT_FALSE(solids.windows()[3].starts_late || solids.windows()[3].ends_short);
  const SolidsWindow first = solids.read_window(0), last = solids.read_window(29);
  EXPECT_NEAR(first.solidity[0] / inside, 1, 1e-13);
  EXPECT_EQ(first.solidity[1], 0);
  EXPECT_NEAR(last.solidity[1] / inside, 1, 1e-13);
  EXPECT_NEAR(last.velocity[3], 1, 1e-14);
  EXPECT_NEAR(last.diameter[1], 0.2, 1e-15);
  ASSERT_EQ(notes.size(), 2U);
  expect_named(notes[0], {"1.5 s", "not used"});
}

TEST_F(AverageRun, SamplingAgreesWithExactVolumesToTheTemplatesError) {
  run();
  const SolidsWindow exact = SolidsReader(output()).read_window(15);
  request.method = DepositionMethod::sample;
  run();
  const SolidsWindow sampled = SolidsReader(output()).read_window(15);
  EXPECT_EQ(SolidsReader(output()).header().method, "sample, 12 points along a diameter");
  EXPECT_GT(exact.solidity[0], 0);
  EXPECT_GT(exact.solidity[1], 0);
  // `SphereTemplate`: at most 6.2 % of the ball.
  EXPECT_NEAR(sampled.solidity[0] / inside, exact.solidity[0] / inside, 0.062);
}

TEST_F(AverageRun, ReportsWhereTheVolumeWent) {
  const SolidsSummary summary = run();
  for (const WindowSummary& window : summary.windows) {
    EXPECT_NEAR(window.ledger.volume_in / (inside + outside), 1, 1e-12);
    EXPECT_NEAR(window.ledger.deposited / inside, 1, 1e-12);
    EXPECT_NEAR(window.ledger.outside / outside, 1, 1e-12);
  }
  expect_named(report(summary), {"solids.h5", "volume in", "88.8889", "11.1111", "derived from 8 to 64"});
  EXPECT_EQ(report(summarise(output())), report(summary));
}

TEST_F(AverageRun, FailsTheLedgerOnlyAboveTheTolerance) {
  const SolidsSummary summary = run();
  EXPECT_TRUE(ledger_failures(summary, 0.12).empty());
  const std::vector<std::string> failures = ledger_failures(summary, 0.1);
  ASSERT_EQ(failures.size(), 30U);
  expect_named(failures[2], {"window 2 from 0.1 s", "11.1 %", "outside the grid", "10 %"});
}

/// Dumps every 100 steps of 1e-4 s: a ball of 0.1 m at r = 0.5 that turns with a mill of -9 rad/s, and one of
/// 0.05 m at r = 0.25 at rest.
struct TurningRun : AverageRun {
  CylinderRequest rings{CylinderGrid({0, 1}, {0, 1}, {10, 36, 10})};

  TurningRun() {
    for (int r = 0; r <= 150; ++r) {
      const double angle = 0.4 - 9 * 0.01 * r, x = 0.5 * std::cos(angle), y = 0.5 * std::sin(angle);
      folder.write("dump" + std::to_string(100 * r) + ".txt",
                   dump_text(100 * r, {{1, {x, y, 0.5}, {9 * y, -9 * x, 0}, 0.1},
                                       {2, {0.25, 0, 0.5}, {0.01, 0.02, 0.03}, 0.05}}));
    }
    rings.turning = true;
    request.grid = rings;
    request.angular_velocity = -9;
    request.windows[0].length.reset();
  }
};

/// Share of a cylinder's voxel that lies in a ball, by the midpoint rule.
double share_in_ball(const CylinderGrid& grid, const std::array<int, 3>& voxel, const Vector3& centre,
                     double radius) {
  constexpr int steps = 80;
  double in = 0, all = 0;
  for (int i = 0; i < steps * steps * steps; ++i) {
    const double r = grid.spacing()[0] * (voxel[0] + (i % steps + 0.5) / steps);
    const double theta = grid.spacing()[1] * (voxel[1] + (i / steps % steps + 0.5) / steps);
    const double z = grid.spacing()[2] * (voxel[2] + (i / steps / steps + 0.5) / steps);
    all += r;
    if (std::hypot(r * std::cos(theta) - centre[0], r * std::sin(theta) - centre[1], z - centre[2]) < radius)
      in += r;
  }
  return in / all;
}

TEST_F(TurningRun, ABodyThatTurnsWithTheMillIsSharpInTheMeanOverTheRun) {
  run();
  const SolidsReader solids(output());
  const auto& grid = std::get<CylinderGrid>(solids.grid());
  EXPECT_EQ(grid.frame().angular_velocity, -9);
  const SolidsWindow mean = solids.read_window(0);
  // Where the ball is at time 0, in sector 0.4 / 10 degrees; on the other side nothing
  const std::size_t centre = grid.offset({4, 2, 4}), opposite = grid.offset({4, 20, 4});
  const Vector3 ball = {0.5 * std::cos(0.4), 0.5 * std::sin(0.4), 0.5};
  EXPECT_NEAR(mean.solidity[centre], share_in_ball(grid, {4, 2, 4}, ball, 0.1), 2e-3);
  EXPECT_NEAR(mean.velocity[3 * centre], 0, 1e-13);
  EXPECT_NEAR(mean.velocity[3 * centre + 1], -4.5, 1e-13);
  EXPECT_EQ(mean.solidity[opposite], 0);
  const Ledger ledger = solids.read_ledgers()[0];
  EXPECT_NEAR(ledger.volume_in / (sphere_volume(0.1) + sphere_volume(0.05)), 1, 1e-12);
  EXPECT_NEAR((ledger.deposited + ledger.outside) / ledger.volume_in, 1, 1e-14);
  // In the lab's frame that ball is spread over all sectors
  rings.turning = false;
  rings.cylindrical = true;
  request.grid = rings;
  run();
  const SolidsWindow lab = SolidsReader(output()).read_window(0);
  double ring = 0;  // mean over its sectors
  for (int sector = 0; sector < 36; ++sector) ring += mean.solidity[grid.offset({4, sector, 4})] / 36;
  EXPECT_GT(ring, 0.03);
  for (const std::size_t voxel : {centre, opposite}) EXPECT_NEAR(lab.solidity[voxel] / ring, 1, 0.3);
  const std::size_t resting = grid.offset({2, 0, 4});
  EXPECT_NEAR(lab.velocity[3 * resting], 0.01, 1e-13);
  EXPECT_NEAR(lab.velocity[3 * resting + 1], 0.02, 1e-13);
}

TEST_F(TurningRun, NeedsTheMillsSpeed) {
  request.angular_velocity.reset();
  expect_named(message_of<std::invalid_argument>([&] { run(); }),
               {"--frame is turning", "--speed", "run.json"});
}

TEST_F(TurningRun, WallsThatTurnWithItAreAtRest) {
  // The half y > 0 of the cylinder, at DEM time 0
  request.walls = {folder.write("box.stl", stl_box({-3, 0, 0}, {3, 3, 1}))};
  run();
  const SolidsReader solids(output());
  const auto& grid = std::get<CylinderGrid>(solids.grid());
  const SolidsWindow mean = solids.read_window(0);
  EXPECT_NEAR(mean.inside_fraction[grid.offset({5, 9, 5})], 1, 1e-12);
  EXPECT_NEAR(mean.inside_fraction[grid.offset({5, 27, 5})], 0, 1e-12);
}

TEST_F(AverageRun, OverTheWholeRunIsOneWindowToBeHeld) {
  request.windows[0].length.reset();
  request.start = 0.5;
  run();
  const SolidsReader solids(output());
  EXPECT_TRUE(solids.whole_run());
  ASSERT_EQ(solids.windows().size(), 1U);
  EXPECT_EQ(solids.windows()[0].records, 101);
  EXPECT_NEAR(solids.time0(), 0.5, 1e-15);
  const SolidsWindow whole = solids.read_window(0);
  EXPECT_NEAR((whole.solidity[0] + whole.solidity[1]) / inside, 1, 1e-12);
}

TEST_F(AverageRun, SeveralWindowLengthsInOnePassAreThoseOfRunsOfTheirOwn) {
  const std::vector<std::optional<double>> lengths{0.05, 0.12, std::nullopt};
  std::vector<std::string> apart;
  for (const auto& length : lengths) {
    request.windows = {{length, folder / "solids.h5"}};
    run();
    apart.push_back(bytes(output()));
  }
  request.windows.clear();
  for (std::size_t n = 0; n < lengths.size(); ++n) {
    request.windows.push_back({lengths[n], folder / ("together" + std::to_string(n) + ".h5")});
  }
  run();
  for (std::size_t n = 0; n < lengths.size(); ++n) {
    const SolidsReader one(request.windows[n].output);
    // Blocks are cut at all windows' ends, so the last bits of sums may differ.
    const SolidsReader other(folder.write("apart.h5", apart[n]));
    ASSERT_EQ(one.windows().size(), other.windows().size());
    for (std::size_t w = 0; w < one.windows().size(); ++w) {
      EXPECT_NEAR(one.read_window(w).solidity[0], other.read_window(w).solidity[0], 1e-15);
    }
  }
}

TEST_F(AverageRun, GivesTheSameFileWhateverTheNumberOfThreads) {
  request.threads = 1;
  run();
  const std::string alone = bytes(output());
  for (const int threads : {2, 5}) {
    request.threads = threads;
    run();
    EXPECT_EQ(bytes(output()), alone) << threads;
  }
}

TEST_F(AverageRun, StoppedAnywhereIsTakenUpAndGivesTheSameFile) {
  request.windows = {{0.05, folder / "solids.h5"}, {std::nullopt, folder / "whole.h5"}};
  run();
  const std::string windows = bytes(folder / "solids.h5"), whole = bytes(folder / "whole.h5");
  request.checkpoint_interval = 0;
  for (const std::size_t dumps : {5U, 62U, 148U}) {
    std::filesystem::remove(folder / "solids.h5");
    run_and_stop(dumps);
    EXPECT_FALSE(std::filesystem::exists(folder / "solids.h5"));
    notes.clear();
    run();
    expect_named(all_notes(), {"resuming"});
    EXPECT_EQ(bytes(folder / "solids.h5"), windows) << dumps;
    EXPECT_EQ(bytes(folder / "whole.h5"), whole) << dumps;
    for (const char* left :
         {"solids.h5.journal", "whole.h5.journal", "solids.h5.resume", "solids.h5.part", "solids.h5.lock"}) {
      EXPECT_FALSE(std::filesystem::exists(folder / left)) << left;
    }
  }
}

TEST_F(AverageRun, AStoppedRunOfOtherSettingsIsNotTakenUp) {
  run();
  const std::string fresh = bytes(output());
  request.checkpoint_interval = 0;
  request.method = DepositionMethod::sample;
  run_and_stop(60);
  request.method = DepositionMethod::exact;
  run();
  expect_named(all_notes(), {"other dumps, settings or another version"});
  EXPECT_EQ(bytes(output()), fresh);
}

TEST_F(AverageRun, WindowsOfAnotherStoppedRunInBetweenAreNotTakenForItsOwn) {
  run();
  const std::string fresh = bytes(output());
  request.checkpoint_interval = 0;
  run_and_stop(60);
  request.method = DepositionMethod::sample;
  request.checkpoint_interval = 1000;
  run_and_stop(100);
  request.method = DepositionMethod::exact;
  run();
  EXPECT_EQ(bytes(output()), fresh);
}

TEST_F(AverageRun, AStoppedRunWhoseWindowsAreGoneStartsAfresh) {
  run();
  const std::string fresh = bytes(output());
  request.checkpoint_interval = 0;
  run_and_stop(60);
  std::filesystem::remove(folder / "solids.h5.journal");
  notes.clear();
  run();
  expect_named(all_notes(), {"solids.h5.journal", "starting again"});
  EXPECT_EQ(bytes(output()), fresh);
}

TEST_F(AverageRun, ADamagedNoteOfHowFarItWasStartsAfresh) {
  run();
  const std::string fresh = bytes(output());
  request.checkpoint_interval = 0;
  run_and_stop(60);
  const std::string note = bytes(folder / "solids.h5.resume");
  folder.write("solids.h5.resume", note.substr(0, note.size() - 9));
  run();
  EXPECT_EQ(bytes(output()), fresh);
}

TEST_F(AverageRun, TakesTheTimestepFromTheNotesBesideTheDumps) {
  folder.write("run.json", R"({"timestep_s": 1e-4, "interval": 100, "angular_velocity_rad_s": -6.4})");
  request.timestep.reset();
  run();
  EXPECT_EQ(SolidsReader(output()).timestep(), 1e-4);
  EXPECT_EQ(SolidsReader(output()).header().angular_velocity, -6.4);
  request.timestep = 2e-4;
  expect_named(message_of<DumpError>([&] { run(); }), {"0.0002", "0.0001", "run.json"});
}

TEST_F(AverageRun, NamesTheMillAndTheDryRunOfTheNotes) {
  folder.write("run.json", R"({"mill": {"charge": "0a1b"}, "fines_mass_kg": 1, "charge_mass_kg": 1})");
  request.mill_averages = "2c3d";
  run();
  const SolidsHeader header = SolidsReader(output()).header();
  EXPECT_EQ(header.program, program());
  EXPECT_EQ(header.mill_charge, "0a1b");
  EXPECT_EQ(header.mill_averages, "2c3d");
  EXPECT_EQ(header.run_id, read_run_metadata(folder / "")->run_id);
  EXPECT_EQ(header.fines_share, 0.5);
}

TEST_F(AverageRun, LeavesTheSummaryThatReportsOfTheFileGive) {
  folder.write("run.json", R"({"mill": {"charge": "0a1b"}})");
  const SolidsSummary summary = run();
  EXPECT_EQ(bytes(folder / "solids.json"), as_json(summary, program()));
  EXPECT_EQ(as_json(summarise(output()), program()), as_json(summary, program()));
}

TEST_F(AverageRun, OverwritesNoFileOfAnotherKind) {
  const std::filesystem::path mill = folder.write("mill.yaml", "speed: 1\n");
  request.windows[0].output = mill;
  expect_named(message_of<SolidsFileError>([&] { run(); }), {"mill.yaml", "is not a millfoam-solids file"});
  EXPECT_EQ(bytes(mill), "speed: 1\n");
  request.windows[0].output = folder / "mill.h5";
  folder.write("mill.json", "{}");
  expect_named(message_of<SolidsFileError>([&] { run(); }), {"mill.json", "is not a millfoam-averages file"});
  EXPECT_EQ(bytes(folder / "mill.json"), "{}");
  for (const char* left : {"mill.h5", "mill.h5.journal", "mill.h5.lock", "mill.yaml.lock"}) {
    EXPECT_FALSE(std::filesystem::exists(folder / left)) << left;
  }
}

TEST_F(AverageRun, AnOutputThatAnotherRunIsWritingIsRefused) {
  const FileLock other = lock_output(output());
  expect_named(message_of<SolidsFileError>([&] { run(); }), {"solids.h5: another millAverage is writing"});
  EXPECT_FALSE(std::filesystem::exists(folder / "solids.h5.journal"));
}

TEST_F(AverageRun, AGridThatMissesTheBallsIsRefusedUnlessTheyComeToIt) {
  request.grid = BoxGrid({0, 10, 0}, {2, 11, 1}, {2, 1, 1});
  expect_named(message_of<std::invalid_argument>([&] { run(); }), {"dump0.txt", "100 %", "expected metres"});
  EXPECT_FALSE(std::filesystem::exists(folder / "solids.h5.journal"));
  request.largest_outside = 1;
  run();
  request.largest_outside = 0.5;
  request.grid = BoxGrid({1, 0, 0}, {2, 1, 1}, {2, 1, 1});
  EXPECT_LT(run().windows[0].ledger.deposited, 1e-10) << "the ball is not there yet";
}

TEST_F(AverageRun, AGridThatRepeatsAfterAnotherLengthThanTheDumpsIsRefused) {
  request.grid = BoxGrid({0, 0, 0}, {2, 1, 0.5}, {2, 1, 1}, {false, false, true});
  expect_named(message_of<std::invalid_argument>([&] { run(); }),
               {"--periodic z: the cells repeat after 0.5 m along z", "dump0.txt after 1 m (from 0 to 1 m)"});
  CylinderGrid rings({0, 1}, {0, 2}, {2, 2, 2}, true);
  request.grid = CylinderRequest(rings);
  expect_named(message_of<std::invalid_argument>([&] { run(); }), {"--periodic z", "after 2 m along z"});
  request.grid = BoxGrid({0, 0, 0}, {2, 1, 1 + 1e-6}, {2, 1, 1}, {false, false, true});
  run();
}

TEST_F(AverageRun, AGridThatRepeatsWhereTheDumpsDoNotIsRefused) {
  const auto write_first = [&](const std::string& flags) {
    folder.write("dump0.txt",
                 dump_text(0, {{1, {0.2, 0.5, 0.5}, {1, 0, 0}, 0.1}, {2, {0, 5, 0}, {}, 0.05}}, flags));
  };
  request.grid = BoxGrid({0, 0, 0}, {2, 1, 1}, {2, 1, 1}, {true, false, true});
  expect_named(
      message_of<std::invalid_argument>([&] { run(); }),
      {"--periodic x: the cells repeat after 2 m along x, but the balls of ",
       "dump0.txt do not: the flags of their box along x are mm; expected pp, or cells that do not"});
  for (const char* flags : {"pp mm pp", ""}) {  // without flags it is not known
    write_first(flags);
    EXPECT_NO_THROW(run()) << flags;
  }
  write_first("pp mm ff");
  expect_named(message_of<std::invalid_argument>([&] { run(); }), {"--periodic z", "along z are ff"});
}

TEST_F(AverageRun, BallsBeyondAGridThatDoesNotRepeatAsTheDumpsDoAreTold) {
  run();
  expect_named(notes.back(),
               {"warning: 11.1111 % of the balls' volume lies outside", "expected --periodic z"});
  notes.clear();
  request.grid = BoxGrid({0, 0, 0}, {2, 1, 1}, {2, 1, 1}, {false, false, true});
  run();
  request.grid = BoxGrid({0, 0, 0.1}, {2, 1, 0.9}, {2, 1, 1});
  run();
  for (const std::string& note : notes) EXPECT_EQ(note.find("--periodic"), std::string::npos) << note;
}

TEST_F(AverageRun, TheFirstDumpWithAnotherNumberOfBallsIsTold) {
  folder.write("dump9000.txt", dump_text(9000, {{1, {1.1, 0.5, 0.5}, {1, 0, 0}, 0.1}}));
  run();
  const auto is_told = [](const std::string& note) {
    return note.find("dump9000.txt has 1 balls") != std::string::npos;
  };
  ASSERT_EQ(std::count_if(notes.begin(), notes.end(), is_told), 1);
  expect_named(*std::find_if(notes.begin(), notes.end(), is_told), {"warning: ", "the dump before it has 2"});
}

TEST_F(AverageRun, OfAWholeRunExpectsAllItsDumps) {
  folder.write("run.json", R"({"timestep_s": 1e-4, "interval": 100, "duration_s": 1.5, "dumps": 151})");
  request.end = 1.5;
  request.whole_run_dumped = true;
  run();
  for (int r = 120; r <= 150; ++r)
    std::filesystem::remove(folder / ("dump" + std::to_string(100 * r) + ".txt"));
  expect_named(message_of<DumpError>([&] { run(); }),
               {(folder / "").parent_path().string() + ": 120 dumps, run.json says 151; expected all"});
  folder.write("run.json", R"({"timestep_s": 1e-4, "interval": 100, "duration_s": 1.5})");
  expect_named(message_of<WindowError>([&] { run(); }),
               {"the dumps end at 1.19 s, 0.31 s before the end 1.5 s", "expected those of the whole run"});
  request.whole_run_dumped = false;
  run();
  expect_named(all_notes(), {"warning: the dumps end at 1.19 s"});
}

TEST_F(AverageRun, AGapInsideAWindowIsInTheFileAndTheSummary) {
  for (const char* name : {"dump5200.txt", "dump5300.txt"}) std::filesystem::remove(folder / name);
  const SolidsSummary summary = run();
  const std::string sentence =
      "records are missing in 1 of 30 windows: window 10 from 0.5 to 0.55 s has 3 of 5 records";
  expect_named(report(summary), {"warning: " + sentence});
  EXPECT_EQ(report(summarise(output())), report(summary));
  expect_named(bytes(folder / "solids.json"), {sentence});
  const TimeWindow window = SolidsReader(output()).windows()[10];
  EXPECT_EQ(window.records, 3);
  EXPECT_EQ(window.expected, 5);
}

TEST_F(AverageRun, ADumpWithoutBallsBetweenOthersIsRefused) {
  for (const long long step : {0, 100, 15000})
    folder.write("dump" + std::to_string(step) + ".txt", dump_text(step, {}));
  run();  // the balls come in later
  folder.write("dump9000.txt", dump_text(9000, {}));
  expect_named(message_of<DumpError>([&] { run(); }), {"dump9000.txt: the dump has no balls, expected some"});
}

TEST_F(AverageRun, ADumpInAnotherUnitIsRefusedByItsName) {
  // Radii in mm in one dump of many, of which the first and the last are read before the work
  folder.write("dump9000.txt",
               dump_text(9000, {{1, {1.1, 0.5, 0.5}, {1, 0, 0}, 100}, {2, {0, 5, 0}, {}, 50}}));
  expect_named(message_of<DumpError>([&] { run(); }),
               {"dump9000.txt: the volume of the balls is 4.7", "m3, that of as many balls in ",
                "dump8900.txt is 0.0047", "expected about the same: is one of them in another unit than m?"});
}

TEST_F(AverageRun, ABallThatCannotBeDepositedIsNamedWithItsDump) {
  // 1e-5 m along x in each voxel
  request.grid = BoxGrid({0, 0, 0}, {2, 1, 1}, {200000, 1, 1});
  const auto expect_refused = [&](const std::string& name) {
    expect_named(message_of<std::invalid_argument>([&] { run(); }),
                 {name + ": ball 1: its radius of 0.1 m spans more than 10000 cells along x"});
  };
  expect_refused((folder / "dump0.txt").string());  // the first is read before the work
  request.grid = BoxGrid({0, 0, 0}, {2, 1, 1}, {40000, 1, 1});
  request.start = 0.85;
  request.end = 0.95;
  for (int r = 0; r <= 150; ++r) {
    const double radius = r == 90 ? 0.3 : 0.2;
    folder.write("dump" + std::to_string(100 * r) + ".txt",
                 dump_text(100 * r, {{1, {1, 0.5, 0.5}, {1, 0, 0}, radius}}));
  }
  expect_named(message_of<std::invalid_argument>([&] { run(); }),
               {(folder / "dump9000.txt").string() + ": ball 1: its radius of 0.3 m"});
}

/// The balls of AverageRun on the cells of a mesh, of a box of their size.
struct MeshRun : AverageRun {
  TestMesh mesh = box_mesh({0, 0, 0}, {2, 1, 1}, {2, 1, 1});
  MeshRequest cells;

  MeshRun() {
    MeshWriter writer(folder / "mesh.h5", mesh.topology, 0);
    writer.append(0, mesh.points);
    writer.finish();
    cells.file = folder / "mesh.h5";
  }
  void request_cells() { request.grid = cells; }
};

TEST_F(MeshRun, ATableThatEndsBeforeTheLastDumpIsRefusedBeforeTheWork) {
  cells.motion = {"translation table " + folder.write("table.txt", "0 0 0 0\n1.2 0 0 0\n").string()};
  request_cells();
  // Nothing is averaged: the first dump that cannot be read is not reached
  folder.write("dump9000.txt", "ITEM: TIMESTEP\n9000\nITEM: NUMBER OF ATOMS\n2\n");
  expect_named(message_of<std::out_of_range>([&] { run(); }),
               {(folder / "dump14900.txt").string() + ": " + (folder / "table.txt").string() +
                ": time 1.49 s is outside the table of the motion, which goes from 0 to 1.2 s"});
}

TEST_F(MeshRun, AMeshWithACellTurnedInsideOutIsNamedWithItsOption) {
  for (Eigen::Vector3d& point : mesh.points) point.x() = -point.x();
  MeshWriter writer(folder / "bad.h5", mesh.topology, 0);
  writer.append(0, mesh.points);
  writer.finish();
  const std::string bad = (folder / "bad.h5").string();
  cells.file = bad;
  request_cells();
  expect_named(message_of<std::invalid_argument>([&] { run(); }),
               {"--mesh " + bad + ": mesh: cell 0 has the volume -1 m3, expected a positive one"});
  request.grid = BoxGrid({0, 0, 0}, {2, 1, 1}, {2, 1, 1});
  request.walls = {bad};
  expect_named(message_of<std::invalid_argument>([&] { run(); }), {"--inside " + bad + ": mesh: cell 0"});
}

TEST_F(MeshRun, APeriodThatIsNotTheMeshsIsNamedWithItsOptionAndTheMesh) {
  cells.period_z = 1.00001;  // within the digits of the dumps
  const auto refused = [&] {
    request_cells();
    expect_named(message_of<std::invalid_argument>([&] { run(); }),
                 {"--mesh " + (folder / "mesh.h5").string() +
                  " --period 1.00001: the period is 1.00001 m, "
                  "expected the mesh's length along z, 1 m"});
  };
  refused();
  cells.smoothed = true;
  cells.smoothing = 0.1;
  refused();
  request.solidity_cap = 0.5;
  refused();
}

TEST_F(MeshRun, AMeshThatRepeatsWhereTheDumpsDoNotIsRefused) {
  cells.period_z = 1;
  request_cells();
  EXPECT_NO_THROW(run());
  folder.write("dump0.txt", dump_text(0, {{1, {0.2, 0.5, 0.5}, {1, 0, 0}, 0.1}}, "ff ff ff"));
  expect_named(message_of<std::invalid_argument>([&] { run(); }),
               {"--period: the cells repeat after 1 m along z", "the flags of their box along z are ff"});
}

TEST_F(MeshRun, AMeshOfSeveralTimesThatEndBeforeTheLastDumpIsRefusedBeforeTheWork) {
  MeshWriter writer(folder / "mesh.h5", mesh.topology, 0);
  writer.append(0, mesh.points);
  writer.append(1.2, mesh.points);
  writer.finish();
  request_cells();
  folder.write("dump9000.txt", "ITEM: TIMESTEP\n9000\nITEM: NUMBER OF ATOMS\n2\n");
  expect_named(
      message_of<std::out_of_range>([&] { run(); }),
      {"dump14900.txt: ", "mesh.h5: DEM time 1.49 s is outside the mesh's times, which go from 0 to 1.2"});
}

TEST_F(AverageRun, ASmallChangeOfTheBallsVolumeIsNotedOnce) {
  // Of wear, by 3.7 % of the volume; the ball of the other tests has 89 % of it
  for (int r = 80; r <= 150; ++r) {
    const double x = 0.2 + 0.01 * r, radius = r < 100 ? 0.0985 : 0.097;
    folder.write("dump" + std::to_string(100 * r) + ".txt",
                 dump_text(100 * r, {{1, {x, 0.5, 0.5}, {1, 0, 0}, radius}, {2, {0, 5, 0}, {}, 0.05}}));
  }
  run();
  const std::string text = all_notes();
  expect_named(text,
               {"warning: ", "dump8000.txt: the volume of the balls is 0.0045", "dump7900.txt is 0.0047"});
  EXPECT_EQ(text.find("dump10000.txt"), std::string::npos);
}

TEST_F(AverageRun, ACapThatLeavesNoRoomNamesThePlaceAndLeavesNoFile) {
  request.solidity_cap = 0.002;
  request.grid = BoxGrid({0, 0, 0}, {2, 1, 1}, {1, 1, 1});
  expect_named(message_of<NoRoomError>([&] { run(); }),
               {"window from 0 s: the solidity 0.00209", "voxel (0 0 0) at x 1, y 0.5, z 0.5 m",
                "above the cap of 0.002", "a larger --cap"});
  for (const char* left : {"solids.h5.journal", "solids.h5.resume", "solids.h5"})
    EXPECT_FALSE(std::filesystem::exists(folder / left)) << left;
}

TEST_F(AverageRun, WhereNoCapGivesRoomCoarserCellsAreExpected) {
  // One voxel in the middle of the ball
  request.grid = BoxGrid({0.49, 0.49, 0.49}, {0.51, 0.51, 0.51}, {1, 1, 1});
  request.largest_outside = 1;
  request.solidity_cap = 0.9;
  request.start = 0.3;
  request.end = 0.31;
  request.windows[0].length.reset();
  for (const int balls : {1, 2}) {
    std::vector<Particle> all;
    for (int b = 0; b < balls; ++b) all.push_back({b + 1, {0.5, 0.5, 0.5}, {1, 0, 0}, 0.1});
    folder.write("dump3000.txt", dump_text(3000, all));
    expect_named(message_of<NoRoomError>([&] { run(); }),
                 {"the solidity " + std::to_string(balls) + " of voxel (0 0 0)",
                  "expected coarser cells, or balls that do not overlap"});
  }
}

TEST_F(AverageRun, WallsInMillimetresAreRefusedOrTold) {
  request.walls = {folder.write("box.stl", stl_box({-600, -600, 0}, {600, 600, 30}))};
  expect_named(message_of<std::invalid_argument>([&] { run(); }),
               {"--inside: the walls are 1200 m long, above 20 m", "expected walls in m"});
  request.walls = {folder.write("box.stl", stl_box({-5, -5, -5}, {5, 5, 5}))};
  const SolidsSummary all_inside = run();
  expect_named(report(all_inside),
               {"warning: the walls cut no cell: all lie inside, and the walls are 5 times as wide"});
  EXPECT_EQ(report(summarise(output())), report(all_inside));
  for (const double wide : {1.0, 1.1}) {  // one cuts voxels, the other is hardly wider
    request.walls = {folder.write("box.stl", stl_box({0, 0, 0}, {2 * wide, wide, 0.9 * wide}))};
    EXPECT_EQ(report(run()).find("the walls cut no cell"), std::string::npos);
  }
}

TEST_F(AverageRun, WarnsOfWallsThatLeaveCellsOfBallsOutside) {
  // The ball moves from the first voxel to the second, of which nothing is inside
  request.walls = {folder.write("box.stl", stl_box({0, 0, 0}, {1, 1, 1}))};
  expect_named(report(run()),
               {"warning: 88.9 % of the balls' volume was moved out of cells outside of the walls"});
  request.walls = {folder.write("box.stl", stl_box({0, 0, 0}, {2, 1, 1}))};
  EXPECT_EQ(report(run()).find("outside of the walls"), std::string::npos);
}

TEST_F(AverageRun, RefusesWallsInAnotherUnit) {
  request.grid = BoxGrid({0, 0, 0}, {2, 1, 1}, {40, 20, 20});
  request.walls = {folder.write("box.stl", stl_box({0, 0, 0}, {0.02, 0.01, 0.01}))};
  expect_named(message_of<std::invalid_argument>([&] { run(); }), {"lies outside the grid or the walls"});
}

TEST_F(AverageRun, ABrokenDumpLeavesNoSolidsFile) {
  folder.write("dump9000.txt", dump_text(9000, {{1, {0, 0, 0}, {0, 0, 0}, 0.1}}).substr(0, 150));
  expect_named(message_of<DumpError>([&] { run(); }), {"dump9000.txt:10", "truncated"});
  EXPECT_FALSE(std::filesystem::exists(output()));
  EXPECT_FALSE(std::filesystem::exists(output().string() + ".journal")) << "nothing would resume from it";
}

TEST_F(AverageRun, DoesNotOverwriteAFileThatIsNotItsOwnForParaView) {
  folder.write("solids.xdmf", "precious");
  expect_named(message_of<SolidsFileError>([&] { run(); }), {"solids.xdmf", "would be overwritten"});
  std::filesystem::remove(folder / "solids.xdmf");
  run();
  run();
}

TEST_F(AverageRun, RefusesTheNameThatTheFileForParaViewNeeds) {
  request.windows[0].output = folder / "solids.xdmf";
  expect_named(message_of<SolidsFileError>([&] { run(); }), {"solids.xdmf", "solids.h5"});
}

TEST_F(AverageRun, AdvisesOnVoxelsSmallerThanTheBalls) {
  request.grid = BoxGrid({0, 0, 0}, {2, 1, 1}, {50, 25, 25});
  const SolidsSummary summary = run();
  EXPECT_GT(summary.windows[0].largest_solidity, 0.74);
  EXPECT_EQ(summary.windows[0].small_cells, summary.windows[0].occupied_cells);
  expect_named(report(summary),
               {"largest solidity", "100.0 % of the occupied cells are smaller than a ball"});
}

}  // namespace
}  // namespace millfoam::averaging
