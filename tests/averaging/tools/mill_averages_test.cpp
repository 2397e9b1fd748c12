// SPDX-License-Identifier: GPL-3.0-or-later
// What the options of millAverage, and of millDem --average, change in the averages of a mill.
#include "averaging/tools/mill_averages.hpp"

#include <gtest/gtest.h>

#include "averaging/tools/live_options.hpp"
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

  LiveRequest live(const std::string& text) const { return live_request(mill_, text, path(""), 0, 0.2); }

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

TEST_F(MillAverages, WallsOfTheOptionsReplaceTheMills) {
  EXPECT_EQ(taken("--inside " + path("other.stl")).walls, std::vector<std::string>{path("other.stl")});
  EXPECT_EQ(fingerprint, "");
  const AverageRequest request = live("--inside " + path("other.stl")).request;
  EXPECT_EQ(request.walls, std::vector<std::filesystem::path>{path("other.stl")});
  EXPECT_EQ(request.mill_averages, "");
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

}  // namespace
}  // namespace millfoam::averaging
