// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/mill_mesh/divisions.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "meshing/mill/mill_shape.hpp"
#include "meshing/mill/opening_circles.hpp"
#include "meshing/mill_mesh/o_grid.hpp"
#include "meshing/surface/pi.hpp"

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

/// Cells that share a side stay within this ratio of lengths across it where numbers of cells can bring it
/// about.
constexpr double wished_ratio = 2.5;

/// A cost above every misfit where cells next to a lifter's corner at its top differ too much in width.
double unevenness(double lifter_cell, double gap_cell) {
  return std::max({lifter_cell / gap_cell, gap_cell / lifter_cell, wished_ratio}) > wished_ratio ? 100 : 0;
}

/// Length of a lifter's side, its rounding by the shell left out, m.
double lifter_side(const Geometry& geometry) {
  const Lifters& lifters = geometry.lifters;
  return std::hypot(lifters.height, (lifters.width - lifters.top_width) / 2);
}

/// Chooses lifter and gap so that all pitches together are a multiple of four.
void divide_pitch(const Geometry& geometry, double cell_size, Divisions& divisions) {
  const int count = geometry.lifters.count;
  const double gap_angle = 2 * pi / count - 2 * lifter_foot_half_angle(geometry);
  const double gap_at_top =
      (2 * pi / count - 2 * lifter_top_half_angle(geometry)) * lifter_corner_radius(geometry);
  const double wished_lifter = geometry.lifters.top_width / cell_size;
  const double wished_gap = gap_angle * geometry.radius() / cell_size;
  const int fewest_gap = static_cast<int>(std::ceil(gap_angle * fewest_around / (2 * pi)));
  const int most_gap = std::max(fewest_gap, rounded(2 * wished_gap)) + 4;
  double least = std::numeric_limits<double>::max();
  for (int lifter = 1; lifter <= rounded(2 * wished_lifter) + 1; ++lifter) {
    for (int gap = fewest_gap; gap <= most_gap; ++gap) {
      const double cost = misfit(lifter, wished_lifter) + misfit(gap, wished_gap) +
                          unevenness(geometry.lifters.top_width / lifter, gap_at_top / gap);
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

/// Layers in each band of the ring that would make cells as thick as they are wide. The core has a quarter of
/// the `around` columns along a side, or, if they are halved, an eighth.
std::vector<double> wished_bands(const Geometry& geometry, int around, bool halved) {
  std::vector<double> circles = opening_circles(geometry);
  circles.push_back(lifter_top_distance(geometry));
  std::vector<double> wished = {halved
                                    ? ring_layers(radius_inside_halving(circles.front(), around), around / 8)
                                    : ring_layers(circles.front(), around / 4)};
  for (std::size_t i = 1; i < circles.size(); ++i) {
    const double width = 2 * pi * (circles[i - 1] + circles[i]) / 2 / around;
    wished.push_back((circles[i] - circles[i - 1]) / width);
  }
  return wished;
}

/// Distributes layers, at least one to each band: the next always to the band with the thickest layers.
std::vector<int> share_out(const std::vector<double>& wished, int layers) {
  std::vector<int> bands(wished.size(), 1);
  assert(layers >= static_cast<int>(bands.size()));
  for (int given = static_cast<int>(bands.size()); given < layers; ++given) {
    std::size_t thickest = 0;
    for (std::size_t i = 1; i < bands.size(); ++i) {
      if (wished[i] / bands[i] > wished[thickest] / bands[thickest]) thickest = i;
    }
    ++bands[thickest];
  }
  return bands;
}

/// Layers of cells that lie upon each other, and the distances, m, that they fill at the thinnest and the
/// thickest place.
struct Layers {
  double least = 0;
  double most = 0;
  int* number = nullptr;
};

/// Adds layers to `layers` where they are too thick compared with the other's.
bool thin_out(const Layers& layers, const Layers& other) {
  const int enough = static_cast<int>(std::ceil(layers.most * *other.number / (wished_ratio * other.least)));
  if (*layers.number >= enough) return false;
  *layers.number = enough;
  return true;
}

/// Adds layers to the bands, and rows next to the lifters, until all that touch are alike.
void even_out(const Geometry& geometry, Divisions& divisions) {
  std::vector<double> circles = opening_circles(geometry);
  circles.push_back(lifter_top_distance(geometry));
  const RingThickness inner = ring_thickness(circles.front());
  std::vector<Layers> all = {{inner.least, inner.most, &divisions.bands.front()}};
  for (std::size_t i = 1; i < circles.size(); ++i) {
    all.push_back({circles[i] - circles[i - 1], circles[i] - circles[i - 1], &divisions.bands[i]});
  }
  if (geometry.lifters.count > 0) {
    all.push_back({lifter_side(geometry), lifter_side(geometry), &divisions.height});
  }
  bool changed = true;
  while (changed) {
    changed = false;
    for (std::size_t i = all.size() - 1; i > 0; --i) {
      changed = thin_out(all[i], all[i - 1]) || changed;
      changed = thin_out(all[i - 1], all[i]) || changed;
    }
  }
}

}  // namespace

Divisions choose_divisions(const Geometry& geometry, double cell_size) {
  assert(cell_size > 0);
  Divisions divisions;
  int around = 4 * std::max(fewest_around / 4, rounded(pi / 2 * geometry.radius() / cell_size));
  if (geometry.lifters.count > 0) {
    divide_pitch(geometry, cell_size, divisions);
    divisions.height = rounded(lifter_side(geometry) / cell_size);
    around = geometry.lifters.count * (divisions.lifter + divisions.gap);
  }
  divisions.core = around / 4;
  for (double wished : wished_bands(geometry, around, false)) divisions.bands.push_back(rounded(wished));
  even_out(geometry, divisions);
  return divisions;
}

Divisions given_divisions(const Geometry& geometry, const BlockCounts& counts) {
  const int around = std::max(1, geometry.lifters.count) * (counts.lifter + counts.gap);
  assert(around % 4 == 0);
  Divisions divisions;
  if (geometry.lifters.count > 0) {
    divisions.lifter = counts.lifter;
    divisions.gap = counts.gap;
    divisions.height = counts.height;
  }
  divisions.halved = counts.halved;
  divisions.core = around / (counts.halved ? 8 : 4);
  divisions.bands = share_out(wished_bands(geometry, around, counts.halved), counts.ring);
  return divisions;
}

}  // namespace millfoam::meshing
