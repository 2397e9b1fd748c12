// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/mill_mesh/o_grid.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "meshing/surface/pi.hpp"

namespace millfoam::meshing {
namespace {

using Eigen::Vector2d;

const double side_turn = pi / 6;        ///< angle by which a side of the core turns
constexpr double corner_radius = 0.75;  ///< of the core's corners, in units of the rim's smallest radius

/// Points of the arc from `from` to `to` that bulges to the right of its chord and turns by `side_turn`; n +
/// 1 of them.
std::vector<Vector2d> arc(const Vector2d& from, const Vector2d& to, int n) {
  const Vector2d chord = to - from;
  const Vector2d right(chord.y(), -chord.x());
  const Vector2d centre = (from + to) / 2 - right / (2 * std::tan(side_turn / 2));
  std::vector<Vector2d> points;
  for (int i = 0; i <= n; ++i) {
    points.push_back(centre + Eigen::Rotation2Dd(side_turn * i / n) * (from - centre));
  }
  points.back() = to;
  return points;
}

/// Indices of the core's points, (side + 1)^2 of them, row by row.
struct Core {
  int first;  ///< index of point (0, 0)
  int side;
  int at(int i, int j) const { return first + i * (side + 1) + j; }
  /// The p-th point of the boundary, anticlockwise from (side, 0).
  int boundary(int p) const {
    const int along = p % side;
    switch (p / side % 4) {
      case 0:
        return at(side, along);
      case 1:
        return at(side - along, side);
      case 2:
        return at(0, side - along);
      default:
        return at(along, 0);
    }
  }
};

void place_boundary(CrossSection& section, const Core& core, const std::vector<Vector2d>& rim) {
  const int side = core.side;
  double smallest = rim.front().norm();
  for (const Vector2d& point : rim) smallest = std::min(smallest, point.norm());
  const auto corner = [&](int k) -> Vector2d {
    const int p = k % 4 * side;
    return corner_radius * smallest * rim[static_cast<std::size_t>(p)].normalized();
  };
  for (int k = 0; k < 4; ++k) {
    const auto points = arc(corner(k), corner(k + 1), side);
    for (int i = 0; i < side; ++i) {
      section.points[static_cast<std::size_t>(core.boundary(k * side + i))] =
          points[static_cast<std::size_t>(i)];
    }
  }
}

/// The Coons patch of the four sides.
void place_inside(CrossSection& section, const Core& core) {
  const int n = core.side;
  const auto at = [&](int i, int j) -> Vector2d& {
    return section.points[static_cast<std::size_t>(core.at(i, j))];
  };
  for (int i = 1; i < n; ++i) {
    for (int j = 1; j < n; ++j) {
      const double u = static_cast<double>(i) / n;
      const double v = static_cast<double>(j) / n;
      at(i, j) = (1 - u) * at(0, j) + u * at(n, j) + (1 - v) * at(i, 0) + v * at(i, n) -
                 (1 - u) * ((1 - v) * at(0, 0) + v * at(0, n)) - u * ((1 - v) * at(n, 0) + v * at(n, n));
    }
  }
}

}  // namespace

RingThickness ring_thickness(double radius) {
  const double corner = corner_radius * radius;
  const double middle = corner / std::sqrt(2.0) * (1 + std::tan(side_turn / 4));
  return {radius - corner, radius - middle};
}

double ring_layers(double radius, int side) {
  const RingThickness thickness = ring_thickness(radius);
  const double chord = std::sqrt(2.0) * corner_radius * radius;
  const double width = (pi / 2 * radius + chord) / 2 / side;
  return (thickness.least + thickness.most) / 2 / width;
}

double radius_inside_halving(double radius, int around) {
  return radius * (1 - 4 * pi / around);
}

std::vector<int> add_halving(CrossSection& section, const std::vector<int>& outer, int first) {
  const std::size_t around = outer.size();
  assert(around % 8 == 0 && static_cast<double>(around) > 4 * pi);
  std::vector<int> ring(outer);
  std::rotate(ring.begin(), ring.begin() + first % static_cast<int>(around), ring.end());
  const double inner_share = radius_inside_halving(1, static_cast<int>(around));
  const auto add_inside = [&](std::size_t p, double share) {
    section.points.push_back(share * section.points[static_cast<std::size_t>(ring[p % around])]);
    return static_cast<int>(section.points.size()) - 1;
  };
  std::vector<int> inner;
  for (std::size_t p = 0; p < around; p += 2) inner.push_back(add_inside(p, inner_share));
  for (std::size_t p = 0; p < around; p += 4) {
    std::array<int, 5> o{};
    for (std::size_t i = 0; i < 5; ++i) o[i] = ring[(p + i) % around];
    const std::array<int, 3> in = {inner[p / 2], inner[p / 2 + 1], inner[(p / 2 + 2) % inner.size()]};
    std::array<int, 3> m{};
    for (std::size_t i = 0; i < 3; ++i) m[i] = add_inside(p + i + 1, (1 + inner_share) / 2);
    for (const std::array<int, 4>& quad : {std::array{in[0], o[0], o[1], m[0]},
                                           {m[0], o[1], o[2], m[1]},
                                           {in[0], m[0], m[1], in[1]},
                                           {m[1], o[2], o[3], m[2]},
                                           {m[2], o[3], o[4], in[2]},
                                           {in[1], m[1], m[2], in[2]}}) {
      section.quads.push_back(quad);
      section.columns.push_back(-1);
    }
  }
  return inner;
}

void add_o_grid(CrossSection& section, const std::vector<int>& rim, int first_corner, int layers) {
  const int around = static_cast<int>(rim.size());
  assert(around % 4 == 0);
  std::vector<int> outer(rim);
  std::rotate(outer.begin(), outer.begin() + first_corner % around, outer.end());
  std::vector<Vector2d> outer_points;
  outer_points.reserve(rim.size());
  for (int p : outer) outer_points.push_back(section.points[static_cast<std::size_t>(p)]);

  const Core core{static_cast<int>(section.points.size()), around / 4};
  section.points.resize(section.points.size() + static_cast<std::size_t>((core.side + 1) * (core.side + 1)));
  place_boundary(section, core, outer_points);
  place_inside(section, core);
  for (int i = 0; i < core.side; ++i) {
    for (int j = 0; j < core.side; ++j) {
      section.quads.push_back({core.at(i, j), core.at(i + 1, j), core.at(i + 1, j + 1), core.at(i, j + 1)});
      section.columns.push_back(-1);
    }
  }
  std::vector<int> inner;
  inner.reserve(rim.size());
  for (int p = 0; p < around; ++p) inner.push_back(core.boundary(p));
  add_band(section, inner, outer, layers, first_corner);
}

void add_band(CrossSection& section, const std::vector<int>& inner, const std::vector<int>& outer, int layers,
              int first_column) {
  const std::size_t around = outer.size();
  const int first = static_cast<int>(section.points.size());
  for (int layer = 1; layer < layers; ++layer) {
    const double share = static_cast<double>(layer) / layers;
    for (std::size_t p = 0; p < around; ++p) {
      const Vector2d from = section.points[static_cast<std::size_t>(inner[p])];
      section.points.push_back((1 - share) * from +
                               share * section.points[static_cast<std::size_t>(outer[p])]);
    }
  }
  const auto at = [&](int layer, std::size_t p) {
    if (layer == 0) return inner[p % around];
    if (layer == layers) return outer[p % around];
    return first + (layer - 1) * static_cast<int>(around) + static_cast<int>(p % around);
  };
  for (int layer = 0; layer < layers; ++layer) {
    for (std::size_t p = 0; p < around; ++p) {
      section.quads.push_back({at(layer, p), at(layer + 1, p), at(layer + 1, p + 1), at(layer, p + 1)});
      section.columns.push_back((first_column + static_cast<int>(p)) % static_cast<int>(around));
    }
  }
}

}  // namespace millfoam::meshing
