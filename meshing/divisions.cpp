// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/divisions.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "meshing/mill_shape.hpp"
#include "meshing/o_grid.hpp"
#include "meshing/pi.hpp"

namespace millfoam::meshing {
namespace {

/// Cells around a smooth drum are at least this many.
constexpr int fewest_around = 40;

int rounded(double cells) {
  return std::max(1, static_cast<int>(std::lround(cells)));
}

/// How far a number of cells is from the wished one, the same for twice and for half.
double misfit(int cells, double wished) {
  return std::pow(std::log(cells / wished), 2);
}

/// Chooses lifter and gap so that all pitches together are a multiple of four.
void divide_pitch(const Geometry& geometry, double cell_size, Divisions& divisions) {
  const int count = geometry.lifters.count;
  const double gap_angle = 2 * pi / count - 2 * lifter_foot_half_angle(geometry);
  const double wished_lifter = geometry.lifters.width / cell_size;
  const double wished_gap = gap_angle * geometry.radius() / cell_size;
  const int fewest_gap = static_cast<int>(std::ceil(gap_angle * fewest_around / (2 * pi)));
  const int most_gap = std::max(fewest_gap, rounded(2 * wished_gap)) + 4;
  double least = std::numeric_limits<double>::max();
  for (int lifter = 1; lifter <= rounded(2 * wished_lifter) + 1; ++lifter) {
    for (int gap = fewest_gap; gap <= most_gap; ++gap) {
      const double cost = misfit(lifter, wished_lifter) + misfit(gap, wished_gap);
      const int around = count * (lifter + gap);
      if (around % 4 == 0 && around >= 8 && cost < least) {
        least = cost;
        divisions.lifter = lifter;
        divisions.gap = gap;
      }
    }
  }
  assert(divisions.gap > 0);
}

}  // namespace

Divisions choose_divisions(const Geometry& geometry, double cell_size) {
  Divisions divisions;
  int around = 4 * std::max(fewest_around / 4, rounded(pi / 2 * geometry.radius() / cell_size));
  if (geometry.lifters.count > 0) {
    divide_pitch(geometry, cell_size, divisions);
    divisions.height = rounded(geometry.lifters.height / cell_size);
    around = geometry.lifters.count * (divisions.lifter + divisions.gap);
  }
  divisions.core = around / 4;
  divisions.ring = ring_layers(geometry.radius() - geometry.lifters.height, divisions.core);
  return divisions;
}

}  // namespace millfoam::meshing
