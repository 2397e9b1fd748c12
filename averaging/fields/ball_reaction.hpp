// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "averaging/files/slurry_reader.hpp"
#include "averaging/grids/box_grid.hpp"
#include "averaging/grids/field_sampling.hpp"
#include "averaging/values/solids_window.hpp"
#include "averaging/values/vector3.hpp"

namespace millfoam::averaging {

/// The force of a flow's cells on balls, brought back to the voxels from which the cells have their solids: a
/// cell's force goes to its voxels by their shares of its solids. So the force on all balls of the voxels is
/// that of all cells, to round-off, and its drag too, because the cells' solids have the voxels' velocity by
/// the same shares.
class BallReaction {
 public:
  /// @param voxels  of the grid of the balls' averages
  explicit BallReaction(std::size_t voxels) : sums_(voxels * columns, 0.0) {}

  /// Adds a point of a cell.
  /// @param shares  of the voxels in the solids at the point
  /// @param volume  that these solids are the shares of, m^3: their sum times this is the solids' volume
  /// @param pressure  force of the pressure on their volume, N/m^3
  /// @param exchange  K, kg/(m^3 s)
  /// @param velocity  of the fluid, m/s
  void add(const std::array<SolidsShare, 8>& shares, double volume, const Vector3& pressure, double exchange,
           const Vector3& velocity);

  /// The sums, to be added up over ranks entry by entry.
  std::vector<double>& sums() { return sums_; }

  /// What balls of the voxels feel over their volume. Voxels without solids, and without any cell, have
  /// inside 0.
  /// @param grid  of the voxels
  /// @param window  the balls' averages from which the shares are
  BallFields fields(const BoxGrid& grid, const SolidsWindow& window) const;

 private:
  /// Volume of solids, force of the pressure, exchange, and exchange times the fluid's velocity.
  enum Column : std::size_t { solids, pressure, exchange = pressure + 3, driven, columns = driven + 3 };

  std::vector<double> sums_;  ///< [voxels][columns]
};

}  // namespace millfoam::averaging
