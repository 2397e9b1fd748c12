// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/grids/cylindrical.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "averaging/grids/field_sampling.hpp"
#include "meshing/surface/pi.hpp"
#include "tests/averaging/test_support.hpp"

namespace millfoam::averaging {
namespace {

void expect_near(const Vector3& found, const Vector3& expected, double tolerance) {
  for (std::size_t a = 0; a < 3; ++a) EXPECT_NEAR(found[a], expected[a], tolerance) << a;
}

TEST(Cylindrical, ComponentsAreAlongRadiusAngleAndAxis) {
  expect_near(to_cylindrical({1, 2, 3}, {5, 0, 7}), {1, 2, 3}, 1e-15);
  expect_near(to_cylindrical({1, 2, 3}, {0, 5, 7}), {2, -1, 3}, 1e-15);
  expect_near(to_cylindrical({1, 2, 3}, {-4, 0, 7}), {-1, -2, 3}, 1e-15);
  expect_near(to_cylindrical({1, 2, 3}, {0, 0, 7}), {1, 2, 3}, 0);
  // omega x r is along theta alone
  expect_near(to_cylindrical({-0.4, 0.3, 0}, {0.3, 0.4, 1}), {0, 0.5, 0}, 1e-15);
}

TEST(Cylindrical, ComponentsAreThoseOfTheSameVectorTurnedWithItsPoint) {
  const Vector3 vector{0.3, -1.2, 0.7}, point{0.05, -0.02, 0.1};
  expect_near(to_cartesian(to_cylindrical(vector, point), point), vector, 1e-15);
  for (const double angle : {0.3, 2.0, -17.5}) {
    expect_near(to_cylindrical(turned(vector, angle), turned(point, angle)), to_cylindrical(vector, point),
                1e-14);
  }
}

TEST(CylinderFrame, TurnsOnlyWithCylindricalVelocitiesAndAFiniteSpeed) {
  const auto refusal = [](const CylinderFrame& frame) {
    return message_of<std::invalid_argument>([&] { CylinderGrid({0, 1}, {0, 1}, {1, 1, 1}, false, frame); });
  };
  expect_named(refusal({false, 3.0}), {"it turns", "expected cylindrical"});
  expect_named(refusal({true, std::nan("")}), {"angular velocity is nan", "rad/s"});
}

/// Solidity 0.3 + 0.1 cos(theta) and the velocity (0.1, 3 r, 0.2) along r, theta and z, on a cylinder that
/// turns at 5 rad/s.
struct TurningField : ::testing::Test {
  CylinderGrid grid{{0.2, 1}, {0, 1}, {16, 180, 2}, false, {true, 5.0}};
  SolidsWindow window{std::vector<double>(grid.size()),
                      std::vector<double>(3 * grid.size()),
                      std::vector<double>(grid.size(), 0.005),
                      std::vector<double>(grid.size(), 0.005),
                      {}};

  TurningField() {
    for (std::size_t n = 0; n < grid.size(); ++n) {
      const int ring = static_cast<int>(n % 16), sector = static_cast<int>(n / 16 % 180);
      const double r = 0.2 + 0.05 * (ring + 0.5), theta = (sector + 0.5) * grid.spacing()[1];
      window.solidity[n] = 0.3 + 0.1 * std::cos(theta);
      const Vector3 velocity{0.1, 3 * r, 0.2};
      for (std::size_t a = 0; a < 3; ++a) window.velocity[3 * n + a] = velocity[a];
    }
  }
};

TEST_F(TurningField, IsSampledWhereThePointIsInItsFrame) {
  for (const double time : {0.0, 0.13, 7.0}) {
    for (const double angle : {0.1, 1.0, 4.0}) {
      const Vector3 point{0.6 * std::cos(angle), 0.6 * std::sin(angle), 0.3};
      const LocalSolids local = sample(grid, window, point, Interpolation::linear, time);
      EXPECT_TRUE(local.inside);
      EXPECT_NEAR(local.solidity, 0.3 + 0.1 * std::cos(angle - 5 * time), 2e-5);
      // The flux is interpolated: r phi is not linear in theta
      const Vector3 expected{0.1 * std::cos(angle) - 1.8 * std::sin(angle),
                             0.1 * std::sin(angle) + 1.8 * std::cos(angle), 0.2};
      expect_near(local.velocity, expected, 1e-12);
    }
  }
}

TEST_F(TurningField, GivesAPointThatTurnsWithItTheSameSolidsForEver) {
  const Vector3 point{0.4, 0.3, 0.5};
  const LocalSolids first = sample(grid, window, point, Interpolation::linear, 0);
  for (const double time : {0.1, 3.7}) {
    const LocalSolids later = sample(grid, window, turned(point, 5 * time), Interpolation::linear, time);
    EXPECT_NEAR(later.solidity, first.solidity, 1e-14);
    expect_near(later.velocity, turned(first.velocity, 5 * time), 1e-14);
  }
}

}  // namespace
}  // namespace millfoam::averaging
