// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/files/slurry_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "averaging/files/hdf5_file.hpp"
#include "averaging/files/hdf5_io.hpp"
#include "averaging/files/slurry_reader.hpp"
#include "tests/averaging/test_support.hpp"

namespace millfoam::averaging {
namespace {

/// Two voxels of 1 m^3 along x.
const BoxGrid two_voxels({0, 0, 0}, {2, 1, 1}, {2, 1, 1});

/// A sample in which the first voxel is in the mill and has this share of slurry at this speed along x,
/// between balls that leave 0.8 of the space; the second voxel has 0.5 m^3 in the mill and no slurry.
VoxelSums sample_of(double share, double speed) {
  VoxelSums sums(2, slurry_components);
  sums.volume = {1, 0.5};
  const double pressure = 100, head = 40;
  sums.values = {share, 0.8, share * speed, 0, 0, share * pressure, share * head, 0, 0.4, 0, 0, 0, 0, 0};
  return sums;
}

/// A stretch of a flow with that sample.
SlurrySegment stretch(double begin, double end, double share, double speed) {
  SlurrySegment segment(2);
  segment.begin = begin;
  segment.end = end;
  segment.add(sample_of(share, speed), share, end - begin);
  return segment;
}

struct SlurryFile : ::testing::Test {
  TemporaryFolder folder;
  std::filesystem::path whole = folder / "slurry.h5";

  std::filesystem::path write(const std::string& name, const SlurrySegment& segment) const {
    write_segment(folder / name, two_voxels, segment);
    return folder / name;
  }

  /// A data set of the whole file holds these values, C order.
  void expect(const std::string& name, const std::vector<double>& values) const {
    const hdf5::Handle file = hdf5::open_file(whole);
    const std::vector<double> found = hdf5::read_all(file.get(), name);
    ASSERT_EQ(found.size(), values.size()) << name;
    for (std::size_t i = 0; i < values.size(); ++i) {
      EXPECT_NEAR(found[i], values[i], 1e-14 * (1 + std::abs(values[i]))) << name << ", entry " << i;
    }
  }
};

TEST_F(SlurryFile, SegmentIsReadBackAsItWas) {
  const SlurrySegment segment = stretch(0.25, 0.5, 0.3, 2);
  const SlurrySegment read = read_segment(write("a.h5", segment), two_voxels);
  EXPECT_EQ(read.begin, 0.25);
  EXPECT_EQ(read.end, 0.5);
  EXPECT_EQ(read.samples, 1);
  EXPECT_EQ(read.slurry, segment.slurry);
  EXPECT_EQ(read.volume, segment.volume);
  EXPECT_EQ(read.components, segment.components);
}

TEST(ChunksOfRows, AreWholeRowsBelowTheLimitAndEqualPartsAboveIt) {
  using Sizes = std::vector<hsize_t>;
  EXPECT_EQ(hdf5::chunk_of_row({1000, 21}, 8), (Sizes{1000, 21}));
  EXPECT_EQ(hdf5::chunk_of_row({10, 3}, 8, 241), (Sizes{10, 3}));
  EXPECT_EQ(hdf5::chunk_of_row({10, 3}, 8, 240), (Sizes{5, 3}));
  EXPECT_EQ(hdf5::chunk_of_row({10, 3}, 8, 100), (Sizes{4, 3}));
  EXPECT_EQ(hdf5::chunk_of_row({10, 3}, 8, 20), (Sizes{1, 2})) << "a layer of it is too large, too";
  // 21 numbers of a voxel with balls
  EXPECT_EQ(hdf5::chunk_of_row({26000000, 21}, 8), (Sizes{13000000, 21}));
}

TEST_F(SlurryFile, ARowOfMoreThanFourGigabytesHasChunksThatHdf5Takes) {
  const hdf5::Handle file = hdf5::create_file(folder / "large.h5");
  const hsize_t most_voxels = 170000000;
  const hdf5::Handle rows =
      hdf5::create_rows(file.get(), "components", {most_voxels, 21}, H5T_NATIVE_DOUBLE, "SI");
  EXPECT_EQ(hdf5::dimensions(file.get(), "components"), (std::vector<hsize_t>{0, most_voxels, 21}));
}

TEST_F(SlurryFile, WindowsAreMeansWeightedByTimeAndTheirVelocityBySlurry) {
  // Half of the first window has a share of 0.2 at 1 m/s, half 0.6 at 3 m/s
  const SlurryHeader header{1.5, 1.0, 1.0};
  assemble_slurry(whole, two_voxels, header,
                  {write("a.h5", stretch(0, 0.5, 0.2, 1)), write("b.h5", stretch(0.5, 1, 0.6, 3)),
                   write("c.h5", stretch(1, 2, 0.1, 7))});
  expect("slurry", {0.4, 0.0, 0.1, 0.0});
  expect("voidage", {0.8, 0.8, 0.8, 0.8});
  expect("velocity", {2.5, 0., 0., 0., 0., 0., 7., 0., 0., 0., 0., 0.});
  expect("pressure", {100., 0., 100., 0.});
  expect("p_rgh", {40., 0., 40., 0.});
  expect("grid/insideFraction", {1., 0.5, 1., 0.5});
  expect("window/begin", {1.5, 2.5});
  expect("window/samples", {2, 1});
  expect("ledger/volume_in", {0.4, 0.1});
  expect("ledger/outside", {0., 0.});
}

TEST_F(SlurryFile, MeanOverTheRunBeginsWhereItIsAsked) {
  assemble_slurry(whole, two_voxels, {0, 1.0, 1.0},
                  {write("a.h5", stretch(0, 1, 0.2, 1)), write("b.h5", stretch(1, 2, 0.6, 3)),
                   write("c.h5", stretch(2, 3, 0.2, 7))});
  expect("mean/slurry", {0.4, 0.0});
  expect("mean/velocity", {4., 0., 0., 0., 0., 0.});
}

TEST_F(SlurryFile, SaysWhetherThereIsAMeanOverTheRun) {
  const std::vector<std::filesystem::path> segments{write("a.h5", stretch(0, 0.6, 0.2, 1)),
                                                    write("b.h5", stretch(0.6, 1, 0.6, 3))};
  EXPECT_TRUE(assemble_slurry(whole, two_voxels, {0, 1.0, 0.6}, segments));
  expect("mean/slurry", {0.6, 0.0});
  EXPECT_FALSE(assemble_slurry(whole, two_voxels, {0, 1.0, 0.7}, segments));
  EXPECT_FALSE(hdf5::has(hdf5::open_file(whole).get(), "mean"));
}

TEST_F(SlurryFile, BeginsAtTheFlowTimeOfItsFirstSegment) {
  EXPECT_EQ(slurry_begin(whole), std::nullopt);
  assemble_slurry(whole, two_voxels, {1.5, 1.0, 0},
                  {write("a.h5", stretch(0.25, 1, 0.2, 1)), write("b.h5", stretch(1, 2, 0.6, 3))});
  EXPECT_EQ(slurry_begin(whole), 0.25);
  std::filesystem::resize_file(whole, std::filesystem::file_size(whole) / 2);
  ::testing::internal::CaptureStderr();
  EXPECT_EQ(slurry_begin(whole), std::nullopt);
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "") << "HDF5 does not print its own errors";
}

TEST_F(SlurryFile, WindowsThatAreNotFilledAreMarked) {
  assemble_slurry(whole, two_voxels, {0, 1.0, 0},
                  {write("a.h5", stretch(0.25, 1, 0.2, 1)), write("b.h5", stretch(1, 1.5, 0.6, 3))});
  expect("window/starts_late", {1, 0});
  expect("window/ends_short", {0, 1});
}

TEST_F(SlurryFile, AHoleWithinAWindowIsMarkedAndCountsForNothing) {
  assemble_slurry(whole, two_voxels, {0, 1.0, 0},
                  {write("a.h5", stretch(0, 0.25, 0.2, 1)), write("b.h5", stretch(0.5, 1, 0.2, 1))});
  expect("window/starts_late", {0});
  expect("window/ends_short", {1});
  expect("ledger/volume_in", {0.2});
  expect("grid/insideFraction", {1, 0.5});
  const hdf5::Handle file = hdf5::open_file(whole), mean = hdf5::open_group(file.get(), "mean");
  EXPECT_EQ(hdf5::read_double_attribute(mean.get(), "end", 1)[0], 1);
  EXPECT_EQ(hdf5::read_double_attribute(mean.get(), "duration", 1)[0], 0.75);
}

TEST_F(SlurryFile, SegmentsThatOverlapAreRefused) {
  const auto first = write("a.h5", stretch(0, 0.6, 0.2, 1)), second = write("b.h5", stretch(0.5, 1, 0.2, 1));
  EXPECT_NE(message_of<SlurryFileError>([&] {
              assemble_slurry(whole, two_voxels, {0, 1, 0}, {first, second});
            }).find("b.h5: begins at"),
            std::string::npos);
}

TEST_F(SlurryFile, WhatLiesBeyondTheBoxIsTold) {
  SlurrySegment segment = stretch(0, 1, 0.2, 1);
  segment.slurry = 0.25;
  assemble_slurry(whole, two_voxels, {0, 1.0, 0}, {write("a.h5", segment)});
  expect("ledger/deposited", {0.2});
  expect("ledger/outside", {0.05});
}

/// What balls feel in a sample of two voxels: the first has balls of this solidity, the second none.
SlurrySegment stretch_with_balls(double begin, double end, double solidity, double exchange, double speed) {
  VoxelSums sums(2, slurry_components + ball_components);
  sums.volume = {1, 0.5};
  const auto fill = [&](std::size_t voxel, double phi) {
    const double w = phi + few_balls, volume = sums.volume[voxel];
    const std::array<double, ball_components> own{
        w,       phi,          w * 1,     w * 2, w * 3,     w * exchange, w * 4.,
        w * 10., w * exchange, w * speed, 0,     w * speed, w * 1239,     w * 0.005};
    for (std::size_t k = 0; k < ball_components; ++k) {
      sums.values[voxel * sums.components + slurry_components + k] = volume * own[k];
    }
  };
  fill(0, solidity);
  fill(1, 0);
  SlurrySegment segment(2, true);
  segment.begin = begin;
  segment.end = end;
  segment.add(sums, 0, end - begin);
  return segment;
}

TEST_F(SlurryFile, WhatBallsFeelIsWeightedByTheirVolumeAndKnownWithoutThem) {
  // A third of the balls' volume over time has K = 100 and the speed 3, the rest 400 and 6
  SlurryHeader header{1.5, 1.0, 0.0};
  header.balls = BallsHeader{"Hill", true, 1239, 1.2, {0, -9.81, 0}};
  assemble_slurry(whole, two_voxels, header,
                  {write("a.h5", stretch_with_balls(0, 0.5, 0.2 - few_balls, 100, 3)),
                   write("b.h5", stretch_with_balls(0.5, 1, 0.4 - few_balls, 400, 6))});
  for (const std::string group : {"", "mean/"}) {
    expect(group + "balls/solidity", {0.3 - few_balls, 0});
    expect(group + "balls/exchange", {300, 250});
    expect(group + "balls/pressure_force", {1, 2, 3, 1, 2, 3});
    expect(group + "balls/velocity", {5, 0, 5, 4.5, 0, 4.5});
    expect(group + "balls/drag_force", {4 + 300 * 5, 10, 300 + 300 * 5, 4 + 250 * 4.5, 10, 250 + 250 * 4.5});
    expect(group + "balls/fluid_density", {1239, 1239});
    expect(group + "balls/diameter", {0.005, 0.005});
  }
  const hdf5::Handle file = hdf5::open_file(whole), balls = hdf5::open_group(file.get(), "balls");
  EXPECT_EQ(hdf5::read_int_attribute(file.get(), "version", 1)[0], 2);
  EXPECT_EQ(hdf5::read_text_attribute(balls.get(), "law"), "Hill");
  EXPECT_EQ(hdf5::read_int_attribute(balls.get(), "polydispersity", 1)[0], 1);
  EXPECT_EQ(hdf5::read_double_attribute(balls.get(), "slurry_density", 1)[0], 1239);
  EXPECT_EQ(hdf5::read_double_attribute(balls.get(), "gravity", 3), (std::vector<double>{0, -9.81, 0}));
}

TEST_F(SlurryFile, AFlowWithoutBallsHasNoGroupOfThem) {
  assemble_slurry(whole, two_voxels, {0, 1.0, 0}, {write("a.h5", stretch(0, 1, 0.2, 1))});
  const hdf5::Handle file = hdf5::open_file(whole);
  EXPECT_FALSE(hdf5::has(file.get(), "balls"));
  EXPECT_FALSE(hdf5::has(file.get(), "mean/balls"));
}

TEST_F(SlurryFile, SegmentsWithAndWithoutBallsAreNotMixed) {
  const auto with = write("a.h5", stretch_with_balls(0, 1, 0.2, 100, 3));
  const auto without = write("b.h5", stretch(0, 1, 0.2, 1));
  EXPECT_NE(message_of<SlurryFileError>([&] {
              read_segment(with, two_voxels);
            }).find("by a flow with balls, expected one without"),
            std::string::npos);
  EXPECT_NE(message_of<SlurryFileError>([&] {
              read_segment(without, two_voxels, true);
            }).find("by a flow without balls, expected one with"),
            std::string::npos);
}

TEST_F(SlurryFile, ParaViewFindsTheWindows) {
  assemble_slurry(whole, two_voxels, {2, 1.0, 0}, {write("a.h5", stretch(0, 1, 0.2, 1))});
  std::ifstream file(folder / "slurry.xdmf");
  std::stringstream text;
  text << file.rdbuf();
  EXPECT_NE(text.str().find("<Time Value=\"2\"/>"), std::string::npos);
  EXPECT_NE(text.str().find("slurry.h5:/velocity"), std::string::npos);
}

TEST_F(SlurryFile, SegmentsOfOtherGridsAndWindowsAreRefused) {
  const auto segment = write("a.h5", stretch(0, 1, 0.2, 1));
  const BoxGrid other({0, 0, 0}, {2, 1, 1}, {1, 2, 1});
  EXPECT_NE(message_of<SlurryFileError>([&] { read_segment(segment, other); }).find("another grid"),
            std::string::npos);
  EXPECT_NE(message_of<SlurryFileError>([&] {
              assemble_slurry(whole, two_voxels, {0, 0.4, 0}, {segment});
            }).find("lies in two windows"),
            std::string::npos);
  EXPECT_NE(message_of<SlurryFileError>([&] {
              assemble_slurry(whole, two_voxels, {0, 1, 0}, {});
            }).find("nothing was averaged"),
            std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(whole));
}

TEST_F(SlurryFile, AFileThatIsCutShortIsRefusedByName) {
  const auto segment = write("a.h5", stretch(0, 1, 0.2, 1));
  std::filesystem::resize_file(segment, std::filesystem::file_size(segment) / 2);
  EXPECT_NE(message_of<SlurryFileError>([&] { read_segment(segment, two_voxels); }).find("a.h5"),
            std::string::npos);
}

}  // namespace
}  // namespace millfoam::averaging
