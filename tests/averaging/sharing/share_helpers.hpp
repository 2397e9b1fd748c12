// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <random>
#include <vector>

#include "averaging/sharing/cell_sharing.hpp"
#include "tests/averaging/test_support.hpp"

namespace millfoam::averaging {

/// What a ball gives to each cell.
inline std::vector<double> shared(CellSharing& sharing, const Particle& ball) {
  std::vector<double> cells(sharing.volumes().size());
  std::vector<Share> shares;
  sharing.share(ball, shares);
  for (const Share& share : shares) cells[share.cell] += share.volume;
  return cells;
}

inline std::vector<double> shared(CellSharing& sharing, const Particle& ball, const Superquadric& shape) {
  std::vector<double> cells(sharing.volumes().size());
  std::vector<Share> shares;
  sharing.share(ball, shape, shares);
  for (const Share& share : shares) cells[share.cell] += share.volume;
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

}  // namespace millfoam::averaging
