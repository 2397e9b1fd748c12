// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/mesh/poly_mesh.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/averaging/mesh_support.hpp"
#include "tests/averaging/test_support.hpp"

namespace millfoam::averaging {
namespace {

/// Two cubes side by side.
MeshTopology two_cells() {
  return box_mesh({0, 0, 0}, {2, 1, 1}, {2, 1, 1}).topology;
}

std::string topology_refusal(const MeshTopology& topology) {
  return message_of<std::invalid_argument>([&] { check(topology); });
}

TEST(PolyMesh, OfTwoCubesIsAccepted) {
  const MeshTopology topology = two_cells();
  EXPECT_NO_THROW(check(topology));
  EXPECT_EQ(topology.faces(), 11U);
  EXPECT_EQ(topology.internal_faces(), 1U);
}

TEST(PolyMesh, NeighboursAreTheCellsOfInternalFaces) {
  EXPECT_EQ(neighbours(two_cells()), (std::vector<std::array<int, 2>>{{0, 1}}));
}

TEST(PolyMesh, AFaceOfTwoPointsIsRefused) {
  MeshTopology topology = two_cells();
  topology.face_begin[3] -= 2;
  expect_named(topology_refusal(topology), {"face 2", "2 points", "3 or more"});
}

TEST(PolyMesh, APointThatIsNotThereIsRefused) {
  MeshTopology topology = two_cells();
  topology.face_points[5] = 12;
  expect_named(topology_refusal(topology), {"face 1", "point 12", "expected 0 to 11"});
  topology.face_points[5] = -1;
  expect_named(topology_refusal(topology), {"face 1", "point -1"});
}

TEST(PolyMesh, ACellThatIsNotThereIsRefused) {
  MeshTopology topology = two_cells();
  topology.owner[4] = 2;
  expect_named(topology_refusal(topology), {"face 4", "owner cell 2"});
  topology = two_cells();
  topology.neighbour[0] = -3;
  expect_named(topology_refusal(topology), {"face 0", "neighbour cell -3"});
}

TEST(PolyMesh, ANeighbourNotAboveItsOwnerIsRefused) {
  MeshTopology topology = two_cells();
  topology.neighbour[0] = topology.owner[0];
  expect_named(topology_refusal(topology), {"face 0", "neighbour above the owner"});
}

TEST(PolyMesh, ACellOfThreeFacesIsRefused) {
  MeshTopology topology = two_cells();
  for (std::size_t face = 1; face < topology.faces(); ++face) topology.owner[face] = face < 3 ? 1 : 0;
  expect_named(topology_refusal(topology), {"cell 1", "3 faces", "4 or more"});
}

TEST(PolyMesh, PatchesMustCoverTheBoundaryInOrder) {
  MeshTopology topology = two_cells();
  topology.patches = {{"inlet", 1, 4}, {"walls", 6, 5}};
  expect_named(topology_refusal(topology), {"'walls'", "face 5"});
  topology.patches = {{"inlet", 1, 4}, {"walls", 5, 5}};
  expect_named(topology_refusal(topology), {"face 10", "end at 11"});
}

TEST(PolyMesh, TablesOfDifferentLengthsAreRefused) {
  MeshTopology topology = two_cells();
  topology.face_begin.pop_back();
  expect_named(topology_refusal(topology), {"face_begin", "11"});
  topology = two_cells();
  topology.face_points.pop_back();
  expect_named(topology_refusal(topology), {"face_begin", "44", "43"});
  expect_named(topology_refusal({}), {"no cell"});
}

}  // namespace
}  // namespace millfoam::averaging
