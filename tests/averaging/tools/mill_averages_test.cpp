// SPDX-License-Identifier: GPL-3.0-or-later
// What the options of millAverage, and of millDem --average, change in the averages of a mill.
#include "averaging/tools/mill_averages.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "averaging/dumps/dump_series.hpp"
#include "averaging/run/cell_setup.hpp"
#include "averaging/statistics/time_windows.hpp"
#include "averaging/tools/live_options.hpp"
#include "meshing/files/file_fingerprint.hpp"
#include "tests/averaging/test_support.hpp"

namespace millfoam::averaging {
namespace {

constexpr char mill_text[] = R"(
geometry: {diameter: 0.06, length: 0.03, ends: periodic, lifters: {count: 6, height: 0.005, width: 0.005}}
speed: {fraction_of_critical: 0.7, sense: clockwise}
charge: {classes: [{diameter: 0.004, mass: 0.015}], start_radius: 0.02}
materials: {ball: glass, wall: HDPE}
dem: {youngs_modulus: 1e7, settle_time: 0.1, duration: 0.2, record_interval: 0.005, seed: 3}
slurry: {density: 1239, plastic_viscosity: 0.0014, yield_stress: 0.16}
averages: {voxel_size: 0.006, window: 0.03, start: 0.05, method: sample, template: 9}
resolution: {cell_size: 0.003, layers: 4}
)";

constexpr char run_text[] = R"({"timestep_s": 1e-5, "begin_s": 0, "duration_s": 0.2, "dumps": 41})";

/// A case of that mill with its dry run.
class MillAverages : public ::testing::Test {
 protected:
  MillAverages() {
    for (const char* name : {"dumps", "walls"}) std::filesystem::create_directory(folder_ / name);
    folder_.write("dumps/run.json", run_text);
    folder_.write("walls/shell.stl", "");
    folder_.write("other.stl", "");
  }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  /// The options that millAverage makes of those on its command line; `fingerprint` is what it notes.
  Options taken(const std::string& text) {
    Options options;
    CLI::App app;
    declare(app, options);
    if (!text.empty()) app.parse(text);
    options.case_folder = path("");
    fingerprint = take_from_mill(mill_, options);
    return options;
  }

  LiveRequest live(const std::string& text) const {
    return live_request(mill_, text, path(""), 0, 0.2, 1e-5);
  }

  /// Both programs must refuse it.
  void expect_refused(const std::string& text, const std::string& sentence) {
    for (const std::string& message : {message_of<std::invalid_argument>([&] { taken(text); }),
                                       message_of<std::invalid_argument>([&] { live(text); })})
      expect_named(message, {sentence + ", but the cells are those of the mill; expected --box",
                             "--set averages.KEY=VALUE"});
  }

  TemporaryFolder folder_;
  meshing::MillDescription mill_ = meshing::describe_mill(folder_.write("mill.yaml", mill_text));
  const std::string averages_ = mill_.mill.fingerprint.averages;
  std::string fingerprint;
};

TEST_F(MillAverages, WithoutOptionsTheyAreThoseOfTheMill) {
  const Options options = taken("");
  EXPECT_EQ(options.shape, (std::vector<int>{10, 10, 5}));
  EXPECT_EQ(options.method, "sample");
  EXPECT_EQ(options.template_points, 9);
  EXPECT_EQ(options.periodic, std::vector<std::string>{"z"});
  EXPECT_EQ(fingerprint, averages_);
  EXPECT_NE(fingerprint, "");
  EXPECT_EQ(live("").request.mill_averages, averages_);
}

TEST_F(MillAverages, AMethodOfTheOptionsReplacesTheMills) {
  const Options exact = taken("--method exact");
  EXPECT_EQ(exact.method, "exact");
  EXPECT_EQ(exact.template_points, 9);
  EXPECT_EQ(fingerprint, "") << "others than the mill's";
  const Options finer = taken("--template 20");
  EXPECT_EQ(finer.method, "sample");
  EXPECT_EQ(finer.template_points, 20);
  EXPECT_EQ(fingerprint, "");

  const AverageRequest request = live("--method exact --template 20").request;
  EXPECT_EQ(request.method, DepositionMethod::exact);
  EXPECT_EQ(request.template_points, 20);
  EXPECT_EQ(request.mill_averages, "");
}

TEST_F(MillAverages, LiveOnesOfSuperquadricsNameTheirMethod) {
  const auto method = [&](const meshing::MillDescription& mill, const std::string& text) {
    const AverageRequest request =
        live_request(mill, text + " --box 0 0 0 1 1 1 --shape 2 2 2", path(""), 0, 0.2, 1e-5).request;
    return set_up(request, {1e-5, std::nullopt, 0.004}, [](const std::string&) {}).method;
  };
  EXPECT_EQ(method(mill_, ""), "exact; superquadrics: 12 points along a diameter");
  const meshing::MillDescription shaped = meshing::describe_mill(
      folder_ / "mill.yaml", {"charge.classes[0].shape={half_axes: [3, 2, 2], blockiness: 3}"});
  EXPECT_EQ(method(shaped, ""), "exact; superquadrics as spheres of equal volume");
  EXPECT_EQ(method(shaped, "--method sample"),
            "sample, 12 points along a diameter; superquadrics as spheres of equal volume");
}

TEST_F(MillAverages, WallsOfTheOptionsReplaceTheMills) {
  EXPECT_EQ(taken("--inside " + path("other.stl")).walls, std::vector<std::string>{path("other.stl")});
  EXPECT_EQ(fingerprint, "");
  const AverageRequest request = live("--inside " + path("other.stl")).request;
  EXPECT_EQ(request.walls, std::vector<std::filesystem::path>{path("other.stl")});
  EXPECT_EQ(request.mill_averages, "");
}

TEST_F(MillAverages, DumpsOfAMillWithOtherWallsAreRefused) {
  const auto run_of = [&](const std::string& walls) {
    folder_.write("dumps/run.json",
                  R"({"timestep_s": 1e-5, "duration_s": 0.2, "mill": {"walls": ")" + walls + R"("}})");
  };
  run_of("0123456789abcdef");
  expect_named(message_of<std::invalid_argument>([&] { taken(""); }),
               {"dumps/run.json: the dumps are of another mill (walls 0123456789abcdef, this mill's are " +
                mill_.mill.fingerprint.walls + "): run millDem again"});
  run_of(mill_.mill.fingerprint.walls);
  taken("");
}

TEST_F(MillAverages, WallsOfAnotherMillAreRefusedUnlessTheyAreFromCadOrNotUsed) {
  const auto walls_of = [&](const std::string& walls, const std::string& source) {
    folder_.write("walls/walls.json",
                  R"({"mill": {"walls": ")" + walls + R"("}, "source": ")" + source + R"("})");
  };
  walls_of("0123456789abcdef", "mill");
  expect_named(message_of<std::runtime_error>([&] { taken(""); }),
               {"walls/walls.json: the walls are of another mill (walls 0123456789abcdef, this mill's are " +
                mill_.mill.fingerprint.walls + "): run millMesh again"});
  taken("--inside " + path("other.stl"));
  taken("--box 0 0 0 1 1 1 --shape 2 2 2");
  walls_of(mill_.mill.fingerprint.walls, "mill");
  taken("");
  walls_of("0123456789abcdef", "cad");
  taken("");
  folder_.write("walls/walls.json", "{");
  expect_named(message_of<std::runtime_error>([&] { taken(""); }), {"walls.json", "run millMesh again"});
}

TEST_F(MillAverages, WallsThatAreNotThoseOfTheDryRunAreRefusedUnlessTheyAreNotUsed) {
  const auto shell = folder_.write("walls/shell.stl", "a shell");
  // Walls from CAD have no fingerprint of a mill
  folder_.write("walls/walls.json", R"({"mill": {}, "source": "cad"})");
  taken("");
  folder_.write("dumps/run.json", R"({"timestep_s": 1e-5, "duration_s": 0.2, "wall_files": {"shell": ")" +
                                      file_fingerprint(shell) + R"("}})");
  taken("");
  folder_.write("walls/shell.stl", "another shell");
  expect_named(message_of<std::runtime_error>([&] { taken(""); }),
               {"walls/shell.stl: the wall is another one", "dumps/run.json", "run millDem again"});
  taken("--inside " + path("other.stl"));
  taken("--box 0 0 0 1 1 1 --shape 2 2 2");
  folder_.write("walls/shell.stl", "a shell");
  const auto lifters = folder_.write("walls/lifters.stl", "lifters");
  expect_named(message_of<std::runtime_error>([&] { taken(""); }),
               {"walls/lifters.stl: is not a wall of the dry run"});
  std::filesystem::remove(lifters);
  std::filesystem::remove(shell);
  expect_named(message_of<std::runtime_error>([&] { taken(""); }), {"walls/shell.stl: no such file"});
  folder_.write("dumps/run.json", R"({"timestep_s": 1e-5, "duration_s": 0.2, "wall_files": 3})");
  expect_named(message_of<DumpError>([&] { taken(""); }), {"run.json: key 'wall_files' is 3"});
}

TEST_F(MillAverages, MoreVoxelsThanAMillMayHaveAreRefused) {
  expect_named(message_of<std::invalid_argument>(
                   [&] { live("--box 0 0 0 1 1 1 --shape 2000000000 2000000000 2 --window 0.1 -o a.h5"); }),
               {"--shape gives 8e+18 voxels", "at most 1.7e+08"});
}

TEST_F(MillAverages, APeriodThatIsNoLengthIsRefusedByItsOption) {
  for (const auto& [period, shown] :
       {std::pair{"0", "0"}, {"-0.024", "-0.024"}, {"nan", "nan"}, {"inf", "inf"}})
    expect_named(message_of<std::invalid_argument>(
                     [&] { live(std::string("--mesh a.h5 --window 0.1 -o b.h5 --period=") + period); }),
                 {std::string("--period is ") + shown + ", expected a length above 0 in m"});
}

TEST_F(MillAverages, TheStartOfARunThatIsNotSteadyHasAWarning) {
  const auto results = folder_.write("results.json", R"({"steady_from_s": 0.1, "steady": true})");
  EXPECT_EQ(steady_start(results).time, 0.1);
  EXPECT_EQ(steady_start(results).warning, "");
  folder_.write("results.json", R"({"steady_from_s": 0.2, "steady": false})");
  EXPECT_EQ(steady_start(results).warning,
            path("results.json") +
                ": the dry run is not steady; its last part is averaged, from 0.2 s on. Raise dem.duration");
  for (const auto& [text, words] :
       {std::pair{"{}", ": no number steady_from_s"}, {"{\n", ":2: this is not JSON"}}) {
    folder_.write("results.json", text);
    expect_named(message_of<std::exception>([&] { steady_start(results); }),
                 {path("results.json") + words, "averages.start a time"});
  }
}

TEST_F(MillAverages, OptionsOfAGridAreRefusedWithoutOne) {
  expect_refused("--shape 4 5 6", "--shape is 4 5 6");
  expect_refused("--frame turning", "--frame is turning");
  expect_refused("--frame lab", "--frame is lab");
  expect_refused("--components cylindrical", "--components is cylindrical");
  expect_refused("--periodic x z", "--periodic is x z");
}

TEST_F(MillAverages, WithAGridOfTheirOwnTheOptionsDecideAlone) {
  const Options options = taken("--cylinder 0 0.03 0 0.03 --shape 4 5 6 --periodic z --frame turning");
  EXPECT_EQ(options.shape, (std::vector<int>{4, 5, 6}));
  EXPECT_EQ(options.frame, "turning");
  EXPECT_TRUE(options.walls.empty());
  EXPECT_EQ(fingerprint, "");
  const AverageRequest request = as_request(options);
  EXPECT_EQ(request.method, DepositionMethod::exact);
  EXPECT_EQ(request.template_points, 12);
}

TEST_F(MillAverages, TheirWindowsEndWithTheLastWholeOne) {
  EXPECT_DOUBLE_EQ(*taken("").end, 0.2);
  EXPECT_EQ(live("").end, taken("").end);
  // Windows of 1667 steps of 1.8e-5 s are longer than 0.03 s: the fifth would end after the run
  folder_.write("dumps/run.json", R"({"timestep_s": 1.8e-5, "duration_s": 0.2})");
  EXPECT_DOUBLE_EQ(*taken("").end, 1.8e-5 * (2778 + 4 * 1667));
  EXPECT_EQ(live_request(mill_, "", path(""), 0, 0.2, 1.8e-5).end, taken("").end);
  folder_.write("dumps/run.json", R"({"duration_s": 0.2})");
  expect_named(message_of<DumpError>([&] { taken(""); }), {"run.json", "timestep_s"});
}

TEST_F(MillAverages, WhatTheOptionsLeaveOpenOfWindowStartAndEndIsThatOfTheMill) {
  const auto expect = [&](const std::string& text, const std::vector<std::string>& windows, double start,
                          std::optional<double> end) {
    const Options options = taken(text);
    EXPECT_EQ(options.windows, windows) << text;
    ASSERT_TRUE(options.start) << text;
    EXPECT_DOUBLE_EQ(*options.start, start) << text;
    ASSERT_EQ(options.end.has_value(), end.has_value()) << text;
    EXPECT_DOUBLE_EQ(options.end.value_or(0), end.value_or(0)) << text;
    EXPECT_EQ(fingerprint, "") << text;
  };
  expect("--window 0.04", {"0.04"}, 0.05, 0.17);
  expect("--start 0.1", {"0.03"}, 0.1, 0.19);
  expect("--end 0.12", {"0.03"}, 0.05, 0.12);
  expect("--window 0.04 --start 0.02", {"0.04"}, 0.02, 0.18);
  expect("--window whole", {"whole"}, 0.05, std::nullopt);
  expect("--window 0.02 0.03", {"0.02", "0.03"}, 0.05, std::nullopt);
  expect("--window 0.5", {"0.5"}, 0.05, std::nullopt);
  // A run that continues another one
  folder_.write("dumps/run.json", R"({"timestep_s": 1e-5, "begin_s": 0.5, "duration_s": 0.2})");
  expect("--window 0.04", {"0.04"}, 0.55, 0.67);
  // Dumps in another folder have no run whose begin is known
  EXPECT_FALSE(taken("--dumps x --window 0.04").start);
}

TEST_F(MillAverages, OfARunTheLengthOfWindowsThatTheOptionsLeaveOpenIsThatOfTheMill) {
  const auto expect = [&](const std::string& text, double length, std::optional<double> start,
                          std::optional<double> end) {
    const LiveRequest found = live(text);
    ASSERT_EQ(found.request.windows.size(), 1u) << text;
    ASSERT_TRUE(found.request.windows[0].length) << text;
    EXPECT_DOUBLE_EQ(*found.request.windows[0].length, length) << text;
    EXPECT_EQ(found.request.start, start) << text;
    EXPECT_EQ(found.request.end, end) << text;
    EXPECT_EQ(found.end, std::nullopt) << text;
    EXPECT_EQ(found.request.mill_averages, "") << text;
  };
  expect("--start 0.1 -o late.h5", 0.03, 0.1, std::nullopt);
  expect("--end 0.12", 0.03, std::nullopt, 0.12);
  expect("--window 0.04", 0.04, std::nullopt, std::nullopt);
  meshing::MillDescription whole = mill_;
  whole.mill.averages.whole_run = true;
  EXPECT_EQ(live_request(whole, "--start 0.1", path(""), 0, 0.2, 1e-5).request.windows[0].length,
            std::nullopt);
}

TEST_F(MillAverages, EveryErrorOfALiveTextNamesItOnce) {
  for (const auto& [text, words] :
       {std::pair{"--dumps x", "not expected"},
        {"--box 0 0 0 1 1 1", "--shape is missing"},
        {"--shape 4 5 6", "but the cells are those of the mill"},
        {"--window soon", "--window is 'soon'"},
        {"--cap 2", "--cap is 2"},
        {"--tolerance 3", "--tolerance is 3"},
        {"--inside none.stl", "'none.stl' matches no file"},
        {"--cylinder 0 0.03 0 0.02 --shape 5 12 2 --periodic z", "--periodic z: the cells repeat"}}) {
    const std::string options = text;
    const std::string message = message_of<std::invalid_argument>([&] { live(options); });
    EXPECT_EQ(message.rfind("--average"), 0u) << message;
    expect_named(message, {"--average '" + options + "': ", words});
  }
  // The mill's own averages have no options
  const auto fail = [] { throw std::invalid_argument("why"); };
  EXPECT_EQ(message_of<std::invalid_argument>([&] { naming_options("", fail); }), "why");
  EXPECT_EQ(message_of<WindowError>([] { naming_options("-o x", [] { throw WindowError("why"); }); }),
            "--average '-o x': why");
  EXPECT_EQ(
      message_of<std::runtime_error>([] { naming_options("-o x", [] { throw std::out_of_range("why"); }); }),
      "--average '-o x': why");
}

TEST_F(MillAverages, LiveCellsThatRepeatAsTheBallsDoNotAreRefused) {
  const auto rings = [](const std::string& end) {
    return "--cylinder 0 0.03 0 " + end + " --shape 5 12 2 --periodic z --window 0.05";
  };
  EXPECT_NO_THROW(live(rings("0.03")));
  EXPECT_NO_THROW(live(""));
  expect_named(message_of<std::invalid_argument>([&] { live(rings("0.025")); }),
               {"--periodic z: the cells repeat after 0.025 m along z, but the balls of the dry run after "
                "0.03 m (from 0 to 0.03 m); expected the same length"});
  expect_named(message_of<std::invalid_argument>(
                   [&] { live("--box 0 0 0 1 1 0.03 --shape 2 2 2 --periodic x z --window 0.05"); }),
               {"--periodic x: the cells repeat after 1 m along x, but the balls of the dry run do not"});
  expect_named(message_of<std::invalid_argument>([&] { live("--mesh a.h5 --period 0.02 --window 0.05"); }),
               {"--period: the cells repeat after 0.02 m along z"});
  meshing::MillDescription plain = mill_;
  plain.mill.geometry.ends = meshing::Ends::plain;
  expect_named(
      message_of<std::invalid_argument>([&] { live_request(plain, rings("0.03"), path(""), 0, 0.2, 1e-5); }),
      {"the balls of the dry run do not: the flags of their box along z are ff; expected pp"});
}

TEST_F(MillAverages, WithTheirWindowsAllDumpsOfTheRunAreExpected) {
  const Options options = taken("");
  EXPECT_EQ(options.dumps, path("dumps/dump.*.txt{,.gz}"));
  EXPECT_TRUE(as_request(options).whole_run_dumped);
  EXPECT_FALSE(taken("--window 0.03 --start 0.05").whole_run_dumped);
  EXPECT_FALSE(live("").request.whole_run_dumped);
}

TEST_F(MillAverages, TheFoldersNameMayHaveCharactersOfPatterns) {
  const auto folder = folder_ / "case {a,b} [1] ~*";
  std::filesystem::create_directories(folder / "walls");
  std::filesystem::create_directories(folder / "dumps");
  for (const char* name : {"dump.0.txt", "dump.500.txt"})
    std::ofstream(folder / "dumps" / name) << dump_text(std::atoi(name + 5), {});
  std::ofstream(folder / "dumps" / "run.json") << run_text;
  std::ofstream(folder / "walls" / "shell.stl") << "";
  Options options;
  options.case_folder = folder.string();
  take_from_mill(mill_, options);
  EXPECT_EQ(find_dumps(options.dumps).size(), 2U);
  EXPECT_EQ(as_request(options).walls, std::vector<std::filesystem::path>{folder / "walls" / "shell.stl"});
}

TEST_F(MillAverages, DumpsOfAPatternWithoutQuotesAreToldShortly) {
  for (const char* name : {"dump.1", "dump.2", "dump.3", "dump.4"}) folder_.write(name, "");
  Options options;
  CLI::App app;
  declare(app, options);
  const std::string mill = path("mill.yaml"), one = path("dump.1"), two = path("dump.2"),
                    three = path("dump.3");
  const std::string four = path("dump.4");
  std::vector<const char*> words{"millAverage", mill.c_str(),  "--dumps",   one.c_str(),
                                 two.c_str(),   three.c_str(), four.c_str()};
  const auto parse_all = [&] { parse(app, options, static_cast<int>(words.size()), words.data()); };
  const std::string message = message_of<std::invalid_argument>(parse_all);
  expect_named(message,
               {"--dumps " + one + ": 3 more files follow (" + two + ", …)", "put the pattern in quotes"});
  EXPECT_EQ(message.find(four), std::string::npos);
  words = {"millAverage", mill.c_str(), "--dumps", one.c_str(), "nothing"};
  EXPECT_THROW(parse_all(), CLI::ExtrasError);
}

/// Windows of 0.01 s over 3 s, and their end, of records at every 20th time-step.
std::pair<WindowPlan, double> windows_of(double timestep) {
  const double start = 0.5, end = 3.5;
  const double last = last_whole_window(start, end, end, 0.01, timestep);
  std::vector<long long> steps;
  for (long long step = 0; static_cast<double>(step) * timestep <= end; step += 20) steps.push_back(step);
  return {plan_windows(steps, {timestep, 20, 0.01, start, last}), last};
}

TEST(LastWholeWindow, WindowsThatAreNoWholeNumberOfStepsAreAllWhole) {
  // 0.01 s are 333.33 and 333.66 steps, counted as 333 and 334
  for (const double timestep : {3e-5, 0.01 / 333.66}) {
    const auto [plan, last] = windows_of(timestep);
    const long long length = whole_steps(0.01, timestep, "");
    const long long from = whole_steps(0.5, timestep, ""), to = whole_steps(3.5, timestep, "");
    EXPECT_EQ(plan.windows.size(), static_cast<std::size_t>((to - from) / length));
    EXPECT_EQ(plan.windows.back().end, whole_steps(last, timestep, ""));
    for (const WindowSpan& span : plan.windows) {
      EXPECT_EQ(span.end - span.begin, length);
      EXPECT_GE(span.records, static_cast<std::size_t>(length / 20));
      EXPECT_FALSE(span.ends_short);
    }
  }
}

TEST(LastWholeWindow, OfWholeMultiplesAreThoseThatFit) {
  const auto [plan, last] = windows_of(1e-5);
  EXPECT_EQ(plan.windows.size(), 300u);
  EXPECT_DOUBLE_EQ(last, 3.5);
  EXPECT_DOUBLE_EQ(last_whole_window(0.5, 3.509, 3.5, 0.01, 1e-5), 3.5);
  expect_named(message_of<std::invalid_argument>([] { last_whole_window(0.5, 0.505, 3.5, 0.01, 1e-5); }),
               {"averages.window: 0.01 s", "only 0.005", "raise dem.duration"});
}

}  // namespace
}  // namespace millfoam::averaging
