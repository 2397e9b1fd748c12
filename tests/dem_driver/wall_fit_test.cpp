// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/wall_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "meshing/surface/pi.hpp"
#include "small_mill.hpp"

namespace millfoam::dem_driver {
namespace {

using tests::message_of;

meshing::Geometry geometry() {
  return tests::small_mill().geometry;  // radius 0.02 m, length 0.012 m
}

/// An open drum of so many flat sides whose corners lie on the circle.
Wall drum(double radius, double length, int sides = 60, double x = 0, double z = 0) {
  Wall wall{"walls/shell.stl", {}};
  for (int i = 0; i < sides; ++i) {
    const auto corner = [&](int side, double at) -> Eigen::Vector3d {
      const double angle = 2 * pi * side / sides;
      return {x + radius * std::cos(angle), radius * std::sin(angle), z + at};
    };
    const int first = static_cast<int>(wall.surface.points.size());
    for (const auto& point : {corner(i, 0), corner(i + 1, 0), corner(i, length), corner(i + 1, length)})
      wall.surface.points.push_back(point);
    wall.surface.polygons.push_back({{first, first + 1, first + 3}});
    wall.surface.polygons.push_back({{first, first + 3, first + 2}});
  }
  return wall;
}

std::string complaint(const std::vector<Wall>& walls) {
  return message_of([&] { require_fit(walls, geometry()); });
}

TEST(WallFit, WallsOfThisMillAreTakenHoweverFewSidesTheyHave) {
  for (const int sides : {3, 4, 5, 7, 60}) EXPECT_EQ(complaint({drum(0.02, 0.012, sides)}), "") << sides;
  EXPECT_EQ(complaint({drum(0.0203, 0.0121)}), "");
}

TEST(WallFit, AnotherRadiusIsToldWithTheBoxAndWhatWasExpected) {
  EXPECT_EQ(
      complaint({drum(0.025, 0.012)}),
      "walls/shell.stl: the walls have a radius of 0.025 m (all walls: x from -0.025 to 0.025, y from "
      "-0.025 to 0.025, z from 0 to 0.012 m), expected the walls of mill.yaml: radius 0.02 m, z from 0 to "
      "0.012 m, coordinates in m, axis x = y = 0");
  EXPECT_NE(complaint({drum(0.019, 0.012)}).find("a radius of 0.019 m"), std::string::npos);
  EXPECT_NE(complaint({drum(20, 12)}).find("a radius of 20 m"), std::string::npos);
}

TEST(WallFit, AnAxisBesideTheMillsIsTold) {
  EXPECT_NE(complaint({drum(0.02, 0.012, 60, 0.001)}).find("the walls' axis is x = 0.001, y = 0 m"),
            std::string::npos);
  EXPECT_NE(complaint({drum(0.0197, 0.012, 61, -0.0007)}).find("the walls' axis is x = -0.0007, y = 0 m"),
            std::string::npos);
}

TEST(WallFit, AnotherLengthAndAnotherPlaceAlongTheAxisAreTold) {
  EXPECT_NE(complaint({drum(0.02, 0.01)}).find("the walls reach from z = 0 to 0.01 m"), std::string::npos);
  EXPECT_NE(complaint({drum(0.02, 0.012, 60, 0, -0.006)}).find("the walls reach from z = -0.006 to 0.006 m"),
            std::string::npos);
}

TEST(WallFit, TheWallThatReachesTooFarIsNamed) {
  Wall end = drum(0.01, 0.001, 60, 0, 0.013);
  end.file = "walls/dischargeEnd.stl";
  EXPECT_EQ(complaint({drum(0.02, 0.012), end}).find("walls/dischargeEnd.stl: "), 0u);
}

}  // namespace
}  // namespace millfoam::dem_driver
