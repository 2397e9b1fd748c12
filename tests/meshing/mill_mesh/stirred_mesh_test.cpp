// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/mill_mesh/stirred_mesh.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "meshing/mill/mill_shape.hpp"
#include "meshing/surface/pi.hpp"

namespace {

using namespace millfoam::meshing;
using millfoam::pi;

/// The laboratory mill of cases/mills/stirred_A.
Geometry laboratory_mill() {
  Geometry geometry;
  geometry.diameter = 0.155;
  geometry.length = 0.315;
  Impeller impeller;
  impeller.shaft_diameter = 0.025;
  impeller.shaft_end = 0.020;
  impeller.pins = {{0.0304, 0.141, 0.015, 0, 2}, {0.0700, 0.141, 0.015, 90, 2}};
  geometry.impeller = impeller;
  return geometry;
}

Geometry mill_of(double diameter, double pins) {
  Geometry geometry = laboratory_mill();
  geometry.diameter = diameter;
  for (PinLevel& level : geometry.impeller->pins) level.length = pins;
  return geometry;
}

void expect_good(const Geometry& geometry, double cell_size) {
  EXPECT_NO_THROW(require_quality(quality(make_stirred_mesh(geometry, cell_size)), analytic_volume(geometry),
                                  geometry.length, stirred_limits));
}

/// Area of a patch and the points of its faces.
struct PatchMeasure {
  double area = 0;
  std::set<int> points;
};

PatchMeasure measure_patch(const VolumeMesh& mesh, const std::string& name) {
  const MeshMeasures measures = measure(mesh);
  PatchMeasure found;
  for (const Patch& patch : mesh.patches) {
    if (patch.name != name) continue;
    for (int face = patch.start; face < patch.start + patch.size; ++face) {
      found.area += measures.face_area[static_cast<std::size_t>(face)].norm();
      for (const int point : mesh.faces[static_cast<std::size_t>(face)]) found.points.insert(point);
    }
  }
  return found;
}

/// Slack of a surface's edges, m.
constexpr double slack = 1e-6;

/// Whether a point lies on the side or the flat tip of an arm.
bool is_on_arm(const Geometry& geometry, const PinLevel& level, int arm, const Eigen::Vector3d& at) {
  const double angle = level.angle * pi / 180 + 2 * pi * arm / level.arms;
  const double along = std::cos(angle) * at.x() + std::sin(angle) * at.y();
  const double across = -std::sin(angle) * at.x() + std::cos(angle) * at.y();
  const double away = std::hypot(across, at.z() - level.height), reach = level.length / 2;
  const bool is_outside = at.head<2>().norm() >= geometry.impeller->shaft_diameter / 2 - slack;
  const bool is_on_side = std::abs(away - level.thickness / 2) < slack && along > 0 && along < reach + slack;
  const bool is_on_tip = std::abs(along - reach) < slack && away < level.thickness / 2 + slack;
  return is_outside && (is_on_side || is_on_tip);
}

/// Whether a point lies on an impeller's surface.
bool is_on_impeller(const Geometry& geometry, const Eigen::Vector3d& at) {
  const Impeller& impeller = *geometry.impeller;
  const double r = at.head<2>().norm(), shaft = impeller.shaft_diameter / 2, end = impeller.shaft_end;
  if (std::abs(r - shaft) < slack && at.z() > end - slack) return true;
  if (std::abs(at.z() - end) < slack && r < shaft + slack) return true;
  for (const PinLevel& level : impeller.pins)
    for (int arm = 0; arm < level.arms; ++arm)
      if (is_on_arm(geometry, level, arm, at)) return true;
  for (const Disc& disc : impeller.discs) {
    const double away = std::abs(at.z() - disc.height);
    const bool is_on_face = std::abs(away - disc.thickness / 2) < slack && r < disc.diameter / 2 + slack;
    const bool is_on_rim = std::abs(r - disc.diameter / 2) < slack && away < disc.thickness / 2 + slack;
    if (is_on_face || is_on_rim) return true;
  }
  return false;
}

TEST(StirredMesh, is_good_for_mills_of_three_sizes) {
  expect_good(laboratory_mill(), 0.0775 / 17);
  expect_good(laboratory_mill(), 0.0775 / 12);
  expect_good(mill_of(0.203, 0.185), 0.1015 / 17);
  expect_good(mill_of(0.256, 0.233), 0.128 / 17);
}

TEST(StirredMesh, is_good_for_other_impellers) {
  Geometry mill = laboratory_mill();
  mill.impeller->pins = {{0.0304, 0.141, 0.008, 10, 4}, {0.0700, 0.120, 0.008, 55, 4}};
  expect_good(mill, 0.0045);
  mill.impeller->pins.clear();
  expect_good(mill, 0.006);
  mill.impeller->discs = {{0.03, 0.12, 0.005}, {0.07, 0.10, 0.005}};
  expect_good(mill, 0.006);
  mill.impeller->pins = {{0.10, 0.141, 0.010, 0, 2}};
  expect_good(mill, 0.006);
}

TEST(StirredMesh, has_the_usual_number_of_cells) {
  const VolumeMesh mesh = make_stirred_mesh(laboratory_mill(), 0.0775 / 17);
  EXPECT_GT(mesh.cells, 40000);
  EXPECT_LT(mesh.cells, 80000);
}

TEST(StirredMesh, patches_have_the_walls_areas) {
  const Geometry mill = laboratory_mill();
  const VolumeMesh mesh = make_stirred_mesh(mill, 0.0045);
  const double r = mill.radius(), s = mill.impeller->shaft_diameter / 2;
  EXPECT_NEAR(measure_patch(mesh, "shell").area, 2 * pi * r * mill.length, 2e-3 * 2 * pi * r * mill.length);
  EXPECT_NEAR(measure_patch(mesh, "base").area, pi * r * r, 2e-3 * pi * r * r);
  EXPECT_NEAR(measure_patch(mesh, "lid").area, pi * (r * r - s * s), 2e-3 * pi * r * r);
  // Sides of shaft and pins, the tips, and the shaft's end; where a pin leaves the shaft it has no side
  double sides = 2 * pi * s * (mill.length - mill.impeller->shaft_end) + pi * s * s;
  for (const PinLevel& level : mill.impeller->pins) {
    const double half = level.thickness / 2;
    sides += level.arms * (2 * pi * half * (level.length / 2 - s) + pi * half * half);
    // Of the shaft, the pin takes about its section
    sides -= level.arms * pi * half * half;
  }
  EXPECT_NEAR(measure_patch(mesh, "impeller").area, sides, 0.03 * sides);
}

TEST(StirredMesh, of_three_arms_is_as_good_as_of_two) {
  const auto worst = [](double thickness, int arms, double cell_size) {
    Geometry geometry = laboratory_mill();
    geometry.impeller->pins = {{0.0400, 0.141, thickness, 0, arms}};
    return quality(make_stirred_mesh(geometry, cell_size)).max_non_orthogonality;
  };
  for (const auto& [thickness, cell_size] : {std::pair(0.012, 0.0036), {0.012, 0.0045}, {0.015, 0.0045}})
    EXPECT_LT(worst(thickness, 3, cell_size), worst(thickness, 2, cell_size) + 5)
        << thickness << ' ' << cell_size;
}

TEST(StirredMesh, points_of_the_impeller_lie_on_it) {
  Geometry pins_and_disc = laboratory_mill();
  pins_and_disc.impeller->pins[1].angle = -70;
  pins_and_disc.impeller->discs = {{0.11, 0.12, 0.005}};
  Geometry three_arms = laboratory_mill();
  three_arms.impeller->pins = {{0.0304, 0.141, 0.010, 10, 3}, {0.0700, 0.120, 0.008, 40, 1}};
  for (const Geometry& mill : {laboratory_mill(), pins_and_disc, three_arms}) {
    const VolumeMesh mesh = make_stirred_mesh(mill, 0.0055);
    for (const int point : measure_patch(mesh, "impeller").points) {
      const Eigen::Vector3d& at = mesh.points[static_cast<std::size_t>(point)];
      ASSERT_TRUE(is_on_impeller(mill, at)) << at.transpose();
    }
  }
}

TEST(StirredMesh, faces_are_in_openfoams_order) {
  const VolumeMesh mesh = make_stirred_mesh(laboratory_mill(), 0.008);
  for (std::size_t face = 0; face < mesh.neighbour.size(); ++face) {
    ASSERT_LT(mesh.owner[face], mesh.neighbour[face]);
    if (face == 0) continue;
    const auto before = std::pair(mesh.owner[face - 1], mesh.neighbour[face - 1]);
    ASSERT_LT(before, std::pair(mesh.owner[face], mesh.neighbour[face]));
  }
}

}  // namespace
