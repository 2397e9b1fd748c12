// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/overlap/superquadric.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "averaging/overlap/sphere_template.hpp"
#include "tests/averaging/overlap/quadrature_support.hpp"
#include "tests/averaging/test_support.hpp"

namespace millfoam::averaging {
namespace {

TEST(SuperquadricVolume, OfAnEllipsoidIsItsVolume) {
  EXPECT_NEAR(superquadric_volume({{0.5, 2, 3}}), 4 * pi / 3 * 0.5 * 2 * 3, 1e-14);
}

TEST(SuperquadricVolume, OfAnOctahedronIsFourThirdsOfItsHalfAxes) {
  EXPECT_NEAR(superquadric_volume({{1, 2, 3}, {1, 1}}), 4.0 / 3 * 1 * 2 * 3, 1e-14);
}

TEST(SuperquadricVolume, OfAnEverBlockierOneTendsToTheBox) {
  EXPECT_NEAR(superquadric_volume({{1, 2, 3}, {1e4, 1e4}}), 48, 48 * 1e-6);
}

TEST(SuperquadricVolume, OfABlockyCylinderTendsToTheCylinder) {
  EXPECT_NEAR(superquadric_volume({{1, 1, 2}, {1e5, 2}}), 4 * pi, 4 * pi * 3e-5);
}

TEST(SuperquadricVolume, IsTheSumOfItsSlices) {
  for (const auto& [n1, n2] : {std::pair{2.0, 4.0}, {3.5, 2.0}, {8.0, 3.0}, {6.0, 6.0}}) {
    // A slice at height z is |x|^n2 + |y|^n2 <= s^n2 with s = (1 - z^n1)^(1/n1): s^2 times the area at z = 0.
    const auto height = [n = n2](double x) { return std::pow(1 - std::pow(x, n), 1 / n); };
    const double middle = 4 * integral(height, 0, 1);
    const auto slice = [&, n = n1](double z) { return middle * std::pow(1 - std::pow(z, n), 2 / n); };
    EXPECT_NEAR(superquadric_volume({{1, 1, 1}, {n1, n2}}), 2 * integral(slice, 0, 1), 1e-9);
  }
}

TEST(SuperquadricVolume, GivesTheDiameterOfTheSphereOfThatVolume) {
  EXPECT_NEAR(volume_equivalent_diameter({{0.3, 0.3, 0.3}}), 0.6, 1e-15);
  const Superquadric shape{{0.1, 0.2, 0.3}, {5, 3}};
  EXPECT_NEAR(sphere_volume(volume_equivalent_diameter(shape) / 2), superquadric_volume(shape), 1e-16);
}

TEST(SuperquadricVolume, OfAnImpossibleShapeIsRefused) {
  expect_named(message_of<std::invalid_argument>([] {
                 superquadric_volume({{1, -2, 1}});
               }),
               {"half axis", "-2", "positive"});
  expect_named(message_of<std::invalid_argument>([] {
                 volume_equivalent_diameter({{1, 1, 1}, {0.5, 2}});
               }),
               {"blockiness", "0.5", "at least 1"});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  expect_named(message_of<std::invalid_argument>([=] { superquadric_volume({{1, nan, 1}}); }), {"nan"});
}

TEST(SuperquadricTemplate, OfAnEllipsoidIsThatOfTheSphere) {
  EXPECT_EQ(SuperquadricTemplate({2, 2}, 12).points().size(),
            static_cast<std::size_t>(SphereTemplate(12).size()));
}

TEST(SuperquadricTemplate, FillsTheShapesPartOfItsBoundingBox) {
  for (const auto& blockiness : {std::array<double, 2>{2, 4}, {4, 2}, {7, 3}}) {
    const SuperquadricTemplate points(blockiness, 60);
    const double part = static_cast<double>(points.points().size()) / (60.0 * 60 * 60);
    // A flat end is known to half a layer of the lattice at each end.
    EXPECT_NEAR(part, superquadric_volume({{1, 1, 1}, blockiness}) / 8, 0.5 / 60);
  }
}

TEST(SuperquadricTemplate, IsTheCentreWhereTheLatticeIsTooCoarse) {
  const SuperquadricTemplate points({1, 1}, 2);
  ASSERT_EQ(points.points().size(), 1U);
  EXPECT_EQ(points.points()[0], (Vector3{0, 0, 0}));
}

}  // namespace
}  // namespace millfoam::averaging
