// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/mill_mesh/stirred_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "meshing/mill_mesh/o_grid.hpp"
#include "meshing/mill_mesh/stirred_divisions.hpp"
#include "meshing/surface/pi.hpp"

namespace millfoam::meshing {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

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

/// A cell's eight points: four below, anticlockwise seen from above, and the four above them.
using Hexahedron = std::array<int, 8>;

/// The patches in their order.
enum class StirredPart { impeller, shell, base, lid };
constexpr std::array<const char*, 4> stirred_part_names = {"impeller", "shell", "base", "lid"};

/// An arm of the impeller on the grid.
struct GridArm {
  std::size_t level;  ///< number of its level
  double angle;       ///< rad, of its axis
  int column;         ///< number of the line at its axis, between 0 and `around`
};

class StirredMesh {
 public:
  StirredMesh(const Geometry& geometry, double cell_size)
      : geometry_(geometry),
        impeller_(*geometry.impeller),
        lines_(stirred_divisions(geometry, cell_size)),
        rings_(static_cast<int>(lines_.radii.size()) - 1),
        rows_(static_cast<int>(lines_.heights.size()) - 1) {
    for (std::size_t l = 0; l < impeller_.pins.size(); ++l)
      for (int a = 0; a < impeller_.pins[l].arms; ++a) add_arm(l, a);
  }

  VolumeMesh run() && {
    add_ring_points();
    add_cells();
    drop_unused_points();
    add_faces();
    return std::move(mesh_);
  }

 private:
  const PinLevel& level_of(const GridArm& arm) const { return impeller_.pins[arm.level]; }

  void add_arm(std::size_t level, int number) {
    const PinLevel& pins = impeller_.pins[level];
    const double first = std::remainder(pins.angle * pi / 180, 2 * pi);
    const double angle = first + 2 * pi * number / pins.arms;
    const double equal = 2 * pi / lines_.around;
    arms_.push_back({level, angle, static_cast<int>(std::lround(angle / equal))});
  }

  /// Half the angle of the block that a level's pins take at a radius.
  double half_angle(std::size_t level, double radius) const {
    const double half = impeller_.pins[level].thickness / 2 * pin_half_width(lines_);
    return std::asin(std::min(half / radius, 1.0));
  }

  /// By how much a level's pins turn a line of the grid from the equal angles, rad; radius in m.
  double shift(std::size_t level, int column, double radius) const {
    const PinLevel& pins = impeller_.pins[level];
    const double equal = 2 * pi / lines_.around, half = half_angle(level, radius);
    const int across = lines_.across_pin;
    const auto first =
        std::find_if(arms_.begin(), arms_.end(), [&](const GridArm& arm) { return arm.level == level; });
    for (int a = 0; a < pins.arms; ++a) {
      const GridArm& arm = *(first + a);
      const int next_column = a + 1 < pins.arms ? (first + a + 1)->column : first->column + lines_.around;
      const double next_angle = a + 1 < pins.arms ? (first + a + 1)->angle : first->angle + 2 * pi;
      int from = column;  // the same line, at or after this arm's
      const int begin = arm.column - across / 2;
      from +=
          lines_.around * static_cast<int>(std::ceil((begin - from) / static_cast<double>(lines_.around)));
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
  double share_of(std::size_t level, double radius, double z) const {
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
  double angle_of(int column, double radius, double z) const {
    double angle = 2 * pi * column / lines_.around;
    for (std::size_t l = 0; l < impeller_.pins.size(); ++l) {
      const double share = share_of(l, radius, z);
      if (share > 0) angle += share * shift(l, column, radius);
    }
    return angle;
  }

  /// Lower and upper end of the space in which a level's circles move points, from the pins' axes.
  std::pair<double, double> space_of(std::size_t level) const {
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
  double roundness(std::size_t level, int ring) const {
    const int tip = lines_.pin_tips[level];
    if (ring <= tip) return 1;
    return (lines_.radii.back() - lines_.radii[index(ring)]) /
           (lines_.radii.back() - lines_.radii[index(tip)]);
  }

  /// Moves a point of the grid, given by its angle and height, to where an arm's roundness takes it.
  void round_off(const GridArm& arm, int ring, double& angle, double& z, double& radius) const {
    const PinLevel& pins = level_of(arm);
    const double line_radius = lines_.radii[index(ring)];
    const double from_axis = std::remainder(angle - arm.angle, 2 * pi);
    if (std::abs(from_axis) > pi / 3) return;
    const double half = pins.thickness / 2;
    const Vector2d at(line_radius * std::sin(from_axis), z - pins.height);
    const double width = half * pin_half_width(lines_), height = half * pin_half_height(lines_);
    const double inner = std::max(std::abs(at.x()) / width, std::abs(at.y()) / height);
    const auto [below, above] = space_of(arm.level);
    const double aside = std::min(reach_of_circle * half, 0.9 * line_radius);
    const double outer = std::max(std::abs(at.x()) / aside, at.y() > 0 ? at.y() / above : -at.y() / below);
    if (outer >= 1) return;
    double share = inner;
    Vector2d on_block(0, 0);
    if (inner > 0) on_block = at / inner;
    if (inner > 1) share = (1 - outer) / (1 - outer / inner);
    share *= roundness(arm.level, ring);
    const Vector2d moved = at + share * (on_circle(on_block, width, height, half) - on_block);
    z = pins.height + moved.y();
    const int tip = lines_.pin_tips[arm.level];
    const double reach = pins.length / 2;
    const double flat = std::hypot(reach, moved.x()) - reach;
    const double fade = ring > tip ? roundness(arm.level, ring)
                                   : std::max(0.0, 1 - static_cast<double>(tip - ring) / layers_of_tip);
    radius += fade * (inner > 1 ? (1 - outer) / (1 - outer / inner) : 1) * flat;
    angle = arm.angle + std::asin(std::clamp(moved.x() / radius, -1.0, 1.0));
  }

  /// Where a point on the sides of a pin's block lies on the pin's circle: equal shares of the sides take
  /// equal arcs.
  static Vector2d on_circle(const Vector2d& at, double width, double height, double radius) {
    if (at.isZero()) return at;
    const double corner = std::atan2(height, width);
    const bool aside = std::abs(at.x()) / width >= std::abs(at.y()) / height;
    const double angle = aside ? at.y() / height * corner : at.x() / width * (pi / 2 - corner);
    if (aside) return {std::copysign(radius * std::cos(angle), at.x()), radius * std::sin(angle)};
    return {radius * std::sin(angle), std::copysign(radius * std::cos(angle), at.y())};
  }

  /// A point of the rings.
  Vector3d place(int ring, int column, int row) const {
    double radius = lines_.radii[index(ring)];
    double z = lines_.heights[index(row)];
    double angle = angle_of(column, radius, z);
    for (const GridArm& arm : arms_) round_off(arm, ring, angle, z, radius);
    return {radius * std::cos(angle), radius * std::sin(angle), z};
  }

  static std::size_t index(int number) { return static_cast<std::size_t>(number); }

  int ring_point(int ring, int column, int row) const {
    const int around = lines_.around;
    return (row * (rings_ + 1) + ring) * around + (column + around) % around;
  }

  void add_ring_points() {
    for (int row = 0; row <= rows_; ++row)
      for (int ring = 0; ring <= rings_; ++ring)
        for (int column = 0; column < lines_.around; ++column)
          mesh_.points.push_back(place(ring, column, row));
  }

  /// Whether the impeller takes a cell of the rings.
  bool is_solid(int ring, int column, int row) const {
    for (const GridArm& arm : arms_) {
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

  void add_cell(const Hexahedron& cell, const std::array<StirredPart, 6>& parts) {
    cells_.push_back(cell);
    parts_.push_back(parts);
  }

  /// The O-grid below the shaft at the lower side of a row. Appends its points to the mesh, and to `numbers`
  /// the numbers of the section's points in the mesh.
  CrossSection core_at(int row, std::vector<int>& numbers) {
    CrossSection section;
    std::vector<int> rim;
    for (int column = 0; column < lines_.around; ++column) {
      const int point = ring_point(0, column, row);
      rim.push_back(column);
      numbers.push_back(point);
      section.points.emplace_back(mesh_.points[index(point)].head<2>());
    }
    add_o_grid(section, rim, lines_.around / 8, lines_.core_layers);
    for (std::size_t p = numbers.size(); p < section.points.size(); ++p) {
      numbers.push_back(static_cast<int>(mesh_.points.size()));
      mesh_.points.emplace_back(section.points[p].x(), section.points[p].y(), lines_.heights[index(row)]);
    }
    return section;
  }

  /// What the faces of a cell are part of if they are at the boundary.
  std::array<StirredPart, 6> parts_of(int ring, int row) const {
    const StirredPart pin = StirredPart::impeller;
    return {row == 0 ? StirredPart::base : pin,
            row == rows_ - 1 ? StirredPart::lid : pin,
            ring == rings_ - 1 ? StirredPart::shell : pin,
            pin,
            pin,
            pin};
  }

  void add_cells() {
    std::vector<int> lower, upper;
    if (lines_.shaft_end > 0) core_at(0, lower);
    for (int row = 0; row < rows_; ++row) {
      if (row < lines_.shaft_end) {
        upper.clear();
        const CrossSection section = core_at(row + 1, upper);
        for (const auto& quad : section.quads) {
          Hexahedron cell{};
          for (std::size_t i = 0; i < 4; ++i) {
            cell[i] = lower[index(quad[i])];
            cell[i + 4] = upper[index(quad[i])];
          }
          add_cell(cell, parts_of(-1, row));
        }
        lower = upper;
      }
      for (int ring = 0; ring < rings_; ++ring)
        for (int column = 0; column < lines_.around; ++column)
          if (!is_solid(ring, column, row)) add_ring_cell(ring, column, row);
    }
  }

  /// The third of its faces is the outer one.
  void add_ring_cell(int ring, int column, int row) {
    Hexahedron cell{};
    for (int up = 0; up < 2; ++up) {
      cell[index(4 * up)] = ring_point(ring + 1, column, row + up);
      cell[index(4 * up + 1)] = ring_point(ring + 1, column + 1, row + up);
      cell[index(4 * up + 2)] = ring_point(ring, column + 1, row + up);
      cell[index(4 * up + 3)] = ring_point(ring, column, row + up);
    }
    add_cell(cell, parts_of(ring, row));
  }

  void drop_unused_points() {
    std::vector<int> numbers(mesh_.points.size(), -1);
    for (const Hexahedron& cell : cells_)
      for (const int point : cell) numbers[index(point)] = 0;
    std::vector<Vector3d> kept;
    for (std::size_t p = 0; p < numbers.size(); ++p) {
      if (numbers[p] < 0) continue;
      numbers[p] = static_cast<int>(kept.size());
      kept.push_back(mesh_.points[p]);
    }
    mesh_.points = std::move(kept);
    for (Hexahedron& cell : cells_)
      for (int& point : cell) point = numbers[index(point)];
  }

  /// Faces of a cell, whose normals point out of it: below, above, and those over the four sides of its lower
  /// face, from the first on.
  static std::array<Quad, 6> faces_of(const Hexahedron& c) {
    return {{{c[0], c[3], c[2], c[1]},
             {c[4], c[5], c[6], c[7]},
             {c[0], c[1], c[5], c[4]},
             {c[1], c[2], c[6], c[5]},
             {c[2], c[3], c[7], c[6]},
             {c[3], c[0], c[4], c[7]}}};
  }

  void add_faces() {
    mesh_.cells = static_cast<int>(cells_.size());
    std::map<Quad, std::pair<int, int>> open;  // sorted points: cell and number of its face
    std::vector<std::tuple<int, int, Quad>> inner;
    for (std::size_t c = 0; c < cells_.size(); ++c) {
      const auto faces = faces_of(cells_[c]);
      for (int f = 0; f < 6; ++f) {
        Quad key = faces[index(f)];
        std::sort(key.begin(), key.end());
        const auto other = open.find(key);
        if (other == open.end()) {
          open.emplace(key, std::pair(static_cast<int>(c), f));
          continue;
        }
        const auto [cell, number] = other->second;
        inner.emplace_back(cell, static_cast<int>(c), faces_of(cells_[index(cell)])[index(number)]);
        open.erase(other);
      }
    }
    std::sort(inner.begin(), inner.end());
    for (const auto& [owner, neighbour, face] : inner) {
      mesh_.faces.push_back(face);
      mesh_.owner.push_back(owner);
      mesh_.neighbour.push_back(neighbour);
    }
    std::array<std::vector<std::pair<int, int>>, stirred_part_names.size()> walls;
    for (const auto& [key, side] : open)
      walls[static_cast<std::size_t>(parts_[index(side.first)][index(side.second)])].push_back(side);
    for (std::size_t part = 0; part < walls.size(); ++part) {
      std::sort(walls[part].begin(), walls[part].end());
      mesh_.patches.push_back({stirred_part_names[part], static_cast<int>(mesh_.faces.size()),
                               static_cast<int>(walls[part].size()), ""});
      for (const auto& [cell, number] : walls[part]) {
        mesh_.faces.push_back(faces_of(cells_[index(cell)])[index(number)]);
        mesh_.owner.push_back(cell);
      }
    }
  }

  const Geometry& geometry_;
  const Impeller& impeller_;
  StirredDivisions lines_;
  int rings_;  ///< of cells
  int rows_;   ///< of cells
  std::vector<GridArm> arms_;
  std::vector<Hexahedron> cells_;
  std::vector<std::array<StirredPart, 6>> parts_;  ///< of each cell's faces: what they are at the boundary
  VolumeMesh mesh_;
};

}  // namespace

VolumeMesh make_stirred_mesh(const Geometry& geometry, double cell_size) {
  return StirredMesh(geometry, cell_size).run();
}

}  // namespace millfoam::meshing
