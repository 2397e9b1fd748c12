// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/mesh/periodic_faces.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/averaging/mesh_support.hpp"
#include "tests/averaging/test_support.hpp"

namespace millfoam::averaging {
namespace {

TEST(PeriodicFaces, PairTheFacesOfTheTwoEnds) {
  const MeshGeometry mesh = geometry_of(drum_mesh(1, 0.5, 4, 3, 2));
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

TEST(PeriodicFaces, APeriodThatDiffersInTheSeventhDigitIsRefusedWithItsDigits) {
  // 1e-6 of the length, not of the diagonal of a flat mesh
  const MeshGeometry mesh = geometry_of(drum_mesh(1, 0.5, 4, 3, 2));
  require_period(mesh, 0.5 * (1 + 5e-7));
  const std::string sentence =
      "the period is 0.500001 m, expected the mesh's length along z, 0.5 m, to 1e-6 of it";
  EXPECT_EQ(message_of<std::invalid_argument>([&] { require_period(mesh, 0.500001); }), sentence);
  EXPECT_EQ(message_of<std::invalid_argument>([&] { periodic_faces(mesh, 0.500001); }), sentence);
  expect_named(message_of<std::invalid_argument>([&] { require_period(mesh, 0.5000006); }), {"0.5000006 m"});
}

TEST(PeriodicFaces, EndsThatDifferAreRefused) {
  TestMesh cone = box_mesh({0, 0, 0}, {1, 1, 1}, {2, 2, 1});
  for (Eigen::Vector3d& p : cone.points) p.x() *= 1 + p.z();
  expect_named(message_of<std::invalid_argument>([&] { periodic_faces(geometry_of(cone), 1); }),
               {"boundary face", "no partner"});
}

}  // namespace
}  // namespace millfoam::averaging
