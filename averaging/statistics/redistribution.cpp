// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/statistics/redistribution.hpp"

#include <algorithm>
#include <cassert>
#include <sstream>

namespace millfoam::averaging {

namespace {

/// The neighbours of cells, and a walk outwards from a cell.
class Rings {
 public:
  Rings(std::size_t cells, const std::vector<std::array<int, 2>>& neighbours)
      : begin_(cells + 1, 0), seen_(cells, 0) {
    for (const auto& pair : neighbours) {
      for (const int cell : pair) ++begin_[static_cast<std::size_t>(cell) + 1];
    }
    for (std::size_t c = 0; c < cells; ++c) begin_[c + 1] += begin_[c];
    others_.resize(begin_.back());
    std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
    for (const auto& [a, b] : neighbours) {
      others_[next[static_cast<std::size_t>(a)]++] = static_cast<std::size_t>(b);
      others_[next[static_cast<std::size_t>(b)]++] = static_cast<std::size_t>(a);
    }
  }

  /// The cells one face further from the cell than the ring before; the first ring is the cell itself.
  std::vector<std::size_t> start(std::size_t cell) {
    seen_[cell] = ++walk_;
    return {cell};
  }
  std::vector<std::size_t> next(const std::vector<std::size_t>& ring) {
    std::vector<std::size_t> result;
    for (const std::size_t cell : ring) {
      for (std::size_t n = begin_[cell]; n < begin_[cell + 1]; ++n) {
        if (seen_[others_[n]] == walk_) continue;
        seen_[others_[n]] = walk_;
        result.push_back(others_[n]);
      }
    }
    return result;
  }

 private:
  std::vector<std::size_t> begin_;
  std::vector<std::size_t> others_;
  std::vector<std::size_t> seen_;
  std::size_t walk_ = 0;
};

/// Moves the volume above a cell's capacity into the nearest rings with free volume.
void move_from(std::size_t cell, double excess, std::size_t columns, const std::vector<double>& capacities,
               Rings& rings, std::vector<double>& values) {
  const double volume = values[cell * columns];
  // What travels along, per volume: of the cell as it is before anything leaves it.
  const std::vector<double> per_volume = [&] {
    std::vector<double> result(columns);
    for (std::size_t k = 0; k < columns; ++k) result[k] = values[cell * columns + k] / volume;
    return result;
  }();
  const auto free_volume = [&](std::size_t c) { return std::max(0.0, capacities[c] - values[c * columns]); };
  double left = excess;
  for (auto ring = rings.next(rings.start(cell)); left > 0; ring = rings.next(ring)) {
    if (ring.empty()) {
      std::ostringstream message;
      message << left << " m3 of the solids in cell " << cell << " are above the cap of " << capacities[cell]
              << " m3 and no cell that they can reach has room for them; expected a larger cap";
      throw NoRoomError(message.str(), cell, volume / capacities[cell]);
    }
    double free = 0;
    for (const std::size_t c : ring) free += free_volume(c);
    if (free == 0) continue;
    const double moved = std::min(left, free);
    for (const std::size_t c : ring) {
      const double part = moved * (free_volume(c) / free);
      for (std::size_t k = 0; k < columns; ++k) values[c * columns + k] += part * per_volume[k];
    }
    left = moved == left ? 0 : left - moved;
  }
  for (std::size_t k = 0; k < columns; ++k) values[cell * columns + k] -= excess * per_volume[k];
}

}  // namespace

double redistribute_excess(std::vector<double>& values, std::size_t columns,
                           const std::vector<double>& capacities,
                           const std::vector<std::array<int, 2>>& neighbours) {
  assert(values.size() == capacities.size() * columns);
  Rings rings(capacities.size(), neighbours);
  double moved = 0;
  for (std::size_t cell = 0; cell < capacities.size(); ++cell) {
    const double excess = values[cell * columns] - capacities[cell];
    // Full cells are filled to round-off of their capacity, which is not an excess.
    if (!(excess > 1e-12 * capacities[cell])) continue;
    move_from(cell, excess, columns, capacities, rings, values);
    moved += excess;
  }
  return moved;
}

Redistributed redistribute_from_walls(std::vector<double>& values, std::size_t columns,
                                      const std::vector<double>& inside_volumes,
                                      const std::vector<std::array<int, 2>>& neighbours) {
  assert(values.size() == inside_volumes.size() * columns);
  constexpr int furthest = 3;
  Rings rings(inside_volumes.size(), neighbours);
  Redistributed result;
  for (std::size_t cell = 0; cell < inside_volumes.size(); ++cell) {
    double* const own = &values[cell * columns];
    if (inside_volumes[cell] > 0 || own[0] == 0) continue;
    double taken = 0;
    auto ring = rings.start(cell);
    for (int n = 0; n < furthest && taken == 0; ++n) {
      ring = rings.next(ring);
      for (const std::size_t other : ring) taken += inside_volumes[other];
    }
    (taken > 0 ? result.moved : result.lost) += own[0];
    for (const std::size_t other : ring) {
      const double part = taken > 0 ? inside_volumes[other] / taken : 0;
      for (std::size_t k = 0; k < columns; ++k) values[other * columns + k] += part * own[k];
    }
    std::fill_n(own, columns, 0.0);
  }
  return result;
}

}  // namespace millfoam::averaging
