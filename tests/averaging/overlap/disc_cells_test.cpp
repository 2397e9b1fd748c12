// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/overlap/disc_cells.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/averaging/overlap/quadrature_support.hpp"
#include "tests/averaging/test_support.hpp"

namespace millfoam::averaging {
namespace {

/// Area of the disc in r < circle and phi < ray, |ray| < pi/2, for a disc that does not hold the origin:
/// along rays, the part of the chord within the circle.
double area_within(double distance, double rho, double circle, double ray) {
  const double widest = std::asin(rho / distance);
  const auto part = [&](double phi) {
    const double offset = distance * std::sin(phi), foot = distance * std::cos(phi);
    const double half = std::sqrt(std::max(0.0, rho * rho - offset * offset));
    const double from = foot - half, to = std::min(foot + half, circle);
    return to > from ? (to - from) * (to + from) / 2 : 0.0;
  };
  const double cosine = (circle * circle + distance * distance - rho * rho) / (2 * circle * distance);
  const double corner = std::abs(cosine) < 1 ? std::acos(cosine) : 0.0;
  return integral(part, -widest, std::clamp(ray, -widest, widest), {-corner, corner, 0});
}

TEST(DiscCells, CutByOneCircleAndOneRayIsTheQuadraturesArea) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0, 1);
  DiscCells discs;
  std::vector<double> areas;
  for (int n = 0; n < 300; ++n) {
    const double distance = 1 + unit(random), rho = 0.9 * unit(random) + 0.05;
    const double circle = distance + 1.2 * rho * (2 * unit(random) - 1);
    const double ray = 1.1 * std::asin(rho / distance) * (2 * unit(random) - 1);
    discs.place(distance, {circle}, {ray});
    discs.areas(rho, areas);
    ASSERT_NEAR(areas[0], area_within(distance, rho, circle, ray), 1e-12) << n;
    ASSERT_NEAR(areas[1], area_within(distance, rho, circle, 1.5) - areas[0], 1e-12);
    ASSERT_NEAR(areas[2], area_within(distance, rho, 9, ray) - areas[0], 1e-12);
  }
}

TEST(DiscCells, CutByCirclesIsTheLensOfTwoCircles) {
  const double d = 1.3, r = 0.9, rho = 0.8;
  DiscCells discs;
  discs.place(d, {r}, {});
  std::vector<double> areas;
  discs.areas(rho, areas);
  const double a = std::acos((d * d + r * r - rho * rho) / (2 * d * r));
  const double b = std::acos((d * d + rho * rho - r * r) / (2 * d * rho));
  EXPECT_NEAR(areas[0], r * r * a + rho * rho * b - d * r * std::sin(a), 1e-15);
  EXPECT_NEAR(areas[1], pi * rho * rho - areas[0], 1e-15);
}

TEST(DiscCells, AboutTheOriginAreRingsAndSectors) {
  DiscCells discs;
  discs.place(0, {0.25, 0.5, 2}, {-2, 1});
  std::vector<double> areas;
  discs.areas(1, areas);
  const std::vector<double> rings{0.0625, 0.1875, 0.75, 0}, angles{pi - 2, 3, pi - 1};
  for (std::size_t n = 0; n < 4; ++n) {
    for (std::size_t m = 0; m < 3; ++m) {
      EXPECT_NEAR(areas[n * 3 + m], rings[n] * angles[m] / 2, 1e-15) << n << ' ' << m;
    }
  }
}

TEST(DiscCells, OverTheOriginAreQuartersByFourRaysThroughTheirCentre) {
  // The centre moves along a ray: the sectors on both sides of it stay mirror images, and the two behind it,
  // too.
  DiscCells discs;
  std::vector<double> areas;
  discs.place(0.3, {}, {-pi / 2, 0, pi / 2});
  discs.areas(1, areas);
  const double h = 0.3, segment = std::acos(h) - h * std::sqrt(1 - h * h);
  EXPECT_NEAR(areas[0], segment / 2, 1e-15);
  EXPECT_NEAR(areas[1], (pi - segment) / 2, 1e-15);
  EXPECT_NEAR(areas[2], (pi - segment) / 2, 1e-15);
  EXPECT_NEAR(areas[3], segment / 2, 1e-15);
}

/// A grid about a disc anywhere, also with its edge through the origin, a corner, or along a circle or ray.
TEST(DiscCells, AddUpToTheDiscAndNoneIsNegative) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0, 1);
  DiscCells discs;
  std::vector<double> areas;
  for (int n = 0; n < 20000; ++n) {
    std::vector<double> circles, rays;
    for (double r = 0.1 + 0.1 * unit(random); r < 3; r += 0.25) circles.push_back(r);
    for (double phi = -pi + unit(random); phi < pi; phi += 0.3) rays.push_back(phi);
    double distance = n % 5 == 0 ? 0.01 * unit(random) : unit(random), rho = 0.01 + unit(random);
    if (n % 7 == 1) distance = rho;
    if (n % 7 == 2) rho = std::abs(circles[2] - distance) + 0.0;
    if (n % 7 == 3) rho = circles[2] + distance;
    if (n % 7 == 4) rho = std::abs(distance * std::sin(rays[3]));
    if (n % 7 == 5) {
      rho = std::hypot(circles[3] * std::cos(rays[4]) - distance, circles[3] * std::sin(rays[4]));
    }
    discs.place(distance, circles, rays);
    discs.areas(rho, areas);
    double sum = 0;
    for (const double area : areas) {
      ASSERT_GT(area, -2e-15) << n;
      sum += area;
    }
    ASSERT_NEAR(sum, pi * rho * rho, 1e-14) << n;
  }
}

TEST(DiscCells, OfATinyDiscFarFromTheOriginAreThoseOfAPlaneCut) {
  // A disc of a millionth of the distance sees a straight line; its centre is h radii within the circle.
  DiscCells discs;
  std::vector<double> areas;
  for (const double h : {-0.5, 0.0, 0.25}) {
    const double rho = std::ldexp(1.0, -20);
    discs.place(1, {1 + h * rho}, {0});
    discs.areas(rho, areas);
    const double segment = std::acos(-h) + h * std::sqrt(1 - h * h);
    EXPECT_NEAR((areas[0] + areas[1]) / (rho * rho), segment, 1e-6);  // the circle's bend
    EXPECT_NEAR(areas[0] / areas[1], 1, 1e-15);
  }
}

}  // namespace
}  // namespace millfoam::averaging
