// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/mill_mesh/stirred_divisions.hpp"

#include <algorithm>
#include <cmath>

#include "meshing/mill/stirred_geometry.hpp"
#include "meshing/mill_mesh/o_grid.hpp"
#include "meshing/surface/pi.hpp"

namespace millfoam::meshing {
namespace {

/// Cells between the tips and the shell.
constexpr int cells_in_gap = 4;
/// Width of columns half-way to the shell, and of a pin's cells, over the cell size.
constexpr double column_width = 0.7;
constexpr double pin_cell = 0.6;
/// By how much cells grow with the distance from what they must resolve, over that distance.
constexpr double growth = 0.25;
/// Above this multiple of the impeller's top cells grow, up to this multiple of the cell size.
constexpr double fine_up_to = 1.6;
constexpr double largest_height = 4;
/// Cells at the shaft's radius over those of the O-grid below it.
constexpr double next_to_core = 2;
/// Columns that lie at least between two pins.
constexpr int columns_between_pins = 4;
/// Distance below which two lines are the same, m.
constexpr double same = 1e-9;

/// A line that cells must have, and their size there.
struct Line {
  double at;    ///< m
  double size;  ///< m
};

/// Size of the cells at a place, m: that of the nearest lines, and more with the distance from them.
double size_at(double at, const std::vector<Line>& lines, double largest) {
  double size = largest;
  for (const Line& line : lines) size = std::min(size, line.size + growth * std::abs(at - line.at));
  return size;
}

/// Appends lines (m) after `from` up to `to`, whose distances are in proportion to the sizes (m).
/// @param size  size of the cells at a place
/// @param fixed  number of cells; 0: as many as the sizes give
template <typename Size>
void append_between(std::vector<double>& lines, double from, double to, const Size& size, int fixed) {
  constexpr int steps = 400;
  const auto at = [](int number) { return static_cast<std::size_t>(number); };
  std::vector<double> sum(steps + 1, 0);
  for (int i = 0; i < steps; ++i)
    sum[at(i + 1)] = sum[at(i)] + (to - from) / steps / size(from + (to - from) * (i + 0.5) / steps);
  const int cells = fixed > 0 ? fixed : std::max(1, static_cast<int>(std::lround(sum.back())));
  lines.reserve(lines.size() + at(cells));
  int step = 0;
  for (int cell = 1; cell < cells; ++cell) {
    const double wanted = sum.back() * cell / cells;
    while (sum[at(step + 1)] < wanted) ++step;
    const double before = sum[at(step)];
    const double share = (wanted - before) / (sum[at(step + 1)] - before);
    lines.push_back(from + (to - from) * (step + share) / steps);
  }
  lines.push_back(to);
}

/// Number of the line at a place.
int number_of(const std::vector<double>& lines, double at) {
  const auto near = std::min_element(lines.begin(), lines.end(),
                                     [&](double a, double b) { return std::abs(a - at) < std::abs(b - at); });
  return static_cast<int>(near - lines.begin());
}

/// Sorted, each place once with its smallest size.
std::vector<Line> merged(std::vector<Line> lines) {
  std::sort(lines.begin(), lines.end(), [](const Line& a, const Line& b) { return a.at < b.at; });
  std::vector<Line> once;
  for (const Line& line : lines) {
    if (!once.empty() && line.at - once.back().at < same)
      once.back().size = std::min(once.back().size, line.size);
    else
      once.push_back(line);
  }
  return once;
}

void divide_radii(const Geometry& geometry, double size, StirredDivisions& divisions) {
  const Impeller& impeller = *geometry.impeller;
  const double shell = geometry.radius();
  const double shaft = impeller.shaft_diameter / 2;
  const double in_core = ring_thickness(shaft).least / divisions.core_layers;
  std::vector<Line> lines = {{shaft, std::min(column_width * size, next_to_core * in_core)}};
  double thinnest = column_width * size;
  const auto add_tip = [&](double reach) {
    const double cell = std::min((shell - reach) / cells_in_gap, size);
    lines.push_back({reach, cell});
    thinnest = std::min(thinnest, cell);
  };
  for (const PinLevel& level : impeller.pins) add_tip(level.length / 2);
  for (const Disc& disc : impeller.discs) add_tip(disc.diameter / 2);
  lines.push_back({shell, thinnest});
  lines = merged(lines);
  divisions.radii = {lines.front().at};
  for (std::size_t i = 1; i < lines.size(); ++i)
    append_between(
        divisions.radii, lines[i - 1].at, lines[i].at, [&](double r) { return size_at(r, lines, size); }, 0);
  for (const PinLevel& level : impeller.pins)
    divisions.pin_tips.push_back(number_of(divisions.radii, level.length / 2));
  for (const Disc& disc : impeller.discs)
    divisions.disc_rims.push_back(number_of(divisions.radii, disc.diameter / 2));
}

void divide_heights(const Geometry& geometry, double size, StirredDivisions& divisions) {
  const Impeller& impeller = *geometry.impeller;
  std::vector<Line> lines = {
      {0, pin_cell * size}, {impeller.shaft_end, pin_cell * size}, {geometry.length, largest_height * size}};
  std::vector<double> pins;
  for (const PinLevel& level : impeller.pins) {
    const double half = level.thickness / 2 * pin_half_height(divisions);
    for (const double at : {level.height - half, level.height + half})
      lines.push_back({at, 2 * half / divisions.up_pin});
    pins.push_back(level.height - half);
  }
  for (const Disc& disc : impeller.discs)
    for (const double at : {disc.height - disc.thickness / 2, disc.height + disc.thickness / 2})
      lines.push_back({at, std::min(pin_cell * size, disc.thickness)});
  lines = merged(lines);
  const double fine = fine_up_to * impeller_top(impeller);
  const auto size_of = [&](double z) {
    return size_at(z, lines, std::min(size + growth / 2 * std::max(z - fine, 0.0), largest_height * size));
  };
  divisions.heights = {0};
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const double from = lines[i - 1].at;
    const bool is_pin =
        std::any_of(pins.begin(), pins.end(), [&](double at) { return std::abs(at - from) < same; });
    append_between(divisions.heights, from, lines[i].at, size_of, is_pin ? divisions.up_pin : 0);
  }
  divisions.shaft_end = number_of(divisions.heights, impeller.shaft_end);
  for (const PinLevel& level : impeller.pins) {
    const double half = level.thickness / 2 * pin_half_height(divisions);
    const int first = number_of(divisions.heights, level.height - half);
    divisions.pin_rows.push_back({first, first + divisions.up_pin});
  }
  for (const Disc& disc : impeller.discs)
    divisions.disc_rows.push_back({number_of(divisions.heights, disc.height - disc.thickness / 2),
                                   number_of(divisions.heights, disc.height + disc.thickness / 2)});
}

/// The even number of cells nearest to a ratio, at least four.
int even(double ratio) {
  return 2 * std::max(2, static_cast<int>(std::lround(ratio / 2)));
}

}  // namespace

double pin_half_width(const StirredDivisions& divisions) {
  return std::sin(pi / 2 * divisions.across_pin / (divisions.across_pin + divisions.up_pin));
}

double pin_half_height(const StirredDivisions& divisions) {
  return std::cos(pi / 2 * divisions.across_pin / (divisions.across_pin + divisions.up_pin));
}

StirredDivisions stirred_divisions(const Geometry& geometry, double cell_size) {
  const Impeller& impeller = *geometry.impeller;
  StirredDivisions divisions;
  double thickest = 0;
  int most_arms = 1;
  for (const PinLevel& level : impeller.pins) {
    thickest = std::max(thickest, level.thickness);
    most_arms = std::max(most_arms, level.arms);
  }
  divisions.across_pin = even(thickest / std::sqrt(2.0) / (pin_cell * cell_size));
  divisions.up_pin = divisions.across_pin;
  const double half_way = pi * geometry.radius();
  const int least = most_arms * (divisions.across_pin + columns_between_pins);
  divisions.around =
      4 * static_cast<int>(std::ceil(std::max<double>(half_way / (column_width * cell_size), least) / 4));
  // Twice as thick as they are wide
  const double square_cells = ring_layers(impeller.shaft_diameter / 2, divisions.around / 4);
  divisions.core_layers = std::max(2, static_cast<int>(std::lround(square_cells / 2)));
  divide_radii(geometry, cell_size, divisions);
  divide_heights(geometry, cell_size, divisions);
  return divisions;
}

}  // namespace millfoam::meshing
