// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/mill_mesh/section_blocks.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "meshing/mill/mill_shape.hpp"
#include "meshing/mill/opening_circles.hpp"
#include "meshing/mill_mesh/divisions.hpp"
#include "meshing/mill_mesh/o_grid.hpp"
#include "meshing/surface/pi.hpp"

namespace millfoam::meshing {
namespace {

using Eigen::Vector2d;
using Part = CrossSection::Part;

Vector2d on_circle(double radius, double angle) {
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

int add_point(CrossSection& section, const Vector2d& point) {
  section.points.push_back(point);
  return static_cast<int>(section.points.size()) - 1;
}

/// Points on the lifters' tops and, between them, on the circle through the tops' corners; anticlockwise from
/// the first corner of lifter 1.
std::vector<int> add_rim(CrossSection& section, const Geometry& geometry, const Divisions& divisions) {
  const Lifters& lifters = geometry.lifters;
  const double pitch = 2 * pi / lifters.count;
  const double top = lifter_top_half_angle(geometry);
  const double corner = lifter_corner_radius(geometry);
  std::vector<int> rim;
  for (int k = 0; k < lifters.count; ++k) {
    const Eigen::Rotation2Dd turn(k * pitch);
    for (int i = 0; i < divisions.lifter; ++i) {
      const double across = (static_cast<double>(i) / divisions.lifter - 0.5) * lifters.top_width;
      rim.push_back(add_point(section, turn * Vector2d(lifter_top_distance(geometry), across)));
    }
    for (int i = 0; i < divisions.gap; ++i) {
      const double angle = top + (pitch - 2 * top) * i / divisions.gap;
      rim.push_back(add_point(section, turn * on_circle(corner, angle)));
    }
  }
  return rim;
}

std::vector<int> add_smooth_rim(CrossSection& section, const Geometry& geometry, int around) {
  std::vector<int> rim;
  rim.reserve(static_cast<std::size_t>(around));
  for (int i = 0; i < around; ++i) {
    rim.push_back(add_point(section, on_circle(geometry.radius(), 2 * pi * i / around)));
  }
  for (int i = 0; i < around; ++i) {
    section.walls.push_back({{i, (i + 1) % around}, Part::shell});
  }
  return rim;
}

/// The block between lifter k (from 0) and the next: columns of straight lines from the rim to the shell.
void add_gap(CrossSection& section, const Geometry& geometry, const Divisions& divisions,
             const std::vector<int>& rim, int k) {
  const double pitch = 2 * pi / geometry.lifters.count;
  const double foot = lifter_foot_half_angle(geometry);
  const Eigen::Rotation2Dd turn(k * pitch);
  const int rows = divisions.height;
  const int columns = divisions.gap;
  const int first = static_cast<int>(section.points.size());
  const auto rim_at = [&](int column) {
    const int p = k * (divisions.lifter + columns) + divisions.lifter + column;
    return rim[static_cast<std::size_t>(p) % rim.size()];
  };
  for (int column = 0; column <= columns; ++column) {
    const Vector2d inner = section.points[static_cast<std::size_t>(rim_at(column))];
    const Vector2d outer = turn * on_circle(geometry.radius(), foot + (pitch - 2 * foot) * column / columns);
    for (int row = 1; row < rows; ++row) {
      add_point(section, inner + (outer - inner) * (static_cast<double>(row) / rows));
    }
    add_point(section, outer);
  }
  const auto at = [&](int row, int column) {
    return row == 0 ? rim_at(column) : first + column * rows + row - 1;
  };
  for (int column = 0; column < columns; ++column) {
    for (int row = 0; row < rows; ++row) {
      section.quads.push_back(
          {at(row, column), at(row + 1, column), at(row + 1, column + 1), at(row, column + 1)});
      section.columns.push_back(k * (divisions.lifter + columns) + divisions.lifter + column);
    }
    section.walls.push_back({{at(rows, column), at(rows, column + 1)}, Part::shell});
  }
  for (int row = 0; row < rows; ++row) {
    section.walls.push_back({{at(row, 0), at(row + 1, 0)}, Part::lifters});
    section.walls.push_back({{at(row + 1, columns), at(row, columns)}, Part::lifters});
  }
}

void add_lifter_tops(CrossSection& section, const Divisions& divisions, const std::vector<int>& rim) {
  const auto period = static_cast<std::size_t>(divisions.lifter) + static_cast<std::size_t>(divisions.gap);
  for (std::size_t p = 0; p < rim.size(); ++p) {
    if (p % period < static_cast<std::size_t>(divisions.lifter)) {
      section.walls.push_back({{rim[p], rim[(p + 1) % rim.size()]}, Part::lifters});
    }
  }
}

/// Points on an opening's circle, one opposite each of the rim's.
std::vector<int> add_circle(CrossSection& section, double radius) {
  const double pitch = 2 * pi / section.around();
  const double outside = radius * std::sqrt(pitch / std::sin(pitch));
  std::vector<int> circle;
  circle.reserve(static_cast<std::size_t>(section.around()));
  for (int p = 0; p < section.around(); ++p) {
    circle.push_back(add_point(section, on_circle(outside, section.first_line_angle() + p * pitch)));
  }
  return circle;
}

/// The O-grid inside the smallest ring of points.
void add_core(CrossSection& section, const Divisions& divisions, const std::vector<int>& ring) {
  // Half a side from lifter 1 puts the core's corners on the diagonals.
  const int first_corner = divisions.lifter / 2 + section.around() / 8;
  if (!divisions.halved) {
    add_o_grid(section, ring, first_corner, divisions.bands.front());
    return;
  }
  const auto first_quad = static_cast<std::ptrdiff_t>(section.columns.size());
  add_o_grid(section, add_halving(section, ring, first_corner), 0, divisions.bands.front());
  std::fill(section.columns.begin() + first_quad, section.columns.end(), -1);
}

/// Core and ring: the O-grid inside the smallest circle, and a band between each two.
void add_core_and_bands(CrossSection& section, const Geometry& geometry, const Divisions& divisions,
                        const std::vector<int>& rim) {
  std::vector<std::vector<int>> rings;
  for (double radius : opening_circles(geometry)) rings.push_back(add_circle(section, radius));
  rings.push_back(rim);
  add_core(section, divisions, rings.front());
  for (std::size_t i = 1; i < rings.size(); ++i) {
    add_band(section, rings[i - 1], rings[i], divisions.bands[i], 0);
  }
}

CrossSection divided(const Geometry& geometry, const Divisions& divisions) {
  CrossSection section;
  section.divisions = divisions;
  if (geometry.lifters.count == 0) {
    const std::vector<int> rim = add_smooth_rim(section, geometry, section.around());
    add_core_and_bands(section, geometry, divisions, rim);
    return section;
  }
  const std::vector<int> rim = add_rim(section, geometry, divisions);
  add_core_and_bands(section, geometry, divisions, rim);
  for (int k = 0; k < geometry.lifters.count; ++k) add_gap(section, geometry, divisions, rim, k);
  add_lifter_tops(section, divisions, rim);
  return section;
}

}  // namespace

CrossSection make_cross_section(const Geometry& geometry, const Resolution& resolution) {
  return divided(geometry, resolution.counts ? given_divisions(geometry, *resolution.counts)
                                             : choose_divisions(geometry, resolution.cell_size));
}

}  // namespace millfoam::meshing
