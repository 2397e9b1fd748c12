// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/deposition/exact_mesh_deposition.hpp"

#include <gtest/gtest.h>

#include <random>

#include "averaging/deposition/exact_box_deposition.hpp"
#include "averaging/deposition/sampled_mesh_deposition.hpp"
#include "tests/averaging/deposition/mesh_deposition_support.hpp"

namespace millfoam::averaging {
namespace {

using Eigen::Vector3d;

struct NamedMesh {
  const char* name;
  TestMesh mesh;
};

class ExactMeshDepositionOn : public ::testing::TestWithParam<NamedMesh> {
 protected:
  void expect_whole(ExactMeshDeposition& deposition, const Particle& ball) {
    const std::vector<double> cells = deposited(deposition, ball);
    ASSERT_NEAR(sum(cells) / sphere_volume(ball.radius), 1, 1e-12)
        << ball.position[0] << ' ' << ball.position[1] << ' ' << ball.position[2] << " R " << ball.radius;
    for (std::size_t c = 0; c < cells.size(); ++c) {
      ASSERT_GE(cells[c], 0);
      ASSERT_LE(cells[c], deposition.volumes()[c] * (1 + 1e-12));
    }
  }
};

TEST_P(ExactMeshDepositionOn, RandomBallsDepositsTheirVolume) {
  ExactMeshDeposition deposition = at_rest<ExactMeshDeposition>(GetParam().mesh);
  for (const Particle& ball : balls_in_drum(1500, 1e-8, 0.011)) expect_whole(deposition, ball);
}

TEST_P(ExactMeshDepositionOn, BallsOnFacesEdgesAndCornersDepositsTheirVolume) {
  const TestMesh& mesh = GetParam().mesh;
  ExactMeshDeposition deposition = at_rest<ExactMeshDeposition>(mesh);
  const MeshGeometry geometry(mesh.topology, mesh.points);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> part(0, 1);
  for (std::size_t f = 0; f < geometry.facets().size(); f += 7) {
    const Facet& facet = geometry.facets()[f];
    const auto corner = [&](std::size_t c) -> const Vector3d& {
      return geometry.points()[static_cast<std::size_t>(facet.corners[c])];
    };
    const double u = part(random), v = (1 - u) * part(random);
    const Vector3d on_edge = corner(0) + u * (corner(1) - corner(0));
    for (const Vector3d& centre : {corner(0), on_edge, Vector3d(on_edge + v * (corner(2) - corner(0))),
                                   Vector3d(on_edge + 1e-12 * on_edge)}) {
      const double wall =
          std::min({0.97 * drum_radius - centre.head<2>().norm(), centre.z(), drum_length - centre.z()});
      for (const double r : {1e-8, 1e-4, 0.002, 0.006, 0.011}) {
        if (r < wall) expect_whole(deposition, ball_at(centre, r));
      }
    }
  }
}

TEST_P(ExactMeshDepositionOn, BallsAgreesWithFineSampling) {
  ExactMeshDeposition exact = at_rest<ExactMeshDeposition>(GetParam().mesh);
  SampledMeshDeposition sampling = at_rest<SampledMeshDeposition>(GetParam().mesh, 60);
  for (const Particle& ball : balls_in_drum(6, 0.003, 0.011)) {
    // A lattice of 60 points misplaces up to 3/(4 n) of a ball at each face.
    expect_same(deposited(exact, ball), deposited(sampling, ball), 0.02 * sphere_volume(ball.radius));
  }
}

INSTANTIATE_TEST_SUITE_P(Meshes, ExactMeshDepositionOn,
                         ::testing::Values(NamedMesh{"FlatHexahedra", drum()},
                                           NamedMesh{"WarpedHexahedra", warped_drum()},
                                           NamedMesh{"JoinedCells",
                                                     [] {
                                                       const TestMesh mesh = warped_drum();
                                                       std::vector<int> into(mesh.topology.cells);
                                                       for (std::size_t c = 0; c < into.size(); ++c) {
                                                         into[c] = static_cast<int>(c / 2);
                                                       }
                                                       return joined(mesh, into);
                                                     }()}),
                         [](const auto& test) { return test.param.name; });

TEST(ExactMeshDeposition, OnBoxesDepositsAsTheBoxGrid) {
  const BoxGrid grid({-1, -1, -1}, {1, 1, 1}, {5, 6, 7});
  ExactBoxDeposition on_grid(grid);
  ExactMeshDeposition on_mesh = at_rest<ExactMeshDeposition>(box_mesh({-1, -1, -1}, {1, 1, 1}, {5, 6, 7}));
  for (const Particle& ball : random_balls(600, 1.1, 0.7)) {
    expect_same(deposited(on_mesh, ball), deposited(on_grid, ball), 1e-12 * sphere_volume(ball.radius));
  }
}

TEST(ExactMeshDeposition, OnPeriodicBoxesDepositsAsThePeriodicBoxGrid) {
  const BoxGrid grid({-1, -1, -1}, {1, 1, 1}, {5, 6, 7}, {false, false, true});
  ExactBoxDeposition on_grid(grid);
  ExactMeshDeposition on_mesh =
      at_rest<ExactMeshDeposition>(box_mesh({-1, -1, -1}, {1, 1, 1}, {5, 6, 7}), 12, 2.0);
  for (const Particle& ball : random_balls(300, 3, 0.7)) {
    expect_same(deposited(on_mesh, ball), deposited(on_grid, ball), 1e-12 * sphere_volume(ball.radius));
  }
}

TEST(ExactMeshDeposition, ABallThatTouchesAFaceFromWithinStaysInItsCell) {
  ExactMeshDeposition deposition = at_rest<ExactMeshDeposition>(box_mesh({0, 0, 0}, {3, 3, 3}, {3, 3, 3}));
  const std::vector<double> cells = deposited(deposition, ball_at({1.5, 1.5, 1.5}, 0.5));
  EXPECT_NEAR(cells[13], sphere_volume(0.5), 1e-15);
  EXPECT_NEAR(sum(cells), cells[13], 1e-15);
}

TEST(ExactMeshDeposition, AnEighthOfABallLiesAtEachSideOfACorner) {
  ExactMeshDeposition deposition = at_rest<ExactMeshDeposition>(box_mesh({0, 0, 0}, {2, 2, 2}, {2, 2, 2}));
  for (const double volume : deposited(deposition, ball_at({1, 1, 1}, 0.6))) {
    EXPECT_NEAR(volume, sphere_volume(0.6) / 8, 1e-15);
  }
}

TEST(ExactMeshDeposition, ABallTenCellsAcrossFillsTheCellsWithinIt) {
  const TestMesh mesh = warped(box_mesh({0, 0, 0}, {12, 12, 12}, {12, 12, 12}), 0.1);
  ExactMeshDeposition deposition = at_rest<ExactMeshDeposition>(mesh);
  const Particle ball = ball_at({6.1, 5.9, 6}, 5);
  const std::vector<double> cells = deposited(deposition, ball);
  EXPECT_NEAR(sum(cells) / sphere_volume(5), 1, 1e-12);
  const std::size_t middle = (6 * 12 + 6) * 12 + 6;
  EXPECT_EQ(cells[middle], deposition.volumes()[middle]);
}

TEST(ExactMeshDeposition, OutsideTheMeshLiesWhatAFlatEndCutsOff) {
  ExactMeshDeposition deposition = at_rest<ExactMeshDeposition>(drum());
  for (const double z : {0.001, -0.001}) {
    const double r = 0.002, above = r + z;
    EXPECT_NEAR(sum(deposited(deposition, ball_at({0.01, 0.02, z}, r))),
                pi * above * above * (3 * r - above) / 3, 1e-20);
  }
  EXPECT_EQ(sum(deposited(deposition, ball_at({0.1, 0, 0.01}, 0.002))), 0);
}

TEST(ExactMeshDeposition, ABallAcrossAGapMeetsBothOfItsSides) {
  // Two boxes with a gap between them: the third of four cells along x is missing.
  const TestMesh whole = box_mesh({0, 0, 0}, {4, 1, 1}, {4, 1, 1});
  std::vector<std::vector<TestFace>> cells(3);
  for (std::size_t face = 0; face < whole.topology.faces(); ++face) {
    TestFace corners(whole.topology.face_points.begin() + whole.topology.face_begin[face],
                     whole.topology.face_points.begin() + whole.topology.face_begin[face + 1]);
    const auto put = [&](int cell, const TestFace& seen) {
      if (cell != 2) cells[cell == 3 ? 2 : static_cast<std::size_t>(cell)].push_back(seen);
    };
    put(whole.topology.owner[face], corners);
    if (face < whole.topology.internal_faces()) {
      put(whole.topology.neighbour[face], TestFace(corners.rbegin(), corners.rend()));
    }
  }
  ExactMeshDeposition deposition = at_rest<ExactMeshDeposition>(assemble(whole.points, cells));
  ExactMeshDeposition without_gap = at_rest<ExactMeshDeposition>(whole);
  const Particle ball = ball_at({1.7, 0.5, 0.5}, 1.6);
  const std::vector<double> found = deposited(deposition, ball), expected = deposited(without_gap, ball);
  EXPECT_GT(found[2], 0);
  EXPECT_NEAR(found[0], expected[0], 1e-13);
  EXPECT_NEAR(found[1], expected[1], 1e-13);
  EXPECT_NEAR(found[2], expected[3], 1e-13);
}

}  // namespace
}  // namespace millfoam::averaging
