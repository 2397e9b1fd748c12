// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "averaging/files/solids_file.hpp"

namespace millfoam::averaging {

/// Fewest balls in the averaging volumes from which the drag laws were derived.
inline constexpr double fewest_balls = 8;
/// Most balls in them.
inline constexpr double most_balls = 64;
/// Share of the balls' volume beyond the grid from which on a summary warns.
inline constexpr double noted_outside = 0.01;
/// Share of the balls' volume in cells outside of the walls from which a warning is given.
inline constexpr double noted_clipped = 0.01;
/// Walls that cut no cell are in another unit of length if they are so many times as wide as the grid.
inline constexpr double widest_walls = 1.2;

/// What a user should know of a window before trusting it.
struct WindowSummary {
  TimeWindow time;                 ///< begin and end, s, and records
  Ledger ledger;                   ///< means over the records, m^3
  double balls_per_cell = 0;       ///< mean number of balls in an occupied cell
  std::size_t occupied_cells = 0;  ///< of `least_solidity` or more
  std::size_t small_cells = 0;     ///< of the occupied ones: smaller than a ball of their Sauter diameter
  double occupied_volume = 0;      ///< of the occupied cells, m^3
  double ball_density = 0;         ///< balls of the Sauter diameter per volume of the occupied cells, 1/m^3
  double mean_solidity = 0;        ///< over the occupied cells
  double largest_solidity = 0;     ///< of any cell
  std::size_t cut_cells = 0;       ///< that do not lie wholly inside the walls; 0 without walls
};

/// A solids file in numbers.
struct SolidsSummary {
  std::filesystem::path file;  ///< the solids file
  SolidsHeader header;         ///< what holds for all windows
  std::string grid;            ///< kind: box, cylinder or cells
  std::vector<std::size_t>
      shape;  ///< nx ny nz of a box, nr ntheta nz of a cylinder, number of cells of a mesh
  std::vector<WindowSummary> windows;  ///< in order of time
};

/// A sentence on what the numbers of a solids file call for.
struct Remark {
  bool warning = false;  ///< a flow through these solids fails or is wrong; else advice
  std::string sentence;  ///< for the user
};

/// The numbers of one window.
/// @param grid            that its fields live on
/// @param time            of the window
/// @param ledger          of the window, m^3
/// @param balls_per_cell  mean number of balls in an occupied cell
/// @param fields          over the cells of `grid`
WindowSummary summarise(const Grid& grid, const TimeWindow& time, const Ledger& ledger, double balls_per_cell,
                        const SolidsWindow& fields);

/// A summary that has no windows yet.
SolidsSummary begin_summary(const std::filesystem::path& file, const SolidsHeader& header, const Grid& grid);

/// Reads a solids file through. Throws SolidsFileError.
SolidsSummary summarise(const std::filesystem::path& file);

/// The times and ledgers of a solids file's windows, without what follows from its fields. Throws
/// SolidsFileError.
SolidsSummary read_ledgers(const std::filesystem::path& file);

/// The largest share of a window's volume_in that is a part of its ledger, 0 to 1.
double largest_share(const SolidsSummary& summary, double Ledger::*part);

/// Of all windows together; its time and ledger are left empty.
WindowSummary overall(const SolidsSummary& summary);

/// Advice and warnings where the numbers call for them.
std::vector<Remark> remarks(const SolidsSummary& summary);

/// The ledger window by window, the summary, and advice where the numbers call for it.
std::string report(const SolidsSummary& summary);

/// A sentence for each window whose ledger does not balance, or of whose particle volume a share above
/// `tolerance` lies outside the grid or was moved by the cap; empty when all is well.
std::vector<std::string> ledger_failures(const SolidsSummary& summary, double tolerance);

}  // namespace millfoam::averaging
