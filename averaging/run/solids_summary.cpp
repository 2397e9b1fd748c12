// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/run/solids_summary.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "meshing/surface/pi.hpp"

namespace millfoam::averaging {

namespace {

/// The densest packing of equal spheres.
constexpr double densest = 0.74;

template <typename... Arguments>
std::string formatted(const char* format, Arguments... arguments) {
  char line[300];
  std::snprintf(line, sizeof line, format, arguments...);
  return line;
}

double share(double part, double whole) {
  return whole > 0 ? part / whole : 0;
}

std::string ledger_row(std::size_t number, const WindowSummary& window) {
  const Ledger& ledger = window.ledger;
  const std::string marks = std::string(window.time.starts_late ? "  starts late" : "") +
                            (window.time.ends_short ? "  ends short" : "");
  return formatted("%6zu %10g %10g %8lld %14.6e %12.4f %12.4f %12.4f%s\n", number, window.time.begin,
                   window.time.end, window.time.records, ledger.volume_in,
                   100 * share(ledger.deposited, ledger.volume_in),
                   100 * share(ledger.outside, ledger.volume_in),
                   100 * share(ledger.clipped, ledger.volume_in), marks.c_str());
}

/// The volume over which fields are averaged: a cell or, when they are smoothed over a width b and that is
/// more, the space that the kernel exp(-r^2/b^2) fills, pi^(3/2) b^3.
double averaging_volume(const WindowSummary& all, double smoothing) {
  const double cell = all.occupied_volume / static_cast<double>(all.occupied_cells);
  return std::max(cell, std::pow(pi, 1.5) * smoothing * smoothing * smoothing);
}

/// What the laws of drag need of an averaging volume, where it is missed, and what to change.
std::vector<Remark> size_advice(const WindowSummary& all, double smoothing) {
  std::vector<Remark> found;
  const double per_volume = all.ball_density * averaging_volume(all, smoothing);
  const double edge = std::cbrt(fewest_balls / all.ball_density);
  if (per_volume < fewest_balls) {
    found.push_back(
        {false, formatted("%.2g balls in an averaging volume; the drag laws were derived from %g to "
                          "%g: take cells of %.2g m or more (on a mesh: --smooth %.2g)",
                          per_volume, fewest_balls, most_balls, edge, edge / std::sqrt(pi))});
  } else if (per_volume > most_balls) {
    found.push_back(
        {false, formatted("%.2g balls in an averaging volume; the drag laws were derived from %g to "
                          "%g: cells down to %.2g m (on a mesh: --smooth %.2g) would show more",
                          per_volume, fewest_balls, most_balls, edge, edge / std::sqrt(pi))});
  }
  if (all.small_cells > 0 && smoothing == 0) {
    found.push_back(
        {false,
         formatted("%.1f %% of the occupied cells are smaller than a ball: coarser cells, or a mesh "
                   "with --smooth of 2 to 3 diameters, give fields for which drag laws hold",
                   100 * static_cast<double>(all.small_cells) / static_cast<double>(all.occupied_cells))});
  }
  return found;
}

void remark_on_solidity(double largest, std::vector<Remark>& found) {
  if (largest >= 1) {
    found.push_back(
        {true,
         "the largest solidity leaves no room for the fluid, and a flow will refuse it: take cells "
         "larger than the balls, or --cap"});
  } else if (largest > densest) {
    found.push_back({false, formatted("the largest solidity is above that of the densest packing of equal "
                                      "spheres, %g: the cells are small for the balls, or the balls overlap",
                                      densest)});
  }
}

void remark_on_outside(const SolidsSummary& summary, std::vector<Remark>& found) {
  const double outside = largest_share(summary, &Ledger::outside);
  if (outside < noted_outside) return;
  found.push_back(
      {true, formatted("%.3g %% of the balls' volume lies outside the grid: these balls are in none "
                       "of these fields",
                       100 * outside)});
}

/// Walls between balls and grid cut cells that hold balls: what is in no cell then moves to others.
void remark_on_clipped(const SolidsSummary& summary, std::vector<Remark>& found) {
  const double clipped = largest_share(summary, &Ledger::clipped);
  if (summary.header.solidity_cap || clipped < noted_clipped) return;
  found.push_back(
      {true, formatted("%.3g %% of the balls' volume was moved out of cells outside of the walls: "
                       "expected walls that enclose the balls on the whole grid",
                       100 * clipped)});
}

void remark_on_walls(const SolidsSummary& summary, std::size_t cut_cells, std::vector<Remark>& found) {
  const double wider = summary.header.walls_over_grid.value_or(0);
  if (cut_cells > 0 || wider <= widest_walls) return;
  found.push_back(
      {true, formatted("the walls cut no cell: all lie inside, and the walls are %.3g times as wide "
                       "as the grid; expected walls and grid in m",
                       wider)});
}

/// A window in words where records are missing in it; otherwise empty.
std::string missing_in_words(std::size_t number, const TimeWindow& time) {
  const bool fewer = time.records < time.expected;
  if (!fewer && !time.starts_late && !time.ends_short) return {};
  std::string words =
      formatted("window %zu from %g to %g s has %lld", number, time.begin, time.end, time.records);
  if (time.expected > 0) words += formatted(" of %lld", time.expected);
  words += " records";
  if (time.starts_late) words += ", starts late";
  if (time.ends_short) words += ", ends short";
  return words;
}

void remark_on_records(const SolidsSummary& summary, std::vector<Remark>& found) {
  std::size_t windows = 0;
  std::string first;
  for (std::size_t w = 0; w < summary.windows.size(); ++w) {
    const std::string words = missing_in_words(w, summary.windows[w].time);
    if (!words.empty() && windows++ == 0) first = words;
  }
  if (windows == 0) return;
  found.push_back(
      {true, formatted("records are missing in %zu of %zu windows: ", windows, summary.windows.size()) +
                 first + (windows > 1 ? ", …" : "")});
}

const char* kind_of(const BoxGrid&) {
  return "box";
}
const char* kind_of(const CylinderGrid&) {
  return "cylinder";
}
const char* kind_of(const MeshCells&) {
  return "cells";
}

}  // namespace

WindowSummary summarise(const Grid& grid, const TimeWindow& time, const Ledger& ledger, double balls_per_cell,
                        const SolidsWindow& fields) {
  WindowSummary summary;
  summary.time = time;
  summary.ledger = ledger;
  summary.balls_per_cell = balls_per_cell;
  double balls = 0;
  for (std::size_t c = 0; c < fields.solidity.size(); ++c) {
    if (fields.solidity[c] < least_solidity) continue;
    const double d = fields.diameter[c], volume = cell_volume(grid, c);
    ++summary.occupied_cells;
    summary.occupied_volume += volume;
    summary.mean_solidity += fields.solidity[c];
    summary.largest_solidity = std::max(summary.largest_solidity, fields.solidity[c]);
    if (volume < pi / 6 * d * d * d) ++summary.small_cells;
    balls += fields.solidity[c] * volume / (pi / 6 * d * d * d);
  }
  constexpr double whole = 1 - 1e-9;
  summary.cut_cells =
      static_cast<std::size_t>(std::count_if(fields.inside_fraction.begin(), fields.inside_fraction.end(),
                                             [](double share) { return share < whole; }));
  if (summary.occupied_cells > 0) {
    summary.mean_solidity /= static_cast<double>(summary.occupied_cells);
    summary.ball_density = balls / summary.occupied_volume;
  }
  return summary;
}

SolidsSummary begin_summary(const std::filesystem::path& file, const SolidsHeader& header, const Grid& grid) {
  std::vector<std::size_t> shape = field_shape(grid);
  std::reverse(shape.begin(), shape.end());
  const char* kind = std::visit([](const auto& cells) { return kind_of(cells); }, grid);
  return {file, header, kind, std::move(shape), {}};
}

SolidsSummary summarise(const std::filesystem::path& file) {
  const SolidsReader solids(file);
  const std::vector<Ledger> ledgers = solids.read_ledgers();
  const std::vector<double> balls = solids.read_balls_per_cell();
  SolidsSummary summary = begin_summary(file, solids.header(), solids.grid());
  for (std::size_t w = 0; w < ledgers.size(); ++w) {
    summary.windows.push_back(
        summarise(solids.grid(), solids.windows()[w], ledgers[w], balls[w], solids.read_unchecked(w)));
  }
  return summary;
}

SolidsSummary read_ledgers(const std::filesystem::path& file) {
  const SolidsReader solids(file);
  const std::vector<Ledger> ledgers = solids.read_ledgers();
  SolidsSummary summary = begin_summary(file, solids.header(), solids.grid());
  summary.windows.resize(ledgers.size());
  for (std::size_t w = 0; w < ledgers.size(); ++w) {
    summary.windows[w].time = solids.windows()[w];
    summary.windows[w].ledger = ledgers[w];
  }
  return summary;
}

double largest_share(const SolidsSummary& summary, double Ledger::*part) {
  double largest = 0;
  for (const WindowSummary& window : summary.windows)
    largest = std::max(largest, share(window.ledger.*part, window.ledger.volume_in));
  return largest;
}

WindowSummary overall(const SolidsSummary& summary) {
  WindowSummary all;
  double balls = 0;
  for (const WindowSummary& window : summary.windows) {
    all.balls_per_cell += window.balls_per_cell / static_cast<double>(summary.windows.size());
    all.occupied_cells += window.occupied_cells;
    all.small_cells += window.small_cells;
    all.cut_cells += window.cut_cells;
    all.occupied_volume += window.occupied_volume;
    balls += window.ball_density * window.occupied_volume;
    all.mean_solidity += window.mean_solidity * static_cast<double>(window.occupied_cells);
    all.largest_solidity = std::max(all.largest_solidity, window.largest_solidity);
  }
  if (all.occupied_cells > 0) {
    all.mean_solidity /= static_cast<double>(all.occupied_cells);
    all.ball_density = balls / all.occupied_volume;
  }
  return all;
}

std::vector<Remark> remarks(const SolidsSummary& summary) {
  const WindowSummary all = overall(summary);
  if (all.occupied_cells == 0) return {{true, "no cell holds a ball: does the grid cover the charge?"}};
  std::vector<Remark> found = size_advice(all, summary.header.smoothing);
  remark_on_solidity(all.largest_solidity, found);
  remark_on_outside(summary, found);
  remark_on_clipped(summary, found);
  remark_on_walls(summary, all.cut_cells, found);
  remark_on_records(summary, found);
  if (summary.header.fines_share.value_or(0) > 0) {
    found.push_back(
        {false, formatted("%.1f %% of the charge's mass are fines, which are not simulated: they are in "
                          "none of these fields",
                          100 * *summary.header.fines_share)});
  }
  return found;
}

std::string report(const SolidsSummary& summary) {
  std::string text = summary.file.string() + "\n" +
                     formatted("%6s %10s %10s %8s %14s %12s %12s %12s\n", "window", "begin, s", "end, s",
                               "records", "volume in, m3", "deposited, %", "outside, %", "clipped, %");
  for (std::size_t w = 0; w < summary.windows.size(); ++w) text += ledger_row(w, summary.windows[w]);
  const WindowSummary all = overall(summary);
  text += formatted("solidity of occupied cells: mean %.4f, largest %.4f\n", all.mean_solidity,
                    all.largest_solidity);
  text += formatted("balls per occupied cell: mean %.3g\n", all.balls_per_cell);
  for (const Remark& remark : remarks(summary)) {
    text += (remark.warning ? "warning: " : "advice: ") + remark.sentence + '\n';
  }
  return text;
}

std::vector<std::string> ledger_failures(const SolidsSummary& summary, double tolerance) {
  std::vector<std::string> failures;
  for (std::size_t w = 0; w < summary.windows.size(); ++w) {
    const Ledger& ledger = summary.windows[w].ledger;
    const auto fail = [&](const char* what, double part, double allowed) {
      failures.push_back(
          formatted("window %zu from %g s: %.3g %% of the particle volume %s, allowed are %.3g %%", w,
                    summary.windows[w].time.begin, 100 * share(part, ledger.volume_in), what, 100 * allowed));
    };
    const auto above = [&](double part, double allowed) { return part > allowed * ledger.volume_in; };
    constexpr double round_off = 1e-10;
    const double missing = std::abs(ledger.volume_in - ledger.deposited - ledger.outside);
    if (above(missing, round_off)) fail("is missing in the ledger", missing, round_off);
    // Round-off of the deposits leaves traces outside that are not a loss.
    if (above(ledger.outside, std::max(tolerance, round_off)))
      fail("is outside the grid", ledger.outside, tolerance);
    if (above(ledger.clipped, tolerance))
      fail("was moved to neighbours, from within walls or above a cap", ledger.clipped, tolerance);
  }
  return failures;
}

}  // namespace millfoam::averaging
