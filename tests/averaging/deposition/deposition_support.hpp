// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "averaging/deposition/deposition.hpp"
#include "averaging/overlap/sphere_template.hpp"
#include "tests/averaging/test_support.hpp"

namespace millfoam::averaging {

/// What a ball gives to each cell.
inline std::vector<double> deposited(Deposition& deposition, const Particle& ball) {
  std::vector<double> cells(deposition.volumes().size());
  std::vector<Deposit> deposits;
  deposition.deposit(ball, deposits);
  for (const Deposit& deposit : deposits) cells[deposit.cell] += deposit.volume;
  return cells;
}

inline std::vector<double> deposited(Deposition& deposition, const Particle& ball,
                                     const Superquadric& shape) {
  std::vector<double> cells(deposition.volumes().size());
  std::vector<Deposit> deposits;
  deposition.deposit(ball, shape, deposits);
  for (const Deposit& deposit : deposits) cells[deposit.cell] += deposit.volume;
  return cells;
}

inline double sum(const std::vector<double>& values) {
  double total = 0;
  for (const double value : values) total += value;
  return total;
}

/// Balls with centres in a cube about the origin.
inline std::vector<Particle> random_balls(int count, double reach, double largest_radius, unsigned seed = 7) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-reach, reach), radius(0.01 * largest_radius, largest_radius);
  std::vector<Particle> balls;
  for (int p = 0; p < count; ++p) {
    const Vector3 position{place(random), place(random), place(random)};
    balls.push_back({p + 1, position, {}, radius(random)});
  }
  return balls;
}

/// What a ball gives to each voxel when every point of its template is placed and located.
template <typename Grid>
std::vector<double> by_visiting(const Grid& grid, const SphereTemplate& points, const Particle& ball) {
  std::vector<double> visited(grid.size());
  const int n = points.points_per_diameter();
  for (int k = 0; k < n * n * n; ++k) {
    const std::array<int, 3> layer{k % n, k / n % n, k / (n * n)};
    if (!points.contains(layer[0], layer[1], layer[2])) continue;
    Vector3 point = grid.wrapped(ball.position);
    for (std::size_t a = 0; a < 3; ++a) point[a] += ball.radius * points.coordinate(layer[a]);
    if (const auto voxel = grid.locate(point)) {
      visited[grid.offset(*voxel)] += sphere_volume(ball.radius) / points.size();
    }
  }
  return visited;
}

/// Between two ways to deposit, over the cells that `exact` gives something, in volumes of the ball.
inline double root_mean_square_difference(Deposition& exact, Deposition& other,
                                          const std::vector<Particle>& balls) {
  double squares = 0;
  int count = 0;
  for (const Particle& ball : balls) {
    const std::vector<double> a = deposited(exact, ball), b = deposited(other, ball);
    for (std::size_t v = 0; v < a.size(); ++v) {
      if (a[v] == 0) continue;
      squares += std::pow((a[v] - b[v]) / sphere_volume(ball.radius), 2);
      ++count;
    }
  }
  return std::sqrt(squares / count);
}

}  // namespace millfoam::averaging
