// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/deposition/exact_cylinder_deposition.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "averaging/deposition/exact_box_deposition.hpp"
#include "averaging/deposition/sampled_cylinder_deposition.hpp"
#include "averaging/overlap/sphere_box.hpp"
#include "averaging/overlap/sphere_triangle.hpp"
#include "tests/averaging/deposition/deposition_support.hpp"
#include "tests/averaging/overlap/quadrature_support.hpp"

namespace millfoam::averaging {
namespace {

Particle ball_at_polar(double r, double theta, double z, double radius) {
  return {1, {r * std::cos(theta), r * std::sin(theta), z}, {}, radius};
}

TEST(ExactCylinderDeposition, GivesTheSpheresVolumeWhereNothingSticksOut) {
  const CylinderGrid grid({0, 1.2}, {-1, 1}, {6, 12, 5});
  ExactCylinderDeposition deposition(grid);
  for (const double largest : {0.02, 0.1, 0.4}) {
    for (const Particle& ball : random_balls(100, 0.55, largest)) {
      EXPECT_NEAR(sum(deposited(deposition, ball)) / sphere_volume(ball.radius), 1, 1e-12);
    }
  }
}

TEST(ExactCylinderDeposition, DepositsSpheresOnFacesEdgesCornersAndTheAxisWithoutLoss) {
  const CylinderGrid grid({0, 1}, {-1, 1}, {5, 8, 4});
  ExactCylinderDeposition deposition(grid);
  const double step = grid.spacing()[1];
  for (const double radius : {1e-6, 0.01, 0.3}) {
    for (const double r : {0.0, 1e-9, 0.2, 0.31, 0.4, 0.4 + radius}) {
      for (const double theta : {0.0, step, 0.4 * step, 5 * step, -step}) {
        for (const double z : {0.0, 0.1, radius}) {
          const double whole = sum(deposited(deposition, ball_at_polar(r, theta, z, radius)));
          EXPECT_NEAR(whole / sphere_volume(radius), 1, 1e-12) << r << ' ' << theta << ' ' << z;
        }
      }
    }
  }
}

TEST(ExactCylinderDeposition, ASphereOnTheAxisIsCutIntoEqualSectorsOfNapkinRings) {
  const CylinderGrid grid({0, 1}, {-1, 1}, {4, 6, 2});
  const double radius = 0.6;
  const std::vector<double> cells = [&] {
    ExactCylinderDeposition deposition(grid);
    return deposited(deposition, {1, {0, 0, 0}, {}, radius});
  }();
  const auto within = [&](double r) {  // of the sphere, in the cylinder of radius r
    return 4 * pi / 3 * (std::pow(radius, 3) - std::pow(std::max(0.0, radius * radius - r * r), 1.5));
  };
  for (int n = 0; n < 4 * 6 * 2; ++n) {
    const int i = n % 4;
    const double exact = (within(0.25 * (i + 1)) - within(0.25 * i)) / 12;
    EXPECT_NEAR(cells[static_cast<std::size_t>(n)], exact, 1e-12 * sphere_volume(radius)) << n;
  }
}

TEST(ExactCylinderDeposition, ASphereWhollyInOneVoxelGivesItExactlyItsVolume) {
  const CylinderGrid grid({0, 1}, {0, 1}, {2, 6, 1});
  ExactCylinderDeposition deposition(grid);
  const std::vector<double> cells = deposited(deposition, ball_at_polar(0.75, pi / 6, 0.5, 0.2));
  EXPECT_NEAR(cells[grid.offset({1, 0, 0})] / sphere_volume(0.2), 1, 1e-15);
  EXPECT_EQ(cells[grid.offset({1, 0, 0})], sum(cells));
}

TEST(ExactCylinderDeposition, ARayThroughASpheresCentreHalvesIt) {
  const CylinderGrid grid({0, 1}, {0, 1}, {1, 5, 1});
  ExactCylinderDeposition deposition(grid);
  for (int j = 0; j < 5; ++j) {
    const std::vector<double> cells = deposited(deposition, ball_at_polar(0.6, j * 2 * pi / 5, 0.5, 0.3));
    EXPECT_NEAR(cells[grid.offset({0, j, 0})] / sphere_volume(0.3), 0.5, 1e-12);
    EXPECT_NEAR(cells[grid.offset({0, (j + 4) % 5, 0})] / sphere_volume(0.3), 0.5, 1e-12);
  }
}

TEST(ExactCylinderDeposition, RaysAndEndsCutAsPlanesDo) {
  // Four sectors are the quadrants; with the axis in the sphere, its edge and corners at the ends too.
  const CylinderGrid grid({0, 3}, {-3, 3}, {1, 4, 2});
  ExactCylinderDeposition deposition(grid);
  for (const Particle& ball : random_balls(200, 0.7, 1)) {
    const std::vector<double> cells = deposited(deposition, ball);
    const auto& [x, y, z] = ball.position;
    const std::array<double, 4> left{0, -3, -3, 0}, front{0, 0, -3, -3};
    for (int n = 0; n < 8; ++n) {
      const auto j = static_cast<std::size_t>(n % 4);
      const double low = n / 4 == 0 ? -3 : 0;
      const double exact = sphere_box_volume({left[j] - x, front[j] - y, low - z},
                                             {left[j] + 3 - x, front[j] + 3 - y, low + 3 - z}, ball.radius);
      EXPECT_NEAR(cells[static_cast<std::size_t>(n)], exact, 1e-12 * sphere_volume(ball.radius)) << n;
    }
  }
}

/// The sphere within an endless cylinder of radius r whose axis is at a distance from its centre, by slices
/// across the line from axis to centre: discs between two lines.
double within_cylinder(double radius, double distance, double r) {
  const auto slice = [&](double x) {
    const double q2 = std::max(0.0, radius * radius - (x - distance) * (x - distance));
    const double b2 = std::max(0.0, r * r - x * x), q = std::sqrt(q2), b = std::sqrt(b2);
    return b >= q ? pi * q2 : 2 * (q2 * std::atan2(b, std::sqrt(q2 - b2)) + b * std::sqrt(q2 - b2));
  };
  // The slice's disc and its lines meet where r^2 - x^2 = R^2 - (x - D)^2.
  const double meet = (r * r - radius * radius + distance * distance) / (2 * distance);
  return integral(slice, std::max(-r, distance - radius), std::min(r, distance + radius), {meet});
}

TEST(ExactCylinderDeposition, ACircleCutsAsTheQuadratureAcrossItSays) {
  const CylinderGrid grid({0, 1}, {-1, 1}, {2, 1, 1});
  ExactCylinderDeposition deposition(grid);
  for (const double radius : {0.05, 0.2, 0.4}) {
    for (const double place : {-0.999, -0.6, -0.2, 0.0, 0.01, 0.5, 0.98}) {
      const double distance = 0.5 + place * radius;
      const double inner = deposited(deposition, ball_at_polar(distance, 2, 0, radius))[0];
      const double exact = within_cylinder(radius, distance, 0.5);
      EXPECT_NEAR(inner / sphere_volume(radius), exact / sphere_volume(radius), 1e-12)
          << radius << ' ' << place;
    }
  }
}

/// The sphere in a cell of the grid whose arcs are replaced by chords of equal steps; the error is the lost
/// segments' area.
double faceted(const CylinderGrid& grid, const VoxelIndex& voxel, int facets, const Particle& ball) {
  const auto& [i, j, k] = voxel;
  const auto corner = [&](int step, int ring, int end) -> Eigen::Vector3d {
    const double theta = (j + static_cast<double>(step) / facets) * grid.spacing()[1];
    const double r = grid.radii()[0] + (i + ring) * grid.spacing()[0];
    const double z = grid.ends()[0] + (k + end) * grid.spacing()[2];
    return {r * std::cos(theta) - ball.position[0], r * std::sin(theta) - ball.position[1],
            z - ball.position[2]};
  };
  double sum = 0;
  const auto add = [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                       const Eigen::Vector3d& d) {
    sum += sphere_triangle_volume(a, b, c, ball.radius) + sphere_triangle_volume(a, c, d, ball.radius);
  };
  for (int s = 0; s < facets; ++s) {
    add(corner(s, 1, 0), corner(s + 1, 1, 0), corner(s + 1, 1, 1), corner(s, 1, 1));  // outer
    add(corner(s, 0, 0), corner(s, 0, 1), corner(s + 1, 0, 1), corner(s + 1, 0, 0));  // inner
    add(corner(s, 0, 1), corner(s, 1, 1), corner(s + 1, 1, 1), corner(s + 1, 0, 1));  // top
    add(corner(s, 0, 0), corner(s + 1, 0, 0), corner(s + 1, 1, 0), corner(s, 1, 0));  // bottom
  }
  add(corner(0, 0, 0), corner(0, 1, 0), corner(0, 1, 1), corner(0, 0, 1));
  add(corner(facets, 0, 0), corner(facets, 0, 1), corner(facets, 1, 1), corner(facets, 1, 0));
  return sum;
}

TEST(ExactCylinderDeposition, IsTheLimitOfFinelyFacetedCells) {
  const CylinderGrid grid({0.1, 1}, {-1, 1}, {3, 7, 3});
  ExactCylinderDeposition deposition(grid);
  for (const Particle& ball : random_balls(12, 0.6, 0.5, 3)) {
    const std::vector<double> cells = deposited(deposition, ball);
    for (int n = 0; n < 3 * 7 * 3; ++n) {
      const VoxelIndex voxel{n % 3, n / 3 % 7, n / 21};
      // The error falls as the facets' number squared; two numbers give the limit.
      const double coarse = faceted(grid, voxel, 50, ball), fine = faceted(grid, voxel, 100, ball);
      EXPECT_NEAR(cells[grid.offset(voxel)], (4 * fine - coarse) / 3, 1e-6 * sphere_volume(ball.radius));
    }
  }
}

TEST(ExactCylinderDeposition, IsWhatSamplingTendsTo) {
  const CylinderGrid grid({0, 1}, {-1, 1}, {4, 9, 4});
  ExactCylinderDeposition exact(grid);
  std::vector<double> errors;
  for (const int n : {6, 12, 24, 48}) {
    SampledCylinderDeposition sampling(grid, n);
    errors.push_back(root_mean_square_difference(exact, sampling, random_balls(200, 0.5, 0.3)));
  }
  EXPECT_LT(errors[1], 0.026);  // at 12 points, as at a plane (`sphere_template.hpp`)
  for (std::size_t i = 1; i < errors.size(); ++i) EXPECT_LT(errors[i] / errors[i - 1], 0.6) << i;
}

TEST(ExactCylinderDeposition, ItsLayersHoldWhatABoxsLayersHold) {
  const CylinderGrid cylinder({0, 2}, {-1, 1}, {3, 5, 6});
  const BoxGrid box({-2, -2, -1}, {2, 2, 1}, {4, 4, 6});
  ExactCylinderDeposition round(cylinder);
  ExactBoxDeposition square(box);
  for (const Particle& ball : random_balls(100, 0.9, 0.4)) {
    const std::vector<double> a = deposited(round, ball), b = deposited(square, ball);
    for (std::size_t layer = 0; layer < 6; ++layer) {
      double in_round = 0, in_square = 0;
      for (std::size_t n = 0; n < 15; ++n) in_round += a[layer * 15 + n];
      for (std::size_t n = 0; n < 16; ++n) in_square += b[layer * 16 + n];
      EXPECT_NEAR(in_round, in_square, 1e-12 * sphere_volume(ball.radius));
    }
  }
}

TEST(ExactCylinderDeposition, ASphereAcrossAPeriodicEndComesInAtTheOther) {
  ExactCylinderDeposition deposition(CylinderGrid({0, 1}, {0, 2}, {1, 1, 4}, true));
  for (const double z : {0.0, 2.0, -6.0}) {
    const std::vector<double> cells = deposited(deposition, ball_at_polar(0.3, 1, z, 0.2));
    EXPECT_NEAR(cells[0], sphere_volume(0.2) / 2, 1e-14);
    EXPECT_NEAR(cells[3], sphere_volume(0.2) / 2, 1e-14);
  }
}

TEST(ExactCylinderDeposition, WhatLiesOutsideTheShellOrItsEndsGetsLost) {
  ExactCylinderDeposition deposition(CylinderGrid({0.5, 1}, {0, 1}, {2, 3, 2}));
  EXPECT_EQ(sum(deposited(deposition, ball_at_polar(0, 0, 0.5, 0.49))), 0);
  EXPECT_EQ(sum(deposited(deposition, ball_at_polar(1.5, 1, 0.5, 0.49))), 0);
  EXPECT_EQ(sum(deposited(deposition, ball_at_polar(0.75, 1, 1.5, 0.49))), 0);
  EXPECT_NEAR(sum(deposited(deposition, ball_at_polar(0.75, 1, 1, 0.2))), sphere_volume(0.2) / 2, 1e-14);
  const double exact = within_cylinder(0.2, 0.95, 1) - within_cylinder(0.2, 0.95, 0.5);
  EXPECT_NEAR(sum(deposited(deposition, ball_at_polar(0.95, 3, 0.5, 0.2))), exact,
              1e-12 * sphere_volume(0.2));
}

TEST(ExactCylinderDeposition, AnAbsurdlyLargeBallIsRefusedWithItsNumber) {
  ExactCylinderDeposition deposition(CylinderGrid({0, 1}, {0, 1}, {1, 1, 4}, true));
  std::vector<Deposit> deposits;
  const auto deposit = [&] { deposition.deposit({17, {0, 0, 0}, {}, 1e9}, deposits); };
  expect_named(message_of<std::invalid_argument>(deposit), {"17", "1e+09", "along z", "0.25"});
}

}  // namespace
}  // namespace millfoam::averaging
