// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/statistics/window_average.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <sstream>

#include "averaging/statistics/redistribution.hpp"

namespace millfoam::averaging {

namespace {

using Columns = RecordSums;

/// Of the tails of smoothing, less than this share of a cell is nothing: quotients of numbers near the
/// smallest that a computer knows are no diameters and velocities.
constexpr double least_share = 1e-100;

/// Means over the records: [n][columns] extensive quantities and [n] volumes inside the mill, m^3.
struct Means {
  std::vector<double> values;
  std::vector<double> inside_volumes;

  double at(std::size_t cell, std::size_t column) const { return values[cell * Columns::columns + column]; }
};

Means means(const WindowMoments& moments) {
  const auto records = static_cast<double>(moments.records());
  Means result;
  for (std::size_t c = 0; c < moments.cells(); ++c) {
    for (std::size_t column = 0; column < Columns::columns; ++column) {
      result.values.push_back(moments.sum(c, column) / records);
    }
    result.inside_volumes.push_back(moments.cell_volume(c) / records);
  }
  return result;
}

/// Takes the solids out of cells within walls, whose volume inside becomes 0, and what is above the cap out
/// of others.
void redistribute(const CellLimits& limits, Means& mean, Ledger& ledger) {
  if (!limits.whole_volumes.empty()) {
    for (std::size_t c = 0; c < mean.inside_volumes.size(); ++c) {
      if (mean.inside_volumes[c] < smallest_inside_fraction * limits.whole_volumes[c])
        mean.inside_volumes[c] = 0;
    }
    const Redistributed walls =
        redistribute_from_walls(mean.values, Columns::columns, mean.inside_volumes, limits.neighbours);
    ledger.clipped += walls.moved;
    ledger.deposited -= walls.lost;
    ledger.outside += walls.lost;
  }
  if (!limits.solidity_cap) return;
  std::vector<double> capacities(mean.inside_volumes.size());
  std::transform(mean.inside_volumes.begin(), mean.inside_volumes.end(), capacities.begin(),
                 [&](double volume) { return *limits.solidity_cap * volume; });
  try {
    ledger.clipped += redistribute_excess(mean.values, Columns::columns, capacities, limits.neighbours);
  } catch (const NoRoomError& error) {
    if (!limits.place) throw;
    constexpr double full = 1 - 1e-9;  // to round-off
    const double solidity = error.excess * *limits.solidity_cap;
    std::ostringstream message;
    message << "the solidity " << solidity << " of " << limits.place(error.cell) << " is above the cap of "
            << *limits.solidity_cap << ", and no cell that its solids can reach has room for them; expected "
            << (solidity < full ? "a larger --cap" : "coarser cells, or balls that do not overlap");
    throw NoRoomError(message.str(), error.cell, error.excess);
  }
}

void fill_means(const Means& mean, WindowAverage& result) {
  SolidsWindow& fields = result.mean;
  for (std::size_t c = 0; c < mean.inside_volumes.size(); ++c) {
    const double volume = mean.at(c, Columns::volume);
    if (!(volume > least_share * mean.inside_volumes[c])) continue;
    fields.solidity[c] = volume / mean.inside_volumes[c];
    fields.diameter[c] = volume / mean.at(c, Columns::volume_over_diameter);
    fields.diameter43[c] = mean.at(c, Columns::volume_times_diameter) / volume;
    result.number[c] = mean.at(c, Columns::balls);
    double speed2 = 0;
    for (std::size_t a = 0; a < 3; ++a) {
      const double u = mean.at(c, Columns::momentum + a) / volume;
      fields.velocity[3 * c + a] = u;
      speed2 += u * u;
    }
    const double mean_square = mean.at(c, Columns::volume_times_speed2) / volume;
    // Equal velocities leave a difference of round-off, which must not become negative.
    result.granular_temperature[c] = std::max(0.0, (mean_square - speed2) / 3);
  }
}

}  // namespace

WindowAverage average(const WindowMoments& moments, const CellLimits& limits) {
  assert(moments.records() > 0);
  const auto records = static_cast<double>(moments.records());
  const std::size_t n = moments.cells();
  WindowAverage result;
  result.time.records = moments.records();
  const Ledger total = moments.ledger();
  result.ledger = {total.volume_in / records, total.deposited / records, total.outside / records, 0};

  if (moments.occupied() > 0) result.balls_per_cell = moments.balls() / moments.occupied();
  Means mean = means(moments);
  redistribute(limits, mean, result.ledger);
  for (std::vector<double>* field :
       {&result.mean.solidity, &result.mean.diameter, &result.mean.diameter43, &result.number,
        &result.granular_temperature, &result.solidity_deviation}) {
    field->assign(n, 0.0);
  }
  result.mean.velocity.assign(3 * n, 0.0);
  result.velocity_deviation.assign(3 * n, 0.0);
  fill_means(mean, result);
  for (std::size_t c = 0; c < n; ++c) {
    if (!limits.whole_volumes.empty()) {
      // Round-off of the clipped triangles must not make a whole voxel more than whole.
      const double inside = moments.cell_volume(c) / records;
      result.mean.inside_fraction.push_back(std::clamp(inside / limits.whole_volumes[c], 0.0, 1.0));
    }
    if (result.mean.solidity[c] == 0) continue;
    result.solidity_deviation[c] = std::sqrt(moments.solidity_variance(c));
    for (std::size_t a = 0; a < 3; ++a) {
      result.velocity_deviation[3 * c + a] = std::sqrt(moments.velocity_variance(c, a));
    }
  }
  return result;
}

}  // namespace millfoam::averaging
