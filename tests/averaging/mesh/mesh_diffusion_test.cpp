// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/mesh/mesh_diffusion.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <random>
#include <stdexcept>

#include "tests/averaging/mesh_support.hpp"
#include "tests/averaging/test_support.hpp"

namespace millfoam::averaging {
namespace {

/// A drum with warped faces and skewed cells.
TestMesh rough_drum() {
  return warped(drum_mesh(0.06, 0.024, 4, 4, 6), 0.0004);
}

TEST(MeshDiffusion, KeepsTheTotalOfEachComponent) {
  const MeshGeometry geometry = geometry_of(rough_drum());
  std::mt19937 random(3);
  std::uniform_real_distribution<double> positive(0, 1), either(-1, 1);
  std::vector<double> totals;
  std::array<double, 2> sum{}, size{}, smoothed{};
  for (std::size_t c = 0; c < geometry.cells(); ++c) {
    totals.push_back(positive(random));
    totals.push_back(either(random));
    for (std::size_t k = 0; k < 2; ++k) {
      sum[k] += totals[2 * c + k];
      size[k] += std::abs(totals[2 * c + k]);
    }
  }
  MeshDiffusion(geometry, 0.015).apply(totals, 2);
  for (std::size_t n = 0; n < totals.size(); ++n) smoothed[n % 2] += totals[n];
  EXPECT_NEAR(smoothed[0], sum[0], 1e-13 * size[0]);
  EXPECT_NEAR(smoothed[1], sum[1], 1e-13 * size[1]);
}

TEST(MeshDiffusion, LeavesAUniformDensityUniform) {
  const MeshGeometry geometry = geometry_of(rough_drum());
  std::vector<double> totals = geometry.volumes();
  MeshDiffusion(geometry, 0.02).apply(totals, 1);
  for (std::size_t c = 0; c < totals.size(); ++c) EXPECT_NEAR(totals[c] / geometry.volumes()[c], 1, 1e-12);
}

TEST(MeshDiffusion, SpreadsAPointToTheVarianceOfItsKernel) {
  const int n = 41;
  const MeshGeometry geometry = geometry_of(box_mesh({0, 0, 0}, {1, 1, 1}, {n, n, n}));
  std::vector<double> totals(geometry.cells(), 0);
  totals[geometry.cells() / 2] = 1;
  const double width = 0.06;
  MeshDiffusion(geometry, width).apply(totals, 1);
  Eigen::Vector3d mean = Eigen::Vector3d::Zero(), square = Eigen::Vector3d::Zero();
  for (std::size_t c = 0; c < totals.size(); ++c) {
    const Eigen::Vector3d offset = geometry.centres()[c] - Eigen::Vector3d::Constant(0.5);
    mean += totals[c] * offset;
    square += totals[c] * offset.cwiseAbs2();
  }
  EXPECT_LT(mean.norm(), 1e-12);
  // Implicit Euler's clouds decay as exp(-4 r/b): 8 widths away some 1e-13 is left, which is turned back by
  // the wall.
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(square[axis], width * width / 2, 1e-7 * width * width);
  }
}

TEST(MeshDiffusion, IsNearTheGaussianOfItsWidth) {
  const int n = 41;
  const MeshGeometry geometry = geometry_of(box_mesh({0, 0, 0}, {1, 1, 1}, {n, n, n}));
  std::vector<double> totals(geometry.cells(), 0);
  totals[geometry.cells() / 2] = 1;
  const double width = 0.2;
  MeshDiffusion(geometry, width).apply(totals, 1);
  double difference = 0;
  for (std::size_t c = 0; c < totals.size(); ++c) {
    const double r2 = (geometry.centres()[c] - Eigen::Vector3d::Constant(0.5)).squaredNorm();
    const double kernel = std::exp(-r2 / (width * width)) / std::pow(pi * width * width, 1.5);
    difference += std::abs(totals[c] - kernel * geometry.volumes()[c]);
  }
  // Four steps of implicit Euler are more peaked than the Gaussian; measured 0.25 of the total is elsewhere.
  EXPECT_LT(difference, 0.3);
}

TEST(MeshDiffusion, MakesNothingNegative) {
  const MeshGeometry geometry = geometry_of(rough_drum());
  std::vector<double> totals(geometry.cells(), 0);
  totals[0] = 1e-9;
  MeshDiffusion(geometry, 0.003).apply(totals, 1);
  EXPECT_GE(*std::min_element(totals.begin(), totals.end()), 0);
  EXPECT_LT(totals[0], 1e-9);
}

TEST(MeshDiffusion, GivesTheSameThroughAPeriodicEndAsInTheMiddle) {
  const TestMesh mesh = drum_mesh(0.06, 0.024, 3, 2, 8);
  const MeshGeometry geometry = geometry_of(mesh);
  const MeshDiffusion diffusion(geometry, 0.01, 0.024);
  const std::size_t layer = geometry.cells() / 8;
  std::vector<double> at_end(geometry.cells(), 0), in_middle(geometry.cells(), 0);
  at_end[5] = 1;
  in_middle[4 * layer + 5] = 1;
  diffusion.apply(at_end, 1);
  diffusion.apply(in_middle, 1);
  for (std::size_t c = 0; c < geometry.cells(); ++c) {
    EXPECT_NEAR(at_end[c], in_middle[(c + 4 * layer) % geometry.cells()], 1e-13);
  }
}

TEST(MeshDiffusion, DoesNotCrossAWallThatIsNotPeriodic) {
  const MeshGeometry geometry = geometry_of(box_mesh({0, 0, 0}, {1, 1, 1}, {1, 1, 20}));
  std::vector<double> totals(geometry.cells(), 0);
  totals[0] = 1;
  MeshDiffusion(geometry, 0.1).apply(totals, 1);
  EXPECT_LT(totals.back(), 1e-9);
}

TEST(MeshDiffusion, MixesVelocitiesWithinTheirRangeHoweverLittleComes) {
  const MeshGeometry geometry = geometry_of(rough_drum());
  std::vector<double> values(2 * geometry.cells(), 0.0);  // volume and momentum
  for (std::size_t c = 0; c < geometry.cells(); c += 97) {
    values[2 * c] = 1e-9 * static_cast<double>(1 + c % 5);
    values[2 * c + 1] = values[2 * c] * (c % 2 == 0 ? 2 : -1);
  }
  MeshDiffusion(geometry, 0.02).apply(values, 2);
  for (std::size_t c = 0; c < geometry.cells(); ++c) {
    if (values[2 * c] == 0) {
      EXPECT_EQ(values[2 * c + 1], 0);
      continue;
    }
    EXPECT_LE(values[2 * c + 1] / values[2 * c], 2 + 1e-12);
    EXPECT_GE(values[2 * c + 1] / values[2 * c], -1 - 1e-12);
  }
}

TEST(MeshDiffusion, RefusesWhatItCannotDo) {
  const MeshGeometry box = geometry_of(box_mesh({0, 0, 0}, {1, 1, 1}, {2, 2, 2}));
  expect_named(message_of<std::invalid_argument>([&] { MeshDiffusion(box, 0); }),
               {"width", "0.0", "above 0"});
  expect_named(message_of<std::invalid_argument>([&] { MeshDiffusion(box, 0.1, 0.7); }),
               {"period is 0.7 m", "1 m"});
}

}  // namespace
}  // namespace millfoam::averaging
