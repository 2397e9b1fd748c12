// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "averaging/statistics/window_moments.hpp"
#include "averaging/values/solids_window.hpp"

namespace millfoam::averaging {

/// A cell of which less than this share lies inside the mill cannot have a solidity: what balls
/// reach into it, by their overlap with the wall, belongs to its neighbours.
inline constexpr double smallest_inside_fraction = 0.01;

/// What limits the solids of cells: walls that cut them and a largest solidity.
struct CellLimits {
  std::vector<double> whole_volumes;           ///< [n] of the cells, m^3; empty unless walls cut the cells
  std::vector<std::array<int, 2>> neighbours;  ///< pairs that share a face, see `redistribute_excess`
  std::optional<double> solidity_cap;          ///< largest solidity that may stay in a cell
  /// Where a cell is, for messages; without it the cell's number is named.
  std::function<std::string(std::size_t cell)> place = nullptr;
};

/// The averages over the records k = 1 ... K of a window. With phi_k and u_k the solidity and the mean
/// particle velocity of record k, and W the cell's volume inside the mill:
///
///     solidity                phi = sum V / sum W
///     velocity                u = sum V v / sum V
///     diameter, diameter43    d32 = sum V / sum (V/d),  d43 = sum (V d) / sum V
///     number                  sum over particles of their part in the cell, / K
///     solidity_deviation      sqrt(sum_k (phi_k - mean phi_k)^2 / K)
///     velocity_deviation      sqrt(sum_k V_k (u_k - u)^2 / sum_k V_k), per component
///     granular_temperature    sum V |v - u|^2 / (3 sum V)
///     inside_fraction         sum W / (K whole volume), where walls cut the cells
///
/// The temperature is about the window's mean velocity, so it holds the motion of single balls and the drift
/// of the mean within the window; the drift's part is the mean square of velocity_deviation's components.
///
/// V_k is the volume of balls in the cell in record k. Cells with a share of 1e-100 or less are empty. Cells
/// of which less than `smallest_inside_fraction` is inside are emptied into their neighbours
/// (`redistribute_from_walls`), and what is above a cap on solidity moves to neighbours
/// (`redistribute_excess`), with its momentum and all else that the means are made of; both are counted in
/// the ledger's `clipped`. Deviations are those before anything moved.
///
/// The moments must hold a record. `time.records` is filled in, the window's times are the caller's.
/// Throws NoRoomError that names the cell by `CellLimits::place`, its solidity and what helps.
WindowAverage average(const WindowMoments& moments, const CellLimits& limits);

}  // namespace millfoam::averaging
