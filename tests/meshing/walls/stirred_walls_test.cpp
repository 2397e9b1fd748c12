// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/walls/stirred_walls.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "meshing/mill/mill_shape.hpp"
#include "meshing/surface/pi.hpp"
#include "meshing/walls/surface_check.hpp"
#include "tests/meshing/stirred_mill.hpp"
#include "tests/meshing/test_mill.hpp"

namespace millfoam::meshing {
namespace {

using Eigen::Vector3d;

Geometry geometry_of(const std::vector<std::string>& set = {}) {
  return describe(stirred_mill, set).mill.geometry;
}

/// Sums over the triangles of a part: area, and area times the normal's component away from the axis.
struct PartSums {
  double area = 0;
  double outwards = 0;
  Vector3d normal = Vector3d::Zero();
};

PartSums sums_of(const WallSurface& walls, std::size_t number) {
  PartSums sums;
  for (const auto& [a, b, c] : walls.parts[number].triangles) {
    const auto at = [&](int p) { return walls.points[static_cast<std::size_t>(p)]; };
    const Vector3d normal = (at(b) - at(a)).cross(at(c) - at(a)) / 2;
    const Vector3d middle = (at(a) + at(b) + at(c)) / 3;
    sums.area += normal.norm();
    sums.normal += normal;
    sums.outwards += normal.dot(Vector3d(middle.x(), middle.y(), 0).normalized());
  }
  return sums;
}

TEST(StirredWalls, close_the_space_of_the_balls) {
  // Helices of pins, whose shaft no straight line passes without meeting one; one arm; thick pins; a bare
  // shaft
  const std::vector<std::vector<std::string>> mills = {
      {},
      {"geometry.impeller.pins=[{height: 0.03, length: 0.14, thickness: 0.012, arms: 3}, "
       "{height: 0.05, length: 0.14, thickness: 0.012, angle: 30, arms: 3}, "
       "{height: 0.07, length: 0.13, thickness: 0.012, angle: 75, arms: 3}]"},
      {"geometry.impeller.pins[0].arms=1", "geometry.impeller.pins[1].thickness=0.024"},
      {"geometry.impeller.pins=~"},
      {disc_impeller},
      {disc_impeller, "geometry.impeller.pins=~"},
      // Many thin discs, hardly apart, and pins just above the highest
      {"geometry.impeller.discs=[{height: 0.0454, diameter: 0.120, thickness: 0.001}, "
       "{height: 0.0485, diameter: 0.030, thickness: 0.004}, "
       "{height: 0.0569, diameter: 0.141, thickness: 0.0106}, "
       "{height: 0.0509, diameter: 0.0252, thickness: 0.0002}]"},
      {"geometry.diameter=0.256", "geometry.height=0.5"}};
  for (const auto& set : mills) {
    const Geometry geometry = geometry_of(set);
    const WallSurface walls = make_stirred_walls(geometry);
    const double volume = require_watertight(walls);
    EXPECT_NO_THROW(require_stirred_volume(volume, analytic_volume(geometry)));
    EXPECT_NO_THROW(require_no_needles(walls));
    EXPECT_GT(find_needles(walls).smallest_ratio, 0.02);
  }
}

TEST(StirredWalls, parts_lie_where_their_names_say) {
  const WallSurface walls = make_stirred_walls(geometry_of());
  ASSERT_EQ(walls.parts.size(), 4);
  EXPECT_EQ(walls.parts[0].name, "impeller");
  const PartSums shell = sums_of(walls, 1), base = sums_of(walls, 2), lid = sums_of(walls, 3);
  EXPECT_NEAR(shell.outwards / (2 * pi * 0.0775 * 0.315), 1, 2e-3);
  EXPECT_NEAR(-base.normal.z() / (pi * 0.0775 * 0.0775), 1, 2e-3);
  EXPECT_NEAR(lid.normal.z() / (pi * (0.0775 * 0.0775 - 0.0125 * 0.0125)), 1, 2e-3);
  // Into the shaft: towards the axis on its side, and open only at the lid
  const PartSums impeller = sums_of(walls, 0);
  EXPECT_LT(impeller.outwards, 0);
  // The shaft has 32 sides, whose polygon is 0.64 % smaller than the circle
  EXPECT_NEAR(impeller.normal.z() / (pi * 0.0125 * 0.0125), 1, 7e-3);
  EXPECT_NEAR(impeller.normal.head<2>().norm(), 0, 1e-12);
}

TEST(StirredWalls, first_arm_is_at_its_angle) {
  const WallSurface walls = make_stirred_walls(
      geometry_of({"geometry.impeller.pins[0].arms=1", "geometry.impeller.pins[0].angle=30"}));
  Vector3d tip = Vector3d::Zero();
  for (const auto& triangle : walls.parts[0].triangles)
    for (const int p : triangle) {
      const Vector3d& point = walls.points[static_cast<std::size_t>(p)];
      if (std::abs(point.z() - 0.0304) < 1e-9 && point.head<2>().norm() > tip.head<2>().norm()) tip = point;
    }
  EXPECT_NEAR(std::atan2(tip.y(), tip.x()) * 180 / pi, 30, 1e-9);
  EXPECT_NEAR(tip.head<2>().norm(), 0.0705, 1e-12);
}

TEST(StirredWalls, a_disc_is_a_ring_on_the_shaft) {
  const WallSurface walls = make_stirred_walls(geometry_of({disc_impeller, "geometry.impeller.pins=~"}));
  // Areas of the triangles at a height: up and down, with their normals out of the balls' space
  const auto face = [&](double height) {
    double up = 0;
    for (const auto& [a, b, c] : walls.parts[0].triangles) {
      const auto at = [&](int p) { return walls.points[static_cast<std::size_t>(p)]; };
      if (std::abs(at(a).z() - height) + std::abs(at(b).z() - height) + std::abs(at(c).z() - height) > 1e-9)
        continue;
      up += (at(b) - at(a)).cross(at(c) - at(a)).z() / 2;
    }
    return up;
  };
  const double shaft = pi * 0.0125 * 0.0125;
  EXPECT_NEAR(face(0.020) / (pi * 0.071 * 0.071), 1, 3e-3);
  EXPECT_NEAR(-face(0.026) / (pi * 0.071 * 0.071 - shaft), 1, 3e-3);
  EXPECT_NEAR(face(0.041) / (pi * 0.060 * 0.060 - shaft), 1, 3e-3);
  EXPECT_NEAR(-face(0.049) / (pi * 0.060 * 0.060 - shaft), 1, 3e-3);
}

TEST(StirredWalls, another_volume_is_refused) {
  EXPECT_NO_THROW(require_stirred_volume(1.004, 1));
  EXPECT_THROW(require_stirred_volume(1.006, 1), std::runtime_error);
}

}  // namespace
}  // namespace millfoam::meshing
