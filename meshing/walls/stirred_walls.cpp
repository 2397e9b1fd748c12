// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/walls/stirred_walls.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "meshing/faces/polygon_filling.hpp"
#include "meshing/files/text_numbers.hpp"
#include "meshing/mill/stirred_geometry.hpp"
#include "meshing/surface/pi.hpp"

namespace millfoam::meshing {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Triangles = std::vector<std::array<int, 3>>;
using Loop =
    std::vector<int>;  // points around a circle, anticlockwise seen from outside of the body or above

/// Largest distance of a chord from its arc, over the shell's radius.
constexpr double sagitta = 1e-3;
/// Fewest sides of a round part.
constexpr int fewest_sides = 16;
/// Length of the shell's and the shaft's triangles along the axis, in sides of their circle.
constexpr double stretch = 5;
/// Distance of rows of points on the shaft's side, in sides of its circle.
constexpr double row_height = 4;
/// Of the map of the shaft's side: e to this power is still a number with room for others.
constexpr double largest_exponent = 300;
/// Distance of a point of the shaft's grid from a pin's edge below which it is left out, in sides.
constexpr double clearance = 0.7;

/// A multiple of four: the sides of a circle of a radius in a shell of another.
int sides_of(double radius, double shell) {
  const double half_angle = std::acos(std::max(1 - sagitta * shell / radius, 0.0));
  const int sides = static_cast<int>(std::ceil(pi / half_angle / 4)) * 4;
  return std::max(sides, fewest_sides);
}

/// An arm of the impeller: its level and the angle of its axis, rad.
struct Arm {
  const PinLevel* level;
  double angle;
};

std::vector<Arm> arms_of(const Impeller& impeller) {
  std::vector<Arm> arms;
  for (const PinLevel& level : impeller.pins)
    for (int i = 0; i < level.arms; ++i)
      arms.push_back({&level, level.angle * pi / 180 + 2 * pi * i / level.arms});
  return arms;
}

/// Where an arm leaves the shaft: the points around it.
struct Hole {
  Arm arm;
  Loop loop;
};

/// A piece of the shaft's side without discs: heights of its ends, m, and the points around them.
struct Piece {
  double bottom, top;
  Loop low, high;
};

class Builder {
 public:
  explicit Builder(const Geometry& geometry)
      : impeller_(*geometry.impeller), radius_(geometry.radius()), height_(geometry.length) {
    for (const char* name : {"impeller", "shell", "base", "lid"}) surface_.parts.push_back({name, {}});
  }

  WallSurface run() && {
    add_shell();
    add_impeller();
    add_lid();
    return std::move(surface_);
  }

 private:
  Triangles& part(std::size_t number) { return surface_.parts[number].triangles; }

  int add(const Vector3d& point) {
    surface_.points.push_back(point);
    return static_cast<int>(surface_.points.size()) - 1;
  }

  const Vector3d& point(int number) const { return surface_.points[static_cast<std::size_t>(number)]; }

  /// Points on a circle about the axis.
  Loop add_circle(double radius, double z, int sides) {
    Loop loop;
    for (int i = 0; i < sides; ++i) {
      const double angle = 2 * pi * i / sides;
      loop.push_back(add({radius * std::cos(angle), radius * std::sin(angle), z}));
    }
    return loop;
  }

  /// Triangles between two loops of as many points: their normals point to the right of the first loop's way
  /// with the second loop ahead of it, which is outwards for a circle and one above it.
  static void join(const Loop& first, const Loop& second, Triangles& triangles) {
    for (std::size_t i = 0; i < first.size(); ++i) {
      const std::size_t next = (i + 1) % first.size();
      triangles.push_back({first[i], first[next], second[next]});
      triangles.push_back({first[i], second[next], second[i]});
    }
  }

  /// Fills the ring, or the disc where `inner` is empty, between two horizontal loops. Normals point up, or
  /// down.
  void fill(const Loop& outer, const Loop& inner, bool up, Triangles& triangles) {
    std::vector<Vector2d> flat;
    std::vector<int> numbers;
    std::vector<std::array<int, 2>> edges;
    const double z = point(outer.front()).z();
    for (const Loop* loop : {&outer, &inner}) {
      const int first = static_cast<int>(flat.size());
      const int count = static_cast<int>(loop->size());
      for (int i = 0; i < count; ++i) {
        numbers.push_back((*loop)[static_cast<std::size_t>(i)]);
        flat.push_back(point(numbers.back()).head<2>());
        edges.push_back({first + i, first + (i + 1) % count});
      }
    }
    const double hole = inner.empty() ? 0 : point(inner.front()).head<2>().norm();
    for (const Vector2d& extra : points_between(flat.front().norm(), hole, static_cast<int>(outer.size()))) {
      flat.push_back(extra);
      numbers.push_back(add({extra.x(), extra.y(), z}));
    }
    for (auto [a, b, c] : fill_polygon(flat, edges)) {
      if (!up) std::swap(b, c);
      triangles.push_back({numbers[static_cast<std::size_t>(a)], numbers[static_cast<std::size_t>(b)],
                           numbers[static_cast<std::size_t>(c)]});
    }
  }

  /// Rings of points inside a circle of so many sides and outside of a hole, coarser inwards; the axis where
  /// there is no hole.
  static std::vector<Vector2d> points_between(double outer, double hole, int sides) {
    std::vector<Vector2d> points;
    double spacing = 2 * pi * outer / sides;
    double radius = outer - spacing;
    while (radius > hole + 0.8 * spacing && radius > 0.75 * spacing) {
      const int around = std::max(6, static_cast<int>(std::lround(2 * pi * radius / spacing)));
      for (int i = 0; i < around; ++i) {
        const double angle = 2 * pi * (i + 0.5) / around;
        points.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
      }
      spacing *= 1.3;
      radius -= 0.85 * spacing;
    }
    if (hole == 0) points.emplace_back(0, 0);
    return points;
  }

  void add_shell() {
    const int sides = sides_of(radius_, radius_);
    const double side = 2 * pi * radius_ / sides;
    const int layers = std::max(1, static_cast<int>(std::lround(height_ / (stretch * side))));
    Loop below = add_circle(radius_, 0, sides);
    fill(below, {}, false, part(2));
    for (int layer = 1; layer <= layers; ++layer) {
      const double z = layer == layers ? height_ : height_ * layer / layers;
      Loop above = add_circle(radius_, z, sides);
      join(below, above, part(1));
      below = std::move(above);
    }
    rim_ = below;
  }

  /// The hole of an arm in the shaft's side: around its axis, anticlockwise seen from outside.
  Loop add_root(const Arm& arm, int sides) {
    const double r = impeller_.shaft_diameter / 2, half = arm.level->thickness / 2;
    Loop loop;
    for (int i = 0; i < sides; ++i) {
      const double around = 2 * pi * (i + 0.5) / sides;
      const double across = half * std::cos(around);
      const double angle = arm.angle + std::asin(across / r);
      loop.push_back(
          add({r * std::cos(angle), r * std::sin(angle), arm.level->height + half * std::sin(around)}));
    }
    return loop;
  }

  /// The side and the tip of an arm from its root on. The impeller's normals point into it, out of the balls'
  /// space.
  void add_arm(const Arm& arm, const Loop& root) {
    const double half = arm.level->thickness / 2, tip = arm.level->length / 2;
    const Vector3d along(std::cos(arm.angle), std::sin(arm.angle), 0);
    const double side = 2 * pi * half / static_cast<double>(root.size());
    const double reach = tip - impeller_.shaft_diameter / 2;
    const int rings = std::max(1, static_cast<int>(std::lround(reach / (stretch * side))));
    Loop before = root;
    for (int ring = 1; ring <= rings; ++ring) {
      const double share = static_cast<double>(ring) / rings;
      Loop next;
      for (const int number : root) {
        const Vector3d start = point(number);
        next.push_back(add(start + share * (tip - start.dot(along)) * along));
      }
      // Seen from outside the loops are anticlockwise and the next one is nearer: normals point inwards
      join(next, before, part(0));
      before = std::move(next);
    }
    const int middle = add(tip * along + Vector3d(0, 0, arm.level->height));
    Loop inner;
    for (const int number : before) inner.push_back(add((point(number) + point(middle)) / 2));
    join(inner, before, part(0));
    for (std::size_t i = 0; i < inner.size(); ++i)
      part(0).push_back({middle, inner[(i + 1) % inner.size()], inner[i]});
  }

  /// The faces and the rim of a disc. Its faces are rings around the points where it meets the shaft, or a
  /// whole circle where there are none. The impeller's normals point into it.
  void add_disc(const Disc& disc, const Loop& shaft_below, const Loop& shaft_above) {
    const double outer = disc.diameter / 2;
    const int sides = sides_of(outer, radius_);
    const Loop below = add_circle(outer, disc.height - disc.thickness / 2, sides);
    const Loop above = add_circle(outer, disc.height + disc.thickness / 2, sides);
    fill(below, shaft_below, true, part(0));
    fill(above, shaft_above, false, part(0));
    join(above, below, part(0));
  }

  /// Adds the discs and returns the pieces of the shaft's side between them, upwards.
  std::vector<Piece> add_discs(int sides) {
    const double r = impeller_.shaft_diameter / 2;
    std::vector<Disc> discs = impeller_.discs;
    std::sort(discs.begin(), discs.end(), [](const Disc& a, const Disc& b) { return a.height < b.height; });
    std::vector<Piece> pieces;
    double bottom = impeller_.shaft_end;
    Loop low;
    if (discs.empty() || !is_at_shaft_end(discs.front(), impeller_)) {
      low = add_circle(r, bottom, sides);
      fill(low, {}, true, part(0));
    }
    for (const Disc& disc : discs) {
      const double end = disc.height - disc.thickness / 2, begin = disc.height + disc.thickness / 2;
      const Loop below = low.empty() ? Loop() : add_circle(r, end, sides);
      Loop above = add_circle(r, begin, sides);
      add_disc(disc, below, above);
      if (!low.empty()) pieces.push_back({bottom, end, low, below});
      bottom = begin;
      low = std::move(above);
    }
    shaft_rim_ = add_circle(r, height_, sides);
    pieces.push_back({bottom, height_, low, shaft_rim_});
    return pieces;
  }

  void add_impeller() {
    const std::vector<Piece> pieces = add_discs(sides_of(impeller_.shaft_diameter / 2, radius_));
    std::vector<Hole> holes;
    for (const Arm& arm : arms_of(impeller_))
      holes.push_back({arm, add_root(arm, sides_of(arm.level->thickness / 2, radius_))});
    for (const Hole& hole : holes) add_arm(hole.arm, hole.loop);
    for (const Piece& piece : pieces) {
      std::vector<Hole> own;
      std::copy_if(holes.begin(), holes.end(), std::back_inserter(own), [&](const Hole& hole) {
        return hole.arm.level->height > piece.bottom && hole.arm.level->height < piece.top;
      });
      fill_shaft(piece, own);
    }
  }

  /// A point of a piece of the shaft's side in the plane: a ring about the axis whose radius grows with the
  /// height, so that the side has no seam. The map keeps angles, unless the piece is very long.
  Vector2d unrolled(const Vector3d& at, const Piece& piece) const {
    const double r = impeller_.shaft_diameter / 2;
    const double steep = std::min(1 / r, largest_exponent / (piece.top - piece.bottom));
    return std::exp(steep * (at.z() - piece.bottom)) * at.head<2>().normalized();
  }

  /// Whether a point of the shaft's side lies off all holes by some sides of the shaft's circle.
  static bool is_clear(const Vector3d& at, const std::vector<Hole>& holes, double side) {
    return std::all_of(holes.begin(), holes.end(), [&](const Hole& hole) {
      const Vector2d along(std::cos(hole.arm.angle), std::sin(hole.arm.angle));
      if (at.head<2>().dot(along) < 0) return true;
      const double across = along.x() * at.y() - along.y() * at.x();
      const double away = std::hypot(across, at.z() - hole.arm.level->height);
      return away > hole.arm.level->thickness / 2 + clearance * side;
    });
  }

  /// A piece of the shaft's side, with the holes in it.
  void fill_shaft(const Piece& piece, const std::vector<Hole>& holes) {
    const double r = impeller_.shaft_diameter / 2;
    const int sides = static_cast<int>(piece.low.size());
    const double side = 2 * pi * r / sides;
    std::vector<int> numbers;
    std::vector<std::array<int, 2>> edges;
    const auto take_loop = [&](const Loop& loop) {
      const int first = static_cast<int>(numbers.size());
      const int count = static_cast<int>(loop.size());
      for (int i = 0; i < count; ++i) edges.push_back({first + i, first + (i + 1) % count});
      numbers.insert(numbers.end(), loop.begin(), loop.end());
    };
    take_loop(piece.low);
    take_loop(piece.high);
    for (const Hole& hole : holes) take_loop(hole.loop);
    const double length = piece.top - piece.bottom;
    // Between discs that are closer than a side there is no room for points
    const int fewest = length < side ? 1 : 2;
    const int rows = std::max(fewest, static_cast<int>(std::lround(length / (row_height * side))));
    for (int row = 1; row < rows; ++row)
      for (int i = 0; i < sides; ++i) {
        const double angle = 2 * pi * (i + 0.5 * (row % 2)) / sides;
        const Vector3d at(r * std::cos(angle), r * std::sin(angle), piece.bottom + length * row / rows);
        if (is_clear(at, holes, side)) numbers.push_back(add(at));
      }
    std::vector<Vector2d> flat;
    flat.reserve(numbers.size());
    for (const int number : numbers) flat.push_back(unrolled(point(number), piece));
    // Anticlockwise there is into the shaft here
    for (const auto& [a, b, c] : fill_polygon(flat, edges))
      part(0).push_back({numbers[static_cast<std::size_t>(a)], numbers[static_cast<std::size_t>(b)],
                         numbers[static_cast<std::size_t>(c)]});
  }

  void add_lid() { fill(rim_, shaft_rim_, true, part(3)); }

  const Impeller& impeller_;
  double radius_;
  double height_;
  Loop rim_;        // of the shell, at the lid
  Loop shaft_rim_;  // of the shaft, at the lid
  WallSurface surface_;
};

}  // namespace

WallSurface make_stirred_walls(const Geometry& geometry) {
  return Builder(geometry).run();
}

void require_stirred_volume(double of_walls, double closed_form) {
  const double error = std::abs(of_walls / closed_form - 1);
  if (error <= allowed_stirred_volume_error) return;
  throw std::runtime_error("the walls enclose " + shown(of_walls) + " m^3, expected " + shown(closed_form) +
                           " m^3 within " + shown(100 * allowed_stirred_volume_error) + " %");
}

}  // namespace millfoam::meshing
