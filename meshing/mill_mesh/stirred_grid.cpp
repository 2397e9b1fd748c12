// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/mill_mesh/stirred_grid.hpp"

#include <algorithm>
#include <cmath>

#include "meshing/surface/pi.hpp"

namespace millfoam::meshing {
namespace {

using Eigen::Vector2d;

/// Distance from a pin, over its radius, beyond which its circle moves no points.
constexpr double reach_of_circle = 3;
/// Height over which the lines of cells go back from a pin's angles, over its diameter; at the shaft they do
/// between the pin and the shaft's end.
constexpr double height_of_return = 3;
/// Width of the columns next to a pin over that of equal columns between two pins: smallest and largest.
constexpr double narrowest = 0.8;
constexpr double widest = 1.8;
/// Layers of cells over which a flat tip moves points towards the shaft.
constexpr int layers_of_tip = 3;

std::size_t line_index(int number) {
  return static_cast<std::size_t>(number);
}

/// Where a point on the sides of a pin's block lies on the pin's circle: equal shares of the sides take
/// equal arcs.
Vector2d on_circle(const Vector2d& at, double width, double height, double radius) {
  if (at.isZero()) return at;
  const double corner = std::atan2(height, width);
  const bool aside = std::abs(at.x()) / width >= std::abs(at.y()) / height;
  const double angle = aside ? at.y() / height * corner : at.x() / width * (pi / 2 - corner);
  if (aside) return {std::copysign(radius * std::cos(angle), at.x()), radius * std::sin(angle)};
  return {radius * std::sin(angle), std::copysign(radius * std::cos(angle), at.y())};
}

}  // namespace

StirredGrid::StirredGrid(const Geometry& geometry, double cell_size)
    : geometry_(geometry), impeller_(*geometry.impeller), lines_(stirred_divisions(geometry, cell_size)) {
  for (std::size_t level = 0; level < impeller_.pins.size(); ++level)
    for (int arm = 0; arm < impeller_.pins[level].arms; ++arm) add_arm(level, arm);
}

void StirredGrid::add_arm(std::size_t level, int number) {
  const PinLevel& pins = impeller_.pins[level];
  const double first = std::remainder(pins.angle * pi / 180, 2 * pi);
  const double angle = first + 2 * pi * number / pins.arms;
  const double equal = 2 * pi / lines_.around;
  arms_.push_back({level, angle, static_cast<int>(std::lround(angle / equal))});
}

/// Half the angle of the block that a level's pins take at a radius.
double StirredGrid::half_angle(std::size_t level, double radius) const {
  const double half = impeller_.pins[level].thickness / 2 * pin_half_width(lines_);
  return std::asin(std::min(half / radius, 1.0));
}

/// By how much a level's pins turn a line of the grid from the equal angles, rad; radius in m.
double StirredGrid::shift(std::size_t level, int column, double radius) const {
  const PinLevel& pins = impeller_.pins[level];
  const double equal = 2 * pi / lines_.around, half = half_angle(level, radius);
  const int across = lines_.across_pin;
  const auto first =
      std::find_if(arms_.begin(), arms_.end(), [&](const Arm& arm) { return arm.level == level; });
  for (int a = 0; a < pins.arms; ++a) {
    const Arm& arm = *(first + a);
    const int next_column = a + 1 < pins.arms ? (first + a + 1)->column : first->column + lines_.around;
    const double next_angle = a + 1 < pins.arms ? (first + a + 1)->angle : first->angle + 2 * pi;
    int from = column;  // the same line, at or after this arm's
    const int begin = arm.column - across / 2;
    from += lines_.around * static_cast<int>(std::ceil((begin - from) / static_cast<double>(lines_.around)));
    const double turns = equal * (from - column);
    if (from <= arm.column + across / 2) {
      const double share = 2.0 * (from - arm.column) / across;
      return arm.angle + std::asin(share * std::sin(half)) - turns - equal * column;
    }
    const int end = next_column - across / 2;
    if (from > end) continue;
    const int cells = end - (arm.column + across / 2);
    const double length = next_angle - arm.angle - 2 * half;
    const double slope = std::clamp(2 * half / across * cells, narrowest * length, widest * length);
    const int beyond = from - arm.column - across / 2;
    const double x = static_cast<double>(beyond) / cells;
    const double angle = slope * x + (length - slope) * x * x * (3 - 2 * x);
    return arm.angle + half + angle - turns - equal * column;
  }
  return 0;
}

/// Share of a level's shift at a place: 1 at its pins' height.
double StirredGrid::share_of(std::size_t level, double radius, double z) const {
  const PinLevel& pins = impeller_.pins[level];
  const double half = pins.thickness / 2 * pin_half_height(lines_);
  const double low = pins.height - half, high = pins.height + half;
  if (z >= low && z <= high) return 1;
  double room = height_of_return * pins.thickness;
  if (z < low) {
    const double shaft = impeller_.shaft_diameter / 2;
    room = std::min(room, low - impeller_.shaft_end + 2 * (radius - shaft));
  }
  for (const PinLevel& other : impeller_.pins) {
    const double other_half = other.thickness / 2 * pin_half_height(lines_);
    if (z > high && other.height > pins.height) room = std::min(room, other.height - other_half - high);
    if (z < low && other.height < pins.height) room = std::min(room, low - other.height - other_half);
  }
  return std::max(0.0, 1 - (z < low ? low - z : z - high) / room);
}

/// Angle of a point of the grid before pins are rounded.
double StirredGrid::angle_of(int column, double radius, double z) const {
  double angle = 2 * pi * column / lines_.around;
  for (std::size_t l = 0; l < impeller_.pins.size(); ++l) {
    const double share = share_of(l, radius, z);
    if (share > 0) angle += share * shift(l, column, radius);
  }
  return angle;
}

/// Lower and upper end of the space in which a level's circles move points, from the pins' axes.
std::pair<double, double> StirredGrid::space_of(std::size_t level) const {
  const PinLevel& pins = impeller_.pins[level];
  const double half = pins.thickness / 2;
  double below = std::min(reach_of_circle * half, pins.height - impeller_.shaft_end);
  double above = std::min(reach_of_circle * half, geometry_.length - pins.height);
  const auto limit = [&](double low, double high) {
    if (low > pins.height) above = std::min(above, (low + half + pins.height) / 2 - pins.height);
    if (high < pins.height) below = std::min(below, pins.height - (high - half + pins.height) / 2);
  };
  for (const PinLevel& other : impeller_.pins)
    limit(other.height - other.thickness / 2, other.height + other.thickness / 2);
  for (const Disc& disc : impeller_.discs) {
    const double low = disc.height - disc.thickness / 2, high = disc.height + disc.thickness / 2;
    if (low > pins.height) above = std::min(above, low - pins.height);
    if (high < pins.height) below = std::min(below, pins.height - high);
  }
  return {below, above};
}

/// Share of a pin's roundness that a ring's points get: none at the shell.
double StirredGrid::roundness(std::size_t level, int ring) const {
  const int tip = lines_.pin_tips[level];
  if (ring <= tip) return 1;
  return (lines_.radii.back() - lines_.radii[line_index(ring)]) /
         (lines_.radii.back() - lines_.radii[line_index(tip)]);
}

/// Where an arm's roundness takes a point of the grid.
StirredGrid::Place StirredGrid::rounded(const Arm& arm, int ring, const Place& at_line) const {
  const PinLevel& pins = level_of(arm);
  const double line_radius = lines_.radii[line_index(ring)];
  const double from_axis = std::remainder(at_line.angle - arm.angle, 2 * pi);
  const double widest = std::min(pi / 3, pi / pins.arms);
  if (std::abs(from_axis) > widest) return at_line;
  const double half = pins.thickness / 2;
  const Vector2d at(line_radius * std::sin(from_axis), at_line.z - pins.height);
  const double width = half * pin_half_width(lines_), height = half * pin_half_height(lines_);
  const double inner = std::max(std::abs(at.x()) / width, std::abs(at.y()) / height);
  const auto [below, above] = space_of(arm.level);
  // A little less than where the circle of the next arm begins
  const double aside = std::min(reach_of_circle * half, 0.999 * line_radius * std::sin(widest));
  const double outer = std::max(std::abs(at.x()) / aside, at.y() > 0 ? at.y() / above : -at.y() / below);
  if (outer >= 1) return at_line;
  double share = inner;
  Vector2d on_block(0, 0);
  if (inner > 0) on_block = at / inner;
  if (inner > 1) share = (1 - outer) / (1 - outer / inner);
  share *= roundness(arm.level, ring);
  const Vector2d moved = at + share * (on_circle(on_block, width, height, half) - on_block);
  const int tip = lines_.pin_tips[arm.level];
  const double reach = pins.length / 2;
  const double flat = std::hypot(reach, moved.x()) - reach;
  const double fade = ring > tip ? roundness(arm.level, ring)
                                 : std::max(0.0, 1 - static_cast<double>(tip - ring) / layers_of_tip);
  const double radius = at_line.radius + fade * (inner > 1 ? (1 - outer) / (1 - outer / inner) : 1) * flat;
  return {arm.angle + std::asin(std::clamp(moved.x() / radius, -1.0, 1.0)), radius, pins.height + moved.y()};
}

Eigen::Vector3d StirredGrid::place(int ring, int column, int row) const {
  const double radius = lines_.radii[line_index(ring)], z = lines_.heights[line_index(row)];
  Place at = {angle_of(column, radius, z), radius, z};
  for (const Arm& arm : arms_) at = rounded(arm, ring, at);
  return {at.radius * std::cos(at.angle), at.radius * std::sin(at.angle), at.z};
}

bool StirredGrid::is_solid(int ring, int column, int row) const {
  for (const Arm& arm : arms_) {
    const LineSpan& rows = lines_.pin_rows[arm.level];
    if (row < rows.first || row >= rows.last || ring >= lines_.pin_tips[arm.level]) continue;
    int offset = (column - arm.column + lines_.across_pin / 2) % lines_.around;
    if (offset < 0) offset += lines_.around;
    if (offset < lines_.across_pin) return true;
  }
  for (std::size_t d = 0; d < lines_.disc_rows.size(); ++d) {
    const LineSpan& rows = lines_.disc_rows[d];
    if (row >= rows.first && row < rows.last && ring < lines_.disc_rims[d]) return true;
  }
  return false;
}

}  // namespace millfoam::meshing
