// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "meshing/mill/mill_charge.hpp"
#include "meshing/mill/resolved_mill.hpp"
#include "tests/meshing/stirred_mill.hpp"
#include "tests/meshing/test_mill.hpp"

namespace millfoam::meshing {
namespace {

using Json = nlohmann::ordered_json;

TEST(BallShape, HalfAxesAreScaledToTheDiameterOfEqualVolume) {
  const auto mill =
      describe(stirred_mill, {"charge.shape={half_axes: [2.70274, 2.00172, 1.67844], roundness: 0.333333}"});
  const SizeClass& size = mill.mill.charge.classes.front();
  ASSERT_TRUE(size.shape);
  EXPECT_TRUE(mill.mill.charge.has_shapes());
  EXPECT_NEAR(size.shape->blockiness, 6, 1e-5);
  EXPECT_NEAR(size.shape->half_axes[0], 2.70274e-3, 1e-8);
  EXPECT_NEAR(longest_way(size), 2 * 3.191e-3, 1e-6);
  const Json derived = resolved_mill(mill, "test")["derived"]["charge"]["classes"][0];
  EXPECT_EQ(derived["count"], count_charge(describe(stirred_mill).mill).balls);
  EXPECT_NEAR(derived["shape"]["sphericity"], 0.8995, 1e-4);
  EXPECT_NEAR(derived["shape"]["least_radius_of_curvature_m"], 0.582e-3, 1e-6);
}

TEST(BallShape, AGroupIsAClassForEachShape) {
  const std::string group = with(stirred_mill, "{level: 0.0775, share: 0.5, diameter: 0.005}", R"(
  classes:
    - {diameter: 0.005, number: 300, shape: {half_axes: [3, 2, 2], blockiness: 3}}
    - {diameter: 0.005, number: 300, shape: {half_axes: [2, 2, 2], blockiness: 4}}
    - {diameter: 0.005, number: 300})");
  const ChargeNumbers numbers = count_charge(describe(group).mill);
  ASSERT_EQ(numbers.classes.size(), 3U);
  EXPECT_EQ(numbers.classes[0].shape->blockiness, 3);
  EXPECT_EQ(numbers.classes[1].shape->blockiness, 4);
  EXPECT_FALSE(numbers.classes[2].shape);
  EXPECT_EQ(numbers.balls, 900);
  EXPECT_NEAR(numbers.sauter_diameter, 0.005, 1e-12);
}

// mill.json of a mill with shapes has the default of curvature_limit
TEST(BallShape, ShapesOfAResolvedMillMayBecomeSpheres) {
  const std::string shape = "charge.shape={half_axes: [3, 2, 2], blockiness: 3}";
  const TemporaryFolder folder;
  const auto file = folder.write("mill.json", resolved_mill(describe(stirred_mill, {shape}), "test").dump(2));
  const MillDescription spheres = describe_mill(file, {"charge.shape=sphere"});
  EXPECT_FALSE(spheres.mill.charge.has_shapes());
  EXPECT_EQ(resolved_mill(spheres, "test")["mill"]["dem"].count("curvature_limit"), 0U);
  EXPECT_THROW(describe_mill(file, {"charge.shape=sphere", "dem.curvature_limit=5"}), MillError);
}

// The key's default is not recorded, so that mills of before it have their fingerprints
TEST(BallShape, SpheresAreTheMillWithoutTheKey) {
  const auto plain = describe(stirred_mill), spheres = describe(stirred_mill, {"charge.shape=sphere"});
  EXPECT_EQ(plain.mill.fingerprint.charge, spheres.mill.fingerprint.charge);
  EXPECT_EQ(resolved_mill(plain, "test")["mill"], resolved_mill(spheres, "test")["mill"]);
  const std::string shape = "charge.shape={half_axes: [3, 2, 2], blockiness: 3}";
  EXPECT_NE(plain.mill.fingerprint.charge, describe(stirred_mill, {shape}).mill.fingerprint.charge);
  EXPECT_EQ(describe(stirred_mill, {shape}).mill.dem.curvature_limit, 10);
  EXPECT_EQ(resolved_mill(plain, "test")["mill"]["dem"].count("curvature_limit"), 0U);
}

// Fingerprints depend on the order in which keys are read. These are of version 0.2.0+4ab9011f, without
// shapes
TEST(BallShape, MillsOfBeforeTheKeyHaveTheirFingerprints) {
  const auto fill = describe(example_mill, {"charge.classes=~", "charge.fill=0.2", "charge.diameter=0.004"})
                        .mill.fingerprint;
  EXPECT_EQ(fill.charge, "57d867e56dd2efab");
  EXPECT_EQ(fill.flow, "73ef08ad1700976a");
  const std::string stirred = resolved_mill(describe(stirred_mill), "test")["mill"]["charge"].dump();
  EXPECT_NE(stirred.find(R"("diameter":0.005,"level":0.0775,"share":0.5,"fines_below":0.0)"),
            std::string::npos)
      << stirred;
}

TEST(BallShape, APeriodIsTwiceTheLongestWayOfABall) {
  const std::string mill = with(example_mill, "length: 0.024", "length: 0.06");
  const std::string shape = "charge.classes[0].shape={half_axes: [3, 1, 1], blockiness: 2}";
  const double longest = 2 * bounding_radius(*describe(mill, {shape}).mill.charge.classes[0].shape);
  ASSERT_GT(longest, 1.01 * 0.008);
  const auto slice = [](double length) { return "geometry.slice=" + std::to_string(length); };
  const std::string longer = slice(2.01 * longest), shorter = slice(1.99 * longest);
  EXPECT_EQ(describe(mill, {shape, longer}).mill.geometry.ends, Ends::periodic);
  EXPECT_TRUE(says(refusal(mill, {shape, shorter}), "a length in m of at least twice a ball's longest way"));
  EXPECT_EQ(describe(mill, {shorter}).mill.geometry.ends, Ends::periodic);
  const auto period = [](double length) {
    return std::vector<std::string>{"geometry.ends=periodic", "geometry.length=" + std::to_string(length)};
  };
  auto set = period(1.99 * longest);
  EXPECT_EQ(refusal(mill, set), "");
  set.push_back(shape);
  EXPECT_TRUE(says(refusal(mill, set), "is up to half of the periodic mill's length, 0.01"));
  set = period(2.01 * longest);
  set.push_back(shape);
  EXPECT_EQ(refusal(mill, set), "");
}

TEST(BallShape, BallsOfATumblingMillHaveThemToo) {
  const std::string set = "charge.classes[0].shape={half_axes: [1.5, 1, 1], blockiness: 3}";
  const Mill mill = describe(example_mill, {set}).mill;
  EXPECT_TRUE(mill.charge.classes[0].shape);
  EXPECT_EQ(mill.charge.classes[0].diameter, describe(example_mill).mill.charge.classes[0].diameter);
}

TEST(BallShape, ImpossibleShapesAreRefused) {
  const auto with_shape = [](const std::string& shape) {
    return refusal(stirred_mill, {"charge.shape=" + shape});
  };
  EXPECT_TRUE(
      says(with_shape("cube"), "key 'charge.shape' = cube: expected sphere, or a map with half_axes"));
  EXPECT_TRUE(says(with_shape("{half_axes: [3, 2], blockiness: 3}"),
                   "key 'charge.shape.half_axes' = […]: expected a list of 3 numbers, each a length"));
  EXPECT_TRUE(says(with_shape("{half_axes: [3, 2, -2], blockiness: 3}"),
                   "key 'charge.shape.half_axes[2]' = -2: expected a length from 1e-06 to 1e+06"));
  EXPECT_TRUE(says(with_shape("{half_axes: [1e-200, 1e-200, 1e-200], blockiness: 3}"),
                   "key 'charge.shape.half_axes[0]' = 1e-200: expected a length from 1e-06 to 1e+06"));
  EXPECT_TRUE(says(with_shape("{half_axes: [3, 2, 2], blockiness: 1.5}"),
                   "key 'charge.shape.blockiness' = 1.5: expected a blockiness from 2, which is that of an"));
  EXPECT_TRUE(says(with_shape("{half_axes: [3, 2, 2]}"), "key 'charge.shape.blockiness' is missing"));
  EXPECT_TRUE(says(with_shape("{half_axes: [3, 2, 2], roundness: 0.1}"),
                   "key 'charge.shape.roundness' = 0.1: expected a roundness from 0.166667 to 1"));
  EXPECT_TRUE(says(with_shape("{half_axes: [3, 2, 2], roundness: 0.5, blockiness: 4}"),
                   "expected either this key or blockiness, which is 2/roundness"));
  EXPECT_TRUE(says(with_shape("{half_axes: [9, 2, 2], blockiness: 3}"),
                   "is below the gap between the impeller and the shell, 0.0066"));
}

TEST(BallShape, EdgesThatHertzLawDoesNotBearAreRefused) {
  EXPECT_TRUE(says(
      refusal(stirred_mill, {"charge.shape={half_axes: [1, 1, 1], blockiness: 11}", "charge.diameter=0.004"}),
      "expected a shape whose least mean radius of curvature, here 0.000"));
}

TEST(BallShape, WhatReadsContactsOfSpheresIsRefused) {
  const std::string shape = "charge.shape={half_axes: [3, 2, 2], blockiness: 3}";
  EXPECT_TRUE(
      says(refusal(stirred_mill, {shape, "dem.contact_interval=0.01"}), "expected 0 for superquadrics"));
  EXPECT_TRUE(says(refusal(stirred_mill, {"dem.curvature_limit=5"}),
                   "expected this key with a shape in the charge only"));
}

}  // namespace
}  // namespace millfoam::meshing
