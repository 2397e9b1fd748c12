// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/mesh/mesh_diffusion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "averaging/mesh/periodic_faces.hpp"
#include "tests/averaging/mesh_support.hpp"
#include "tests/averaging/test_support.hpp"

namespace millfoam::averaging {
namespace {

MeshGeometry geometry(const TestMesh& mesh) {
  return MeshGeometry(mesh.topology, mesh.points);
}

TEST(MeshDiffusion, KeepsTheTotalOfEachComponent) {
  const MeshGeometry mesh = geometry(drum_mesh(1, 1, 6, 5, 4));
  std::vector<double> values(2 * mesh.cells(), 0.0);
  values[20] = 1;
  values[21] = -3;
  values[200] = 2;
  MeshDiffusion(mesh, 0.3).apply(values, 2);
  double first = 0, second = 0;
  for (std::size_t c = 0; c < mesh.cells(); ++c) {
    first += values[2 * c];
    second += values[2 * c + 1];
  }
  EXPECT_NEAR(first, 3, 1e-13);
  EXPECT_NEAR(second, -3, 1e-13);
}

TEST(MeshDiffusion, LeavesAUniformDensityUniform) {
  const MeshGeometry mesh = geometry(drum_mesh(1, 1, 6, 5, 4));
  std::vector<double> volumes = mesh.volumes();
  MeshDiffusion(mesh, 0.3).apply(volumes, 1);
  for (std::size_t c = 0; c < mesh.cells(); ++c) EXPECT_NEAR(volumes[c] / mesh.volumes()[c], 1, 1e-12);
}

TEST(MeshDiffusion, SpreadsAPointToHalfTheSquareOfTheWidthAlongEachAxis) {
  const MeshGeometry mesh = geometry(box_mesh({-1, -1, -1}, {1, 1, 1}, {21, 21, 21}));
  std::vector<double> values(mesh.cells(), 0.0);
  values[mesh.cells() / 2] = 1;
  const double width = 0.3;
  MeshDiffusion(mesh, width).apply(values, 1);
  for (int axis = 0; axis < 3; ++axis) {
    double variance = 0;
    for (std::size_t c = 0; c < mesh.cells(); ++c) variance += values[c] * std::pow(mesh.centres()[c][axis], 2);
    // On equal cells each step adds its variance exactly; the walls are seven standard deviations away.
    EXPECT_NEAR(variance / (width * width / 2), 1, 1e-4);
  }
}

TEST(MeshDiffusion, MakesNothingNegativeAndMixesVelocitiesWithinTheirRange) {
  const MeshGeometry mesh = geometry(drum_mesh(1, 1, 6, 5, 4));
  std::vector<double> values(2 * mesh.cells(), 0.0);  // volume and momentum
  for (std::size_t c = 0; c < mesh.cells(); c += 7) {
    values[2 * c] = 0.1 * static_cast<double>(1 + c % 5);
    values[2 * c + 1] = values[2 * c] * (c % 2 == 0 ? 2 : -1);
  }
  MeshDiffusion(mesh, 0.5).apply(values, 2);
  for (std::size_t c = 0; c < mesh.cells(); ++c) {
    EXPECT_GE(values[2 * c], 0);
    if (values[2 * c] == 0) continue;
    EXPECT_LE(values[2 * c + 1] / values[2 * c], 2 + 1e-12);
    EXPECT_GE(values[2 * c + 1] / values[2 * c], -1 - 1e-12);
  }
}

TEST(MeshDiffusion, PassesThroughPeriodicEndsAsWithin) {
  const MeshGeometry mesh = geometry(box_mesh({0, 0, 0}, {1, 1, 2}, {1, 1, 10}));
  const MeshDiffusion diffusion(mesh, 0.5, 2.0);
  std::vector<double> at_the_end(10, 0.0), within(10, 0.0);
  at_the_end[0] = within[5] = 1;
  diffusion.apply(at_the_end, 1);
  diffusion.apply(within, 1);
  std::rotate(within.begin(), within.begin() + 5, within.end());
  for (std::size_t c = 0; c < 10; ++c) EXPECT_NEAR(at_the_end[c], within[c], 1e-15);
}

TEST(MeshDiffusion, AWidthThatIsNotPositiveIsRefused) {
  const MeshGeometry mesh = geometry(box_mesh({0, 0, 0}, {1, 1, 1}, {1, 1, 1}));
  expect_named(message_of<std::invalid_argument>([&] { MeshDiffusion(mesh, 0); }), {"width", "0.0"});
}

TEST(PeriodicFaces, PairTheFacesOfTheTwoEnds) {
  const MeshGeometry mesh = geometry(drum_mesh(1, 0.5, 4, 3, 2));
  const auto pairs = periodic_faces(mesh, 0.5);
  EXPECT_EQ(pairs.size(), mesh.cells() / 2);
  for (const auto& [low, high] : pairs) {
    const int a = mesh.topology().owner[static_cast<std::size_t>(low)];
    const int b = mesh.topology().owner[static_cast<std::size_t>(high)];
    const Eigen::Vector3d apart =
        mesh.centres()[static_cast<std::size_t>(b)] - mesh.centres()[static_cast<std::size_t>(a)];
    EXPECT_NEAR((apart - Eigen::Vector3d(0, 0, 0.25)).norm(), 0, 1e-12);
  }
}

TEST(PeriodicFaces, OfAnotherPeriodOrEndsThatDifferAreRefused) {
  const MeshGeometry drum = geometry(drum_mesh(1, 0.5, 4, 3, 2));
  expect_named(message_of<std::invalid_argument>([&] { periodic_faces(drum, 0.4); }), {"0.4 m", "0.5 m"});
  TestMesh cone = box_mesh({0, 0, 0}, {1, 1, 1}, {2, 2, 1});
  for (Eigen::Vector3d& p : cone.points) p.x() *= 1 + p.z();
  expect_named(message_of<std::invalid_argument>([&] { periodic_faces(geometry(cone), 1); }),
               {"boundary face", "no partner"});
}

}  // namespace
}  // namespace millfoam::averaging
