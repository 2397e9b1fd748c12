// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/mesh/mesh_geometry.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <stdexcept>

#include "tests/averaging/mesh_support.hpp"
#include "tests/averaging/test_support.hpp"

namespace millfoam::averaging {
namespace {

using Eigen::Vector3d;

std::string mesh_refusal(const TestMesh& mesh) {
  return message_of<std::invalid_argument>([&] { geometry_of(mesh); });
}

double sum(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

TEST(MeshGeometry, OfBoxesHasTheirVolumesCentresAndBoxes) {
  const MeshGeometry geometry = geometry_of(box_mesh({1, 2, 3}, {3, 5, 4}, {4, 3, 2}));
  EXPECT_EQ(geometry.facets().size(), geometry.topology().faces());
  for (const double volume : geometry.volumes()) EXPECT_NEAR(volume, 0.25, 1e-15);
  EXPECT_TRUE(geometry.centres()[5].isApprox(Vector3d(1.75, 3.5, 3.25), 1e-15));
  EXPECT_TRUE(geometry.boxes()[5].isApprox(Eigen::AlignedBox3d(Vector3d(1.5, 3, 3), Vector3d(2, 4, 3.5))));
  EXPECT_TRUE(geometry.box().isApprox(Eigen::AlignedBox3d(Vector3d(1, 2, 3), Vector3d(3, 5, 4))));
}

TEST(MeshGeometry, OfADrumFillsItsPolygon) {
  const MeshGeometry geometry = geometry_of(drum_mesh(2, 3, 5, 3, 4));
  EXPECT_NEAR(sum(geometry.volumes()), 3 * 20 * 0.5 * 4 * std::sin(2 * pi / 20), 1e-12);
}

TEST(MeshGeometry, OfHexagonalPrismsHasTheirVolume) {
  const MeshGeometry geometry = geometry_of(honeycomb_mesh(3, 3, 2, 0.1));
  for (const double volume : geometry.volumes()) {
    EXPECT_NEAR(volume, 1.5 * std::sqrt(3.0) * 0.001, 1e-15);
  }
}

TEST(MeshGeometry, WarpedCellsFillWhatTheirPointsOnTheBoundaryEnclose) {
  const TestMesh flat = box_mesh({0, 0, 0}, {1, 1, 1}, {3, 3, 3});
  TestMesh mesh = warped(flat, 0.08);
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    const Vector3d& p = flat.points[i];
    if (p.minCoeff() < 1e-9 || p.maxCoeff() > 1 - 1e-9) mesh.points[i] = p;
  }
  EXPECT_NEAR(sum(geometry_of(mesh).volumes()), 1, 1e-14);
}

TEST(MeshGeometry, AWarpedHexahedronHasTheVolumeUnderBilinearFaces) {
  TestMesh mesh = box_mesh({0, 0, 0}, {1, 1, 1}, {1, 1, 1});
  for (Vector3d& point : mesh.points) {
    if (point.z() == 1) point.z() = 1 + 0.5 * point.x() * point.y();
  }
  const MeshGeometry geometry = geometry_of(mesh);
  EXPECT_NEAR(geometry.volumes()[0], 1 + 0.5 / 4, 1e-15);
  EXPECT_EQ(geometry.facets().size(), 5U + 4U);
}

TEST(MeshGeometry, ANearlyFlatQuadrangleIsCutFromItsLowestPoint) {
  TestMesh mesh = box_mesh({0, 0, 0}, {1, 1, 1}, {1, 1, 1});
  mesh.points[7].z() += 1e-9;
  const MeshGeometry geometry = geometry_of(mesh);
  ASSERT_EQ(geometry.facets().size(), 5U + 2U);
  EXPECT_EQ(geometry.points().size(), 8U);
  for (const Facet& facet : geometry.facets()) {
    if (facet.corner_count == 3) {
      EXPECT_EQ(facet.corners[0], 4);
    }
  }
}

TEST(MeshGeometry, NormalsPointOutOfTheirOwners) {
  const MeshGeometry geometry = geometry_of(drum_mesh(2, 3, 3, 2, 2));
  for (const Facet& facet : geometry.facets()) {
    const Vector3d& owner = geometry.centres()[static_cast<std::size_t>(facet.owner)];
    EXPECT_LT(facet.normal.dot(owner), facet.offset);
    if (facet.neighbour < 0) continue;
    EXPECT_GT(facet.normal.dot(geometry.centres()[static_cast<std::size_t>(facet.neighbour)]), facet.offset);
  }
}

TEST(MeshGeometry, FollowsItsPoints) {
  const TestMesh mesh = drum_mesh(2, 3, 3, 2, 2), other = warped(mesh, 0.05);
  MeshGeometry geometry = geometry_of(mesh);
  geometry.move(other.points);
  EXPECT_EQ(geometry.volumes(), geometry_of(other).volumes());
  geometry.move(mesh.points);
  EXPECT_EQ(geometry.volumes(), geometry_of(mesh).volumes());
}

TEST(MeshGeometry, ACellInsideOutIsRefusedByNumber) {
  TestMesh mesh = box_mesh({0, 0, 0}, {3, 1, 1}, {3, 1, 1});
  for (Vector3d& point : mesh.points) {
    if (point.x() == 2) point.x() = 3.5;
  }
  expect_named(mesh_refusal(mesh), {"cell 2", "volume", "positive"});
}

TEST(MeshGeometry, AnOpenCellIsRefusedByNumber) {
  TestMesh mesh = box_mesh({0, 0, 0}, {2, 1, 1}, {2, 1, 1});
  MeshTopology& topology = mesh.topology;
  topology.owner[10] = 1 - topology.owner[10];
  expect_named(mesh_refusal(mesh), {"cell", "not enclosed"});
}

}  // namespace
}  // namespace millfoam::averaging
