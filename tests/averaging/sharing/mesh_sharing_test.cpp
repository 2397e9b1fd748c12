// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/sharing/mesh_sharing.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>
#include <stdexcept>

#include "averaging/mesh/deforming_mesh.hpp"
#include "averaging/sharing/box_exact.hpp"
#include "tests/averaging/mesh_support.hpp"
#include "tests/averaging/sharing/share_helpers.hpp"

namespace millfoam::averaging {
namespace {

using Eigen::Vector3d;

constexpr double radius = 0.06, length = 0.024;

TestMesh drum() {
  return drum_mesh(radius, length, 4, 3, 4);
}

/// The drum with its inside warped; its boundary stays where it is.
TestMesh warped_drum() {
  const TestMesh flat = drum();
  TestMesh mesh = warped(flat, 0.0009);
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    const Vector3d& p = flat.points[i];
    const bool inside = p.head<2>().norm() < 0.99 * radius && p.z() > 1e-9 && p.z() < length - 1e-9;
    if (!inside) mesh.points[i] = p;
  }
  return mesh;
}

template <typename Sharing>
Sharing at_rest(const TestMesh& mesh, int points = 12, std::optional<double> period = std::nullopt) {
  Sharing sharing(std::make_unique<RigidMesh>(prepare(mesh.topology, mesh.points), parse_motion({}), 0.0),
                  points, period);
  sharing.begin_record(0);
  return sharing;
}

template <typename Sharing>
Sharing turning(const TestMesh& mesh, const std::vector<std::string>& motion, double reference_time,
                double time) {
  Sharing sharing(
      std::make_unique<RigidMesh>(prepare(mesh.topology, mesh.points), parse_motion(motion), reference_time));
  sharing.begin_record(time);
  return sharing;
}

Particle ball_at(const Vector3d& centre, double of_radius) {
  return {1, {centre.x(), centre.y(), centre.z()}, {}, of_radius};
}

void expect_same(const std::vector<double>& a, const std::vector<double>& b, double tolerance) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t c = 0; c < a.size(); ++c) ASSERT_NEAR(a[c], b[c], tolerance) << "cell " << c;
}

/// Balls wholly in the drum, of many sizes.
std::vector<Particle> balls_in_drum(int count, double smallest, double largest) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> either(-1, 1), exponent(std::log(smallest), std::log(largest));
  std::vector<Particle> balls;
  while (static_cast<int>(balls.size()) < count) {
    const double r = std::exp(exponent(random)), reach = 0.97 * radius - r;
    const Vector3d centre(reach * either(random), reach * either(random),
                          length / 2 + (length / 2 - r) * either(random));
    if (centre.head<2>().norm() < reach) balls.push_back(ball_at(centre, r));
  }
  return balls;
}

struct NamedMesh {
  const char* name;
  TestMesh mesh;
};

class MeshExactOn : public ::testing::TestWithParam<NamedMesh> {
 protected:
  void expect_whole(MeshExact& sharing, const Particle& ball) {
    const std::vector<double> cells = shared(sharing, ball);
    ASSERT_NEAR(sum(cells) / sphere_volume(ball.radius), 1, 1e-12)
        << ball.position[0] << ' ' << ball.position[1] << ' ' << ball.position[2] << " R " << ball.radius;
    for (std::size_t c = 0; c < cells.size(); ++c) {
      ASSERT_GE(cells[c], 0);
      ASSERT_LE(cells[c], sharing.volumes()[c] * (1 + 1e-12));
    }
  }
};

TEST_P(MeshExactOn, RandomBallsSharesTheirVolume) {
  MeshExact sharing = at_rest<MeshExact>(GetParam().mesh);
  for (const Particle& ball : balls_in_drum(1500, 1e-8, 0.011)) expect_whole(sharing, ball);
}

TEST_P(MeshExactOn, BallsOnFacesEdgesAndCornersSharesTheirVolume) {
  const TestMesh& mesh = GetParam().mesh;
  MeshExact sharing = at_rest<MeshExact>(mesh);
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
          std::min({0.97 * radius - centre.head<2>().norm(), centre.z(), length - centre.z()});
      for (const double r : {1e-8, 1e-4, 0.002, 0.006, 0.011}) {
        if (r < wall) expect_whole(sharing, ball_at(centre, r));
      }
    }
  }
}

TEST_P(MeshExactOn, BallsAgreesWithFineSampling) {
  MeshExact exact = at_rest<MeshExact>(GetParam().mesh);
  MeshSampling sampling = at_rest<MeshSampling>(GetParam().mesh, 60);
  for (const Particle& ball : balls_in_drum(6, 0.003, 0.011)) {
    // A lattice of 60 points misplaces up to 3/(4 n) of a ball at each face.
    expect_same(shared(exact, ball), shared(sampling, ball), 0.02 * sphere_volume(ball.radius));
  }
}

INSTANTIATE_TEST_SUITE_P(Meshes, MeshExactOn,
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

TEST(MeshExact, OnBoxesSharesAsTheBoxGrid) {
  const BoxGrid grid({-1, -1, -1}, {1, 1, 1}, {5, 6, 7});
  BoxExact on_grid(grid);
  MeshExact on_mesh = at_rest<MeshExact>(box_mesh({-1, -1, -1}, {1, 1, 1}, {5, 6, 7}));
  for (const Particle& ball : random_balls(600, 1.1, 0.7)) {
    expect_same(shared(on_mesh, ball), shared(on_grid, ball), 1e-12 * sphere_volume(ball.radius));
  }
}

TEST(MeshExact, OnPeriodicBoxesSharesAsThePeriodicBoxGrid) {
  const BoxGrid grid({-1, -1, -1}, {1, 1, 1}, {5, 6, 7}, {false, false, true});
  BoxExact on_grid(grid);
  MeshExact on_mesh = at_rest<MeshExact>(box_mesh({-1, -1, -1}, {1, 1, 1}, {5, 6, 7}), 12, 2.0);
  for (const Particle& ball : random_balls(300, 3, 0.7)) {
    expect_same(shared(on_mesh, ball), shared(on_grid, ball), 1e-12 * sphere_volume(ball.radius));
  }
}

TEST(MeshExact, ABallThatTouchesAFaceFromWithinStaysInItsCell) {
  MeshExact sharing = at_rest<MeshExact>(box_mesh({0, 0, 0}, {3, 3, 3}, {3, 3, 3}));
  const std::vector<double> cells = shared(sharing, ball_at({1.5, 1.5, 1.5}, 0.5));
  EXPECT_NEAR(cells[13], sphere_volume(0.5), 1e-15);
  EXPECT_NEAR(sum(cells), cells[13], 1e-15);
}

TEST(MeshExact, AnEighthOfABallLiesAtEachSideOfACorner) {
  MeshExact sharing = at_rest<MeshExact>(box_mesh({0, 0, 0}, {2, 2, 2}, {2, 2, 2}));
  for (const double volume : shared(sharing, ball_at({1, 1, 1}, 0.6))) {
    EXPECT_NEAR(volume, sphere_volume(0.6) / 8, 1e-15);
  }
}

TEST(MeshExact, ABallTenCellsAcrossFillsTheCellsWithinIt) {
  const TestMesh mesh = warped(box_mesh({0, 0, 0}, {12, 12, 12}, {12, 12, 12}), 0.1);
  MeshExact sharing = at_rest<MeshExact>(mesh);
  const Particle ball = ball_at({6.1, 5.9, 6}, 5);
  const std::vector<double> cells = shared(sharing, ball);
  EXPECT_NEAR(sum(cells) / sphere_volume(5), 1, 1e-12);
  const std::size_t middle = (6 * 12 + 6) * 12 + 6;
  EXPECT_EQ(cells[middle], sharing.volumes()[middle]);
}

TEST(MeshExact, OutsideTheMeshLiesWhatAFlatEndCutsOff) {
  MeshExact sharing = at_rest<MeshExact>(drum());
  for (const double z : {0.001, -0.001}) {
    const double r = 0.002, above = r + z;
    EXPECT_NEAR(sum(shared(sharing, ball_at({0.01, 0.02, z}, r))), pi * above * above * (3 * r - above) / 3,
                1e-20);
  }
  EXPECT_EQ(sum(shared(sharing, ball_at({0.1, 0, 0.01}, 0.002))), 0);
}

TEST(MeshExact, ABallAcrossAGapMeetsBothOfItsSides) {
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
  MeshExact sharing = at_rest<MeshExact>(assemble(whole.points, cells));
  MeshExact without_gap = at_rest<MeshExact>(whole);
  const Particle ball = ball_at({1.7, 0.5, 0.5}, 1.6);
  const std::vector<double> found = shared(sharing, ball), expected = shared(without_gap, ball);
  EXPECT_GT(found[2], 0);
  EXPECT_NEAR(found[0], expected[0], 1e-13);
  EXPECT_NEAR(found[1], expected[1], 1e-13);
  EXPECT_NEAR(found[2], expected[3], 1e-13);
}

template <typename Sharing>
class MeshSharingBy : public ::testing::Test {};
using Both = ::testing::Types<MeshExact, MeshSampling>;
TYPED_TEST_SUITE(MeshSharingBy, Both);

TYPED_TEST(MeshSharingBy, AveragesInTheTurnedFrameAsTheTurnedBallsInTheFixedOne) {
  const std::vector<std::string> motion{"rotation speed -7 origin 0.01 0 0",
                                        "translation velocity 0.1 0.2 0"};
  const double time = 0.31, reference = 0.12;
  TypeParam moving = turning<TypeParam>(warped_drum(), motion, reference, time);
  TypeParam fixed = at_rest<TypeParam>(warped_drum());
  // Written out: back along the path, back about the origin, then forward to the reference time.
  const auto into_mesh = [&](Vector3d p) -> Vector3d {
    const Vector3d origin(0.01, 0, 0), velocity(0.1, 0.2, 0);
    p -= time * velocity + origin;
    const double angle = 7 * (time - reference), c = std::cos(angle), s = std::sin(angle);
    return Vector3d(c * p.x() - s * p.y(), s * p.x() + c * p.y(), p.z()) + origin + reference * velocity;
  };
  const Eigen::Isometry3d lab = parse_motion(motion)->place(time);
  for (Particle ball : balls_in_drum(200, 0.0005, 0.008)) {
    const Vector3d place = lab * Vector3d(ball.position[0], ball.position[1], ball.position[2]);
    ball.position = {place.x(), place.y(), place.z()};
    const Vector3d turned = into_mesh(place);
    const std::vector<double> in_fixed = shared(fixed, ball_at(turned, ball.radius));
    // A point of a template may change sides where it lies within rounding of a face: none does here.
    expect_same(shared(moving, ball), in_fixed, 1e-12 * sphere_volume(ball.radius));
  }
}

TYPED_TEST(MeshSharingBy, IsTheSameAfterAFullTurn) {
  TypeParam sharing = turning<TypeParam>(warped_drum(), {"rotation speed " + std::to_string(8)}, 0, 0.1);
  const std::vector<Particle> balls = balls_in_drum(200, 0.0005, 0.008);
  std::vector<std::vector<double>> before;
  for (const Particle& ball : balls) before.push_back(shared(sharing, ball));
  sharing.begin_record(0.1 + 2 * pi / 8);
  for (std::size_t b = 0; b < balls.size(); ++b) {
    expect_same(shared(sharing, balls[b]), before[b], 1e-12 * sphere_volume(balls[b].radius));
  }
}

TYPED_TEST(MeshSharingBy, KeepsVolumeOfBallsOverPeriodicEnds) {
  TypeParam sharing = at_rest<TypeParam>(drum(), 12, length);
  for (Particle ball : balls_in_drum(200, 0.0005, 0.011)) {
    const std::vector<double> before = shared(sharing, ball);
    EXPECT_NEAR(sum(before) / sphere_volume(ball.radius), 1, 1e-12);
    ball.position[2] += length / 2;
    EXPECT_NEAR(sum(shared(sharing, ball)) / sphere_volume(ball.radius), 1, 1e-12);
    ball.position[2] += length / 2;
    expect_same(shared(sharing, ball), before, 1e-12 * sphere_volume(ball.radius));
  }
}

TYPED_TEST(MeshSharingBy, ClonesShareAlike) {
  TypeParam sharing = turning<TypeParam>(drum(), {"rotation speed 3"}, 0, 0.2);
  const auto other = sharing.clone();
  other->begin_record(0.2);
  for (const Particle& ball : balls_in_drum(20, 0.0005, 0.008)) {
    EXPECT_EQ(shared(*other, ball), shared(sharing, ball));
  }
}

TYPED_TEST(MeshSharingBy, APeriodThatIsNotTheMeshsExtentIsRefused) {
  expect_named(message_of<std::invalid_argument>([&] { at_rest<TypeParam>(drum(), 12, 0.03); }),
               {"0.024", "0.03", "period"});
}

TYPED_TEST(MeshSharingBy, SamplesSuperquadricsInTheMeshsFrame) {
  TypeParam sharing = turning<TypeParam>(drum(), {"rotation speed 3"}, 0, 0.2);
  const Superquadric shape{{0.004, 0.002, 0.003}, {4, 4}, {0.9, 0.1, 0.3, 0.2}};
  const Particle ball = ball_at({0.02, 0.01, 0.012}, 0.006);
  const std::vector<double> cells = shared(sharing, ball, shape);
  EXPECT_NEAR(sum(cells) / superquadric_volume(shape), 1, 1e-12);
  EXPECT_GT(std::count_if(cells.begin(), cells.end(), [](double v) { return v > 0; }), 2);
}

TEST(MeshSampling, ABallWithinACellGivesItItsVolume) {
  MeshSampling sharing = at_rest<MeshSampling>(box_mesh({0, 0, 0}, {3, 3, 3}, {3, 3, 3}));
  EXPECT_EQ(shared(sharing, ball_at({1.5, 1.5, 1.5}, 0.49))[13], sphere_volume(0.49));
}

TEST(MeshSampling, ConvergesToTheExactShares) {
  const std::vector<Particle> balls = balls_in_drum(60, 0.002, 0.009);
  MeshExact exact = at_rest<MeshExact>(warped_drum());
  std::array<double, 2> error{};
  for (const std::size_t level : {0U, 1U}) {
    MeshSampling sampling = at_rest<MeshSampling>(warped_drum(), level == 0 ? 8 : 32);
    for (const Particle& ball : balls) {
      const std::vector<double> a = shared(exact, ball), b = shared(sampling, ball);
      for (std::size_t c = 0; c < a.size(); ++c)
        error[level] += std::abs(a[c] - b[c]) / sphere_volume(ball.radius);
    }
  }
  // Points that a face of random lean tells apart err as the lattice's spacing at worst, and to its power 2
  // on average over many: four times as many along a diameter give 1/4 to 1/16.
  EXPECT_LT(error[1], error[0] / 4);
  EXPECT_GT(error[1], error[0] / 64);
}

/// A drum that is squeezed along y by a tenth in a second and turns about z meanwhile.
struct DeformingDrum : ::testing::Test {
  TemporaryFolder folder;
  TestMesh mesh = drum();
  std::shared_ptr<const MeshSeries> series;

  static MeshPoints squeezed(MeshPoints points, double by) {
    for (Vector3d& p : points) p.y() *= 1 - by;
    return points;
  }

  DeformingDrum() {
    MeshWriter writer(folder / "mesh.h5", mesh.topology, 2.0);
    writer.append(0, mesh.points);
    writer.append(0.4, squeezed(mesh.points, 0.04));
    writer.append(1, squeezed(mesh.points, 0.1));
    writer.finish();
    series = std::make_shared<const MeshSeries>(folder / "mesh.h5");
  }
};

TEST_F(DeformingDrum, HasPointsThatAreLinearBetweenItsTimes) {
  for (const double part : {0.0, 0.03, 0.04, 0.07, 0.1}) {
    const MeshPoints points = series->points_at(2 + 10 * part), expected = squeezed(mesh.points, part);
    for (std::size_t i = 0; i < points.size(); ++i) EXPECT_LT((points[i] - expected[i]).norm(), 1e-16);
  }
}

TEST_F(DeformingDrum, IsNotKnownOutsideItsTimes) {
  for (const double time : {1.99, 3.01, 0.5}) {
    expect_named(message_of<std::out_of_range>([&] { series->points_at(time); }),
                 {"mesh.h5", "outside", "from 2 to 3 s"});
  }
}

TEST_F(DeformingDrum, SharesAsAMeshThatStaysWhereItIsThen) {
  MeshExact exact(std::make_unique<DeformingMesh>(series));
  MeshSampling sampling(std::make_unique<DeformingMesh>(series));
  for (const double part : {0.07, 0.02, 0.1}) {
    const double time = 2 + 10 * part;
    exact.begin_record(time);
    sampling.begin_record(time);
    const TestMesh then{mesh.topology, series->points_at(time)};
    MeshExact fixed_exact = at_rest<MeshExact>(then);
    MeshSampling fixed_sampling = at_rest<MeshSampling>(then);
    expect_same(exact.volumes(), fixed_exact.volumes(), 0);
    for (const Particle& ball : balls_in_drum(100, 0.0005, 0.009)) {
      expect_same(shared(exact, ball), shared(fixed_exact, ball), 1e-15 * sphere_volume(ball.radius));
      expect_same(shared(sampling, ball), shared(fixed_sampling, ball), 1e-15 * sphere_volume(ball.radius));
    }
  }
}

TEST_F(DeformingDrum, ACellTurnedInsideOutIsRefusedWithTheTime) {
  MeshWriter writer(folder / "bad.h5", mesh.topology, 0);
  writer.append(0, mesh.points);
  writer.append(1, squeezed(mesh.points, 2));
  writer.finish();
  DeformingMesh bad(std::make_shared<const MeshSeries>(folder / "bad.h5"));
  EXPECT_NO_THROW(bad.begin_record(0.1));
  expect_named(message_of<std::invalid_argument>([&] { bad.begin_record(0.75); }),
               {"0.75 s", "cell 0", "volume"});
}

}  // namespace
}  // namespace millfoam::averaging
