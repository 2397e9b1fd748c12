// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/sharing/box_sampling.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "tests/averaging/test_support.hpp"

namespace millfoam::averaging {
namespace {

double sum(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

std::vector<Particle> random_particles(int count, double reach, double largest_radius) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-reach, reach), radius(0.01 * largest_radius, largest_radius);
  std::vector<Particle> particles;
  for (int p = 0; p < count; ++p) {
    particles.push_back({p + 1,
                         {place(random), place(random), place(random)},
                         {place(random), place(random), place(random)},
                         radius(random)});
  }
  return particles;
}

TEST(BoxSampling, DepositedAndOutsideAddUpToTheParticlesVolume) {
  const BoxGrid grid({-1, -1, -1}, {1, 1, 1}, {9, 8, 7});
  const SphereTemplate points;
  const ParticleRecord record{0, random_particles(2000, 1.4, 0.5)};
  const RecordSums sums = sample_record(grid, points, record);
  double volume = 0;
  for (const Particle& p : record.particles) volume += sphere_volume(p.radius);
  EXPECT_GT(sums.ledger.outside, 0.1 * volume);
  EXPECT_NEAR((sums.ledger.deposited + sums.ledger.outside) / volume, 1, 1e-12);
  EXPECT_NEAR(sum(sums.volume) / sums.ledger.deposited, 1, 1e-12);
  EXPECT_NEAR(sums.ledger.volume_in / volume, 1, 1e-12);
}

TEST(BoxSampling, ASphereWhollyInOneVoxelGivesItExactlyItsVolume) {
  const BoxGrid grid({0, 0, 0}, {3, 3, 3}, {3, 3, 3});
  RecordSums sums(grid.size());
  deposit(grid, SphereTemplate(), {1, {1.45, 1.5, 1.6}, {1, 2, 3}, 0.39}, sums);
  const double volume = sums.volume[grid.offset({1, 1, 1})];
  EXPECT_NEAR(volume / sphere_volume(0.39), 1, 1e-14);
  EXPECT_EQ(volume, sum(sums.volume));
  EXPECT_NEAR(sums.momentum[3 * grid.offset({1, 1, 1}) + 2] / volume, 3, 1e-14);
}

TEST(BoxSampling, AgreesWithVisitingEveryPointOfTheTemplate) {
  const BoxGrid grid({-1, -1, -1}, {1, 1, 1}, {5, 6, 7}, {true, false, true});
  const SphereTemplate points(10);
  const std::vector<Particle> particles = random_particles(200, 1.2, 0.6);
  const RecordSums sums = sample_record(grid, points, {0, particles});
  std::vector<double> visited(grid.size());
  for (const Particle& p : particles) {
    const Vector3 centre = grid.wrapped(p.position);
    for (int n = 0; n < 1000; ++n) {
      const std::array<int, 3> l{n % 10, n / 10 % 10, n / 100};
      if (!points.contains(l[0], l[1], l[2])) continue;
      Vector3 point{};
      for (std::size_t a = 0; a < 3; ++a) point[a] = centre[a] + p.radius * points.coordinate(l[a]);
      if (const auto voxel = grid.locate(point)) {
        visited[grid.offset(*voxel)] += sphere_volume(p.radius) / points.size();
      }
    }
  }
  for (std::size_t v = 0; v < visited.size(); ++v) EXPECT_NEAR(sums.volume[v], visited[v], 1e-12);
}

TEST(BoxSampling, ASphereOnACornerGivesAnEighthToEachNeighbour) {
  const BoxGrid grid({0, 0, 0}, {2, 2, 2}, {2, 2, 2});
  RecordSums sums(grid.size());
  deposit(grid, SphereTemplate(), {1, {1, 1, 1}, {}, 0.7}, sums);
  for (const double volume : sums.volume) EXPECT_NEAR(volume, sphere_volume(0.7) / 8, 1e-14);
}

TEST(BoxSampling, ASphereAcrossAPeriodicFaceComesInOnTheOtherSide) {
  const BoxGrid grid({0, 0, 0}, {1, 1, 4}, {1, 1, 4}, {false, false, true});
  for (const double z : {0.0, 4.0, -8.0}) {
    RecordSums sums(grid.size());
    deposit(grid, SphereTemplate(), {1, {0.5, 0.5, z}, {}, 0.4}, sums);
    EXPECT_NEAR(sums.volume[0], sphere_volume(0.4) / 2, 1e-14);
    EXPECT_NEAR(sums.volume[3], sphere_volume(0.4) / 2, 1e-14);
    EXPECT_EQ(sums.ledger.outside, 0);
  }
}

TEST(BoxSampling, AnEverRepeatingSphereLargerThanThePeriodLosesNothing) {
  const BoxGrid grid({-3, -3, 0}, {3, 3, 0.5}, {6, 6, 3}, {false, false, true});
  RecordSums sums(grid.size());
  deposit(grid, SphereTemplate(), {1, {0, 0, 0.1}, {}, 1.7}, sums);
  EXPECT_NEAR(sum(sums.volume) / sphere_volume(1.7), 1, 1e-13);
}

/// A simple cubic lattice of touching balls that fills the periodic unit cube.
ParticleRecord cubic_lattice(int per_edge, double shift) {
  ParticleRecord record;
  const double a = 1.0 / per_edge;
  for (int n = 0; n < per_edge * per_edge * per_edge; ++n) {
    record.particles.push_back({n + 1,
                                {a * (n % per_edge) + shift, a * (n / per_edge % per_edge) + shift,
                                 a * (n / per_edge / per_edge) + shift},
                                {},
                                a / 2});
  }
  return record;
}

TEST(BoxSampling, TheSolidityOfALatticeOverItsOwnCellsIsExact) {
  const BoxGrid grid({0, 0, 0}, {1, 1, 1}, {4, 4, 4}, {true, true, true});
  const RecordSums sums = sample_record(grid, SphereTemplate(), cubic_lattice(4, 0.0371));
  for (const double volume : sums.volume) EXPECT_NEAR(volume / grid.voxel_volume(), pi / 6, 1e-12);
}

TEST(BoxSampling, TheSolidityOfSlabsThroughALatticeIsRightToTheTemplatesKnownError) {
  // Slabs of half a lattice cell, displaced by s radii from the balls' centres: a slab holds the segment of
  // the balls between heights s and 1 (of the next ones nothing, of these from s on) and below s - 1 the
  // rest.
  constexpr int per_edge = 4;
  const double radius = 0.5 / per_edge;
  const BoxGrid grid({0, 0, 0}, {1, 1, 1}, {per_edge, per_edge, 2 * per_edge}, {true, true, true});
  for (const double s : {0.0, 0.13, 0.31, 0.5, 0.77}) {
    const RecordSums sums = sample_record(grid, SphereTemplate(), cubic_lattice(per_edge, -s * radius));
    const auto below = [](double h) { return (2 + 3 * h - h * h * h) / 4; };
    const double upper = 1 - below(s), lower_of_next = below(s - 1);
    const double exact = (upper + lower_of_next) * pi / 6 * 2;
    EXPECT_NEAR(sums.volume[0] / grid.voxel_volume(), exact, 2 * 0.063 * pi / 6 * 2) << "s = " << s;
  }
}

TEST(BoxSampling, TheErrorFallsAsOneOverTheTemplatesPoints) {
  const BoxGrid grid({0, 0, 0}, {1, 1, 1}, {1, 1, 2});
  const double h = 0.4;  // the plane's height above the centre, in radii
  for (const int n : {8, 24, 120}) {
    RecordSums sums(grid.size());
    deposit(grid, SphereTemplate(n), {1, {0.5, 0.5, 0.5 - h * 0.2}, {}, 0.2}, sums);
    EXPECT_NEAR(sums.volume[0] / sphere_volume(0.2), (2 + 3 * h - h * h * h) / 4, 0.75 / n);
  }
}

TEST(BoxSampling, TheOrderOfParticlesMakesNoDifference) {
  const BoxGrid grid({-1, -1, -1}, {1, 1, 1}, {4, 4, 4});
  ParticleRecord record{0, random_particles(500, 1, 0.3)};
  const RecordSums sums = sample_record(grid, SphereTemplate(), record);
  std::shuffle(record.particles.begin(), record.particles.end(), std::mt19937(3));
  const RecordSums shuffled = sample_record(grid, SphereTemplate(), record);
  for (std::size_t v = 0; v < grid.size(); ++v) {
    EXPECT_NEAR(shuffled.volume[v], sums.volume[v], 1e-13 * sums.volume[v]);
    EXPECT_NEAR(shuffled.momentum[3 * v], sums.momentum[3 * v], 1e-13 * sums.volume[v]);
  }
}

}  // namespace
}  // namespace millfoam::averaging
