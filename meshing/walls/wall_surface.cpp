// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/walls/wall_surface.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "meshing/faces/polygon_filling.hpp"
#include "meshing/surface/pi.hpp"

namespace millfoam::meshing {
namespace {

using Eigen::Vector2d;

/// Longest side of a triangle along the axis, in units of the outline's longest side.
constexpr double axial_stretch = 4;

/// The closed polygon around a cross-section: its points renumbered, its sides with the interior to their
/// left.
struct Outline {
  std::vector<Vector2d> points;
  std::vector<CrossSection::WallEdge> edges;
  double longest_edge = 0;     ///< m
  double smallest_radius = 0;  ///< m
};

Outline find_outline(const CrossSection& section) {
  Outline outline;
  std::map<int, int> renumbered;
  for (CrossSection::WallEdge edge : section.walls) {
    for (int& p : edge.points) {
      const auto [entry, is_new] = renumbered.emplace(p, static_cast<int>(outline.points.size()));
      if (is_new) outline.points.push_back(section.points[static_cast<std::size_t>(p)]);
      p = entry->second;
    }
    outline.edges.push_back(edge);
    const Vector2d& from = outline.points[static_cast<std::size_t>(edge.points[0])];
    const Vector2d& to = outline.points[static_cast<std::size_t>(edge.points[1])];
    outline.longest_edge = std::max(outline.longest_edge, (to - from).norm());
  }
  outline.smallest_radius = outline.points.front().norm();
  for (const Vector2d& point : outline.points) {
    outline.smallest_radius = std::min(outline.smallest_radius, point.norm());
  }
  return outline;
}

/// Rings of points about the axis that grow coarser inwards, and the axis itself.
std::vector<Vector2d> points_inside(const Outline& outline) {
  std::vector<Vector2d> points;
  double spacing = 2 * outline.longest_edge;
  double radius = outline.smallest_radius - spacing;
  while (radius > 0.75 * spacing) {
    const int around = std::max(6, static_cast<int>(std::lround(2 * pi * radius / spacing)));
    for (int i = 0; i < around; ++i) {
      const double angle = 2 * pi * i / around;
      points.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    }
    spacing *= 1.5;
    radius -= 0.85 * spacing;
  }
  points.emplace_back(0, 0);
  return points;
}

class Builder {
 public:
  Builder(const CrossSection& section, double length) : outline_(find_outline(section)), length_(length) {
    layers_ = std::max(1, static_cast<int>(std::lround(length / (axial_stretch * outline_.longest_edge))));
    for (int level = 0; level <= layers_; ++level) {
      const double z = level == layers_ ? length : length * level / layers_;
      for (const Vector2d& point : outline_.points) surface_.points.emplace_back(point.x(), point.y(), z);
    }
  }

  WallSurface run() && {
    add_side("shell", CrossSection::Part::shell);
    add_side("lifters", CrossSection::Part::lifters);
    add_ends();
    return std::move(surface_);
  }

 private:
  int point(int level, int p) const { return level * static_cast<int>(outline_.points.size()) + p; }

  void add_side(const std::string& name, CrossSection::Part part) {
    surface_.parts.push_back({name, {}});
    auto& triangles = surface_.parts.back().triangles;
    for (const auto& edge : outline_.edges) {
      if (edge.part != part) continue;
      const auto [from, to] = edge.points;
      for (int layer = 0; layer < layers_; ++layer) {
        triangles.push_back({point(layer, from), point(layer, to), point(layer + 1, to)});
        triangles.push_back({point(layer, from), point(layer + 1, to), point(layer + 1, from)});
      }
    }
  }

  void add_ends() {
    std::vector<Vector2d> points = outline_.points;
    const int on_outline = static_cast<int>(points.size());
    const std::vector<Vector2d> inside = points_inside(outline_);
    points.insert(points.end(), inside.begin(), inside.end());
    std::vector<std::array<int, 2>> edges;
    for (const auto& edge : outline_.edges) edges.push_back(edge.points);
    const auto triangles = fill_polygon(points, edges);

    for (const int level : {0, layers_}) {
      const int first_inside = static_cast<int>(surface_.points.size());
      for (const Vector2d& p : inside) surface_.points.emplace_back(p.x(), p.y(), level == 0 ? 0 : length_);
      const auto of_section = [&](int p) {
        return p < on_outline ? point(level, p) : first_inside + p - on_outline;
      };
      surface_.parts.push_back({level == 0 ? "feedEnd" : "dischargeEnd", {}});
      for (auto [a, b, c] : triangles) {
        if (level == 0) std::swap(b, c);
        surface_.parts.back().triangles.push_back({of_section(a), of_section(b), of_section(c)});
      }
    }
  }

  Outline outline_;
  double length_;
  int layers_;
  WallSurface surface_;
};

}  // namespace

WallSurface make_wall_surface(const CrossSection& section, double length) {
  return Builder(section, length).run();
}

}  // namespace millfoam::meshing
