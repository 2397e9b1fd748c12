// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/run/grid_check.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <sstream>

#include "averaging/run/named_record.hpp"
#include "averaging/statistics/window_average.hpp"

namespace millfoam::averaging {

namespace {

/// A box about points, m.
struct Extent {
  Vector3 lower{std::numeric_limits<double>::max(), std::numeric_limits<double>::max(),
                std::numeric_limits<double>::max()};
  Vector3 upper{std::numeric_limits<double>::lowest(), std::numeric_limits<double>::lowest(),
                std::numeric_limits<double>::lowest()};

  void add(const double* point, double radius) {
    for (std::size_t i = 0; i < 3; ++i) {
      lower[i] = std::min(lower[i], point[i] - radius);
      upper[i] = std::max(upper[i], point[i] + radius);
    }
  }

  std::string in_words() const {
    std::ostringstream text;
    text.precision(4);
    for (std::size_t i = 0; i < 3; ++i) {
      text << (i == 0 ? "" : ", ") << "xyz"[i] << ' ' << lower[i] << " to " << upper[i];
    }
    return text.str() + " m";
  }
};

std::string extent_in_words(const BoxGrid& grid) {
  return Extent{grid.lower(), grid.upper()}.in_words();
}

std::string extent_in_words(const CylinderGrid& grid) {
  std::ostringstream text;
  text.precision(4);
  text << "r " << grid.radii()[0] << " to " << grid.radii()[1] << ", z " << grid.ends()[0] << " to "
       << grid.ends()[1] << " m";
  return text.str();
}

std::string extent_in_words(const MeshCells& mesh) {
  Extent extent;
  for (std::size_t p = 0; p + 2 < mesh.points.size(); p += 3) extent.add(&mesh.points[p], 0);
  return extent.in_words();
}

std::string extents(const Grid& grid, const std::string& balls) {
  return "the grid spans " + std::visit([](const auto& kind) { return extent_in_words(kind); }, grid) +
         (balls.empty() ? "" : ", the balls " + balls) + "; expected metres";
}

std::string extents(const ParticleRecord& record) {
  Extent balls;
  for (const Particle& ball : record.particles) balls.add(ball.position.data(), ball.radius);
  return balls.in_words();
}

double grid_volume(const Grid& grid) {
  double volume = 0;
  for (std::size_t c = 0; c < cell_count(grid); ++c) volume += cell_volume(grid, c);
  return volume;
}

/// @param balls  their extents in words; empty: not known
std::string misfit_in_words(const CellSetup& setup, const Ledger& ledger, const std::string& balls,
                            const std::string& name, double largest_outside) {
  if (!(ledger.volume_in > 0)) return {};
  std::ostringstream text;
  text.precision(3);
  text << name << ": ";
  if (ledger.outside > largest_outside * ledger.volume_in) {
    text << 100 * ledger.outside / ledger.volume_in << " % of the balls' volume lies outside the grid"
         << (setup.walls ? " or the walls: " : ": ") << extents(setup.grid, balls)
         << ". To average only a part of the balls, give --tolerance SHARE";
    return text.str();
  }
  const double fill = ledger.volume_in / grid_volume(setup.grid);
  if (fill >= smallest_fill) return {};
  text << "the balls fill only " << fill
       << " of the grid, which is far too large for them: " << extents(setup.grid, balls);
  return text.str();
}

/// Ledger of a record where balls beyond the walls are outside, too.
Ledger within_walls(const CellSetup& setup, const RecordSums& sums) {
  if (!setup.walls) return sums.ledger;
  WindowMoments moments(cell_count(setup.grid));
  moments.add(sums);
  CellLimits limits = setup.limits;
  limits.solidity_cap.reset();  // one record alone may exceed it
  return average(moments, limits).ledger;
}

}  // namespace

std::string misfit(const CellSetup& setup, const ParticleRecord& record, double time, const std::string& name,
                   double largest_outside) {
  RecordSums sums;
  naming_record(name, [&] { sum_record(*setup.deposition->clone(), record, time, sums); });
  if (setup.walls) sums.cell_volumes = setup.walls->inside_volumes(time);
  return misfit_in_words(setup, within_walls(setup, sums), extents(record), name, largest_outside);
}

std::string misfit(const CellSetup& setup, const RecordSums& sums, const std::string& name,
                   double largest_outside) {
  return misfit_in_words(setup, within_walls(setup, sums), "", name, largest_outside);
}

}  // namespace millfoam::averaging
