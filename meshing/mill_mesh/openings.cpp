// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/mill_mesh/openings.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <sstream>
#include <string>

#include "meshing/files/text_numbers.hpp"
#include "meshing/mill/mill_error.hpp"
#include "meshing/mill/mill_shape.hpp"
#include "meshing/mill/opening_circles.hpp"
#include "meshing/surface/pi.hpp"

namespace millfoam::meshing {
namespace {

using Eigen::Vector2d;

/// Relative difference below which two distances are the same.
constexpr double same_distance = 1e-9;

Vector2d centre(const CrossSection& section, std::size_t quad) {
  Vector2d sum = Vector2d::Zero();
  for (int p : section.quads[quad]) sum += section.points[static_cast<std::size_t>(p)];
  return sum / 4;
}

double area(const CrossSection& section, std::size_t quad) {
  const auto at = [&](std::size_t i) {
    return section.points[static_cast<std::size_t>(section.quads[quad][i])];
  };
  const Vector2d a = at(2) - at(0), b = at(3) - at(1);
  return (a.x() * b.y() - a.y() * b.x()) / 2;
}

double area(const CrossSection& section, const std::vector<bool>& chosen) {
  double sum = 0;
  for (std::size_t q = 0; q < chosen.size(); ++q) sum += chosen[q] ? area(section, q) : 0;
  return sum;
}

double smallest_area(const CrossSection& section, const std::vector<bool>& chosen) {
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t q = 0; q < chosen.size(); ++q) {
    if (chosen[q]) smallest = std::min(smallest, area(section, q));
  }
  return smallest;
}

/// Quadrilaterals inside a radius that sides follow.
std::vector<bool> inside(const CrossSection& section, double radius) {
  std::vector<bool> chosen;
  for (std::size_t q = 0; q < section.quads.size(); ++q) chosen.push_back(centre(section, q).norm() < radius);
  return chosen;
}

/// Quadrilaterals nearest to the axis whose area is nearest to `asked`.
std::vector<bool> nearest_in_area(const CrossSection& section, double asked) {
  std::vector<double> distance;
  for (std::size_t q = 0; q < section.quads.size(); ++q) distance.push_back(centre(section, q).norm());
  std::vector<std::size_t> order(distance.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return distance[a] < distance[b]; });
  const double tolerance = same_distance * distance[order.back()];
  double sum = 0, least = asked;
  std::size_t best = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    sum += area(section, order[i]);
    const bool whole = i + 1 == order.size() || distance[order[i + 1]] - distance[order[i]] > tolerance;
    if (whole && (best == 0 || std::abs(sum - asked) < least)) {
      best = i + 1;
      least = std::abs(sum - asked);
    }
  }
  std::vector<bool> chosen(order.size(), false);
  for (std::size_t i = 0; i < best; ++i) chosen[order[i]] = true;
  return chosen;
}

/// The columns of a cross-section in the sectors of the grates. Columns are counted on from line 0 without
/// regard to the full turn.
struct Sectors {
  std::vector<int> first_line;   ///< of each sector, and of the one after the last
  std::vector<int> first_grate;  ///< column at which each sector's grate begins
  std::vector<int> grates;       ///< number of columns of each sector's grate
};

/// Whether a radial wall of the pulp lifters may follow a line. One column away from a lifter's side it would
/// leave cells at the shell with two neighbours only.
bool may_carry_wall(const Divisions& divisions, int line) {
  const int pitch = divisions.lifter + divisions.gap;
  if (pitch == 0) return true;
  const int from_lifter = (line % pitch + pitch) % pitch;
  return from_lifter != divisions.lifter + 1 && from_lifter != pitch - 1;
}

/// The line nearest to a position in columns, and fit for a wall where there is one.
int nearest_line(const Divisions& divisions, double position, bool carries_wall) {
  const int nearest = static_cast<int>(std::lround(position));
  if (!carries_wall) return nearest;
  int best = nearest;
  double least = divisions.lifter + divisions.gap + 1;
  for (int line = nearest - 2; line <= nearest + 2; ++line) {
    if (!may_carry_wall(divisions, line) || std::abs(line - position) >= least) continue;
    best = line;
    least = std::abs(line - position);
  }
  return best;
}

Sectors divide(const CrossSection& section, const Grates& grates, bool walls) {
  const double width = static_cast<double>(section.around()) / grates.sectors;
  const double line_at_x = -section.first_line_angle() / (2 * pi) * section.around();
  Sectors sectors;
  for (int k = 0; k < grates.sectors; ++k) {
    sectors.first_line.push_back(nearest_line(section.divisions, line_at_x + k * width, walls));
  }
  sectors.first_line.push_back(sectors.first_line.front() + section.around());
  int taken = 0;
  for (int k = 0; k < grates.sectors; ++k) {
    const auto s = static_cast<std::size_t>(k);
    const int room = sectors.first_line[s + 1] - sectors.first_line[s];
    const int columns =
        std::min(room, static_cast<int>(std::lround((k + 1) * width * grates.sector_share)) - taken);
    if (columns < 1) {
      throw KeyError("geometry.grates.sectors", std::to_string(grates.sectors),
                     "fewer sectors, a larger sector_share, or more cells: sector " + std::to_string(k + 1) +
                         " has no column of the mesh's " + std::to_string(section.around()) +
                         " for its grate");
    }
    sectors.first_grate.push_back(sectors.first_line[s] + (room - columns) / 2);
    sectors.grates.push_back(columns);
    taken += columns;
  }
  return sectors;
}

/// Calls visit(quad) for the quadrilaterals outside a radius in `columns` columns from `first`.
template <typename Visit>
void for_each_outside(const CrossSection& section, double radius, int first, int columns,
                      const Visit& visit) {
  for (std::size_t q = 0; q < section.quads.size(); ++q) {
    if (section.columns[q] < 0 || centre(section, q).norm() < radius) continue;
    const int from_first =
        ((section.columns[q] - first) % section.around() + section.around()) % section.around();
    if (from_first < columns) visit(q);
  }
}

/// An inlet of whole quadrilaterals must have about the area that feed rates are given for.
void require_inlet_area(double area, const Geometry& geometry) {
  const double asked = asked_inlet_area(geometry), error = area / asked - 1;
  if (std::abs(error) <= allowed_inlet_error) return;
  std::ostringstream text;
  text.precision(3);
  text << "an inlet of which whole cells about the axis have the area to " << 100 * allowed_inlet_error
       << " %; the nearest have " << 1e4 * area << " cm^2, " << 100 * std::abs(error) << " % too "
       << (error > 0 ? "much" : "little")
       << ": choose smaller cells, an inlet of that area, or one of a radius of "
       << smallest_circle * lifter_top_distance(geometry) << " m or more, which has a circle in the mesh";
  throw KeyError("geometry.inlet", shown(1e4 * asked) + " cm^2", text.str());
}

}  // namespace

Openings find_openings(const CrossSection& section, const Geometry& geometry) {
  Openings openings;
  openings.inlet.assign(section.quads.size(), false);
  openings.grates.assign(section.quads.size(), false);
  openings.compartment.assign(section.quads.size(), -1);
  if (geometry.inlet) {
    const bool has_circle = geometry.inlet->radius >= smallest_circle * lifter_top_distance(geometry);
    openings.inlet = has_circle ? inside(section, geometry.inlet->radius)
                                : nearest_in_area(section, asked_inlet_area(geometry));
    if (!has_circle) require_inlet_area(area(section, openings.inlet), geometry);
  }
  if (geometry.grates) {
    const Sectors sectors = divide(section, *geometry.grates, geometry.pulp_lifters.has_value());
    const std::vector<bool> within = inside(section, geometry.grates->outer_radius);
    for (std::size_t k = 0; k < sectors.grates.size(); ++k) {
      for_each_outside(section, geometry.grates->inner_radius, sectors.first_grate[k], sectors.grates[k],
                       [&](std::size_t q) { openings.grates[q] = within[q]; });
      if (!geometry.pulp_lifters) continue;
      for_each_outside(section, geometry.pulp_lifters->discharge_radius, sectors.first_line[k],
                       sectors.first_line[k + 1] - sectors.first_line[k],
                       [&](std::size_t q) { openings.compartment[q] = static_cast<int>(k); });
    }
  }
  openings.inlet_area = area(section, openings.inlet);
  openings.grate_area = area(section, openings.grates);
  double smallest = smallest_area(section, openings.inlet);
  if (geometry.pulp_lifters) {
    const std::vector<bool> outlet = inside(section, geometry.pulp_lifters->discharge_radius);
    openings.outlet_area = area(section, outlet);
    smallest = std::min(smallest, smallest_area(section, outlet));
  }
  if (std::isfinite(smallest)) openings.smallest_quad = smallest;
  return openings;
}

}  // namespace millfoam::meshing
