// SPDX-License-Identifier: GPL-3.0-or-later
// Depositing balls in the voxels of a box and a cylinder, each method compared with a simple one.
// The argument is 100 d/dx, ball over voxel; the balls have random places. One item is a ball or, where the
// name says so, a point.
#include <benchmark/benchmark.h>

#include <cmath>
#include <random>
#include <vector>

#include "averaging/deposition/exact_box_deposition.hpp"
#include "averaging/deposition/exact_cylinder_deposition.hpp"
#include "averaging/deposition/sampled_box_deposition.hpp"
#include "averaging/deposition/sampled_cylinder_deposition.hpp"
#include "averaging/overlap/sphere_template.hpp"
#include "averaging/overlap/sphere_triangle.hpp"
#include "meshing/surface/pi.hpp"

namespace millfoam::averaging {
namespace {

BoxGrid box() {
  return BoxGrid({-1, -1, -1}, {1, 1, 1}, {40, 40, 40}, {true, true, true});
}

std::vector<Particle> balls(double diameter) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-1, 1);
  std::vector<Particle> result(4096);
  for (Particle& ball : result) ball = {0, {place(random), place(random), place(random)}, {}, diameter / 2};
  return result;
}

double ratio(const benchmark::State& state) {
  return static_cast<double>(state.range(0)) / 100;
}

void deposit_all(benchmark::State& state, Deposition& deposition, const std::vector<Particle>& all,
                 int items_per_ball = 1) {
  std::vector<Deposit> deposits;
  for (auto _ : state) {
    for (const Particle& ball : all) {
      deposition.deposit(ball, deposits);
      benchmark::DoNotOptimize(deposits.data());
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<long long>(all.size()) * items_per_ball);
}

void box_exact(benchmark::State& state) {
  ExactBoxDeposition deposition(box());
  deposit_all(state, deposition, balls(ratio(state) * box().spacing()[0]));
}
BENCHMARK(box_exact)->Arg(50)->Arg(100)->Arg(200)->Arg(400);

/// A voxel as twelve triangles, as for a cell of a mesh.
double voxel_by_triangles(const BoxGrid& grid, const VoxelIndex& voxel, const Particle& ball) {
  std::array<Eigen::Vector3d, 8> corners;
  for (unsigned c = 0; c < 8; ++c) {
    for (unsigned a = 0; a < 3; ++a) {
      const int plane = voxel[a] + static_cast<int>(c >> a & 1U);
      corners[c][a] = grid.lower()[a] + plane * grid.spacing()[a] - ball.position[a];
    }
  }
  double sum = 0;
  for (const auto& f : {std::array<std::size_t, 4>{0, 4, 6, 2},
                        {1, 3, 7, 5},
                        {0, 1, 5, 4},
                        {2, 6, 7, 3},
                        {0, 2, 3, 1},
                        {4, 5, 7, 6}}) {
    sum += sphere_triangle_volume(corners[f[0]], corners[f[1]], corners[f[2]], ball.radius) +
           sphere_triangle_volume(corners[f[0]], corners[f[2]], corners[f[3]], ball.radius);
  }
  return sum;
}

void box_exact_baseline_voxel_by_voxel(benchmark::State& state) {
  const BoxGrid grid = box();
  const double diameter = ratio(state) * grid.spacing()[0];
  const std::vector<Particle> all = balls(diameter);
  for (auto _ : state) {
    for (const Particle& ball : all) {
      VoxelIndex first{}, last{};
      for (std::size_t a = 0; a < 3; ++a) {
        const double place = (ball.position[a] - grid.lower()[a]) / grid.spacing()[a];
        first[a] = static_cast<int>(std::floor(place - ratio(state) / 2));
        last[a] = static_cast<int>(std::floor(place + ratio(state) / 2));
      }
      for (int k = first[2]; k <= last[2]; ++k) {
        for (int j = first[1]; j <= last[1]; ++j) {
          for (int i = first[0]; i <= last[0]; ++i) {
            benchmark::DoNotOptimize(voxel_by_triangles(grid, {i, j, k}, ball));
          }
        }
      }
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<long long>(all.size()));
}
BENCHMARK(box_exact_baseline_voxel_by_voxel)->Arg(50)->Arg(100)->Arg(200)->Arg(400);

void box_sampling_points(benchmark::State& state) {
  SampledBoxDeposition deposition(box(), 12);
  deposit_all(state, deposition, balls(ratio(state) * box().spacing()[0]), SphereTemplate(12).size());
}
BENCHMARK(box_sampling_points)->Arg(50)->Arg(100)->Arg(200)->Arg(400);

/// Sampling without any table: every point of the template is placed and located.
template <typename Grid>
void locate_each(benchmark::State& state, const Grid& grid, const std::vector<Particle>& all, double radius) {
  const SphereTemplate lattice(12);
  std::vector<Vector3> points;
  for (int n = 0; n < 12 * 12 * 12; ++n) {
    const int i = n % 12, j = n / 12 % 12, k = n / 144;
    if (!lattice.contains(i, j, k)) continue;
    points.push_back({lattice.coordinate(i), lattice.coordinate(j), lattice.coordinate(k)});
  }
  const double part = 4 * pi / 3 * radius * radius * radius / lattice.size();
  std::vector<double> volume(grid.size());
  for (auto _ : state) {
    for (const Particle& ball : all) {
      for (const Vector3& point : points) {
        Vector3 place = ball.position;
        for (std::size_t a = 0; a < 3; ++a) place[a] += radius * point[a];
        if (const auto voxel = grid.locate(place)) volume[grid.offset(*voxel)] += part;
      }
    }
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<long long>(all.size()) * lattice.size());
}

void box_sampling_points_baseline_locate_each(benchmark::State& state) {
  const double diameter = ratio(state) * box().spacing()[0];
  locate_each(state, box(), balls(diameter), diameter / 2);
}
BENCHMARK(box_sampling_points_baseline_locate_each)->Arg(50)->Arg(100)->Arg(200)->Arg(400);

/// Voxels of about the box's size.
CylinderGrid cylinder() {
  return CylinderGrid({0, 1.1}, {-1, 1}, {22, 80, 40}, true);
}

std::vector<Particle> balls_in_cylinder(double diameter) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-1, 1);
  std::vector<Particle> result;
  while (result.size() < 4096) {
    const Vector3 position{place(random), place(random), place(random)};
    if (std::hypot(position[0], position[1]) < 1) result.push_back({0, position, {}, diameter / 2});
  }
  return result;
}

void cylinder_exact(benchmark::State& state) {
  ExactCylinderDeposition deposition(cylinder());
  deposit_all(state, deposition, balls_in_cylinder(ratio(state) * 0.05));
}
BENCHMARK(cylinder_exact)->Arg(50)->Arg(100)->Arg(200);

void cylinder_sampling_points(benchmark::State& state) {
  SampledCylinderDeposition deposition(cylinder(), 12);
  deposit_all(state, deposition, balls_in_cylinder(ratio(state) * 0.05), SphereTemplate(12).size());
}
BENCHMARK(cylinder_sampling_points)->Arg(50)->Arg(100)->Arg(200);

void cylinder_sampling_points_baseline_locate_each(benchmark::State& state) {
  locate_each(state, cylinder(), balls_in_cylinder(ratio(state) * 0.05), ratio(state) * 0.025);
}
BENCHMARK(cylinder_sampling_points_baseline_locate_each)->Arg(50)->Arg(100)->Arg(200);

}  // namespace
}  // namespace millfoam::averaging
