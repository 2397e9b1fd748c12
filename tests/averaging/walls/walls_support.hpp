// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "averaging/walls/surface.hpp"
#include "tests/averaging/test_support.hpp"

/// Surfaces made in memory.
namespace millfoam::averaging {

/// The prism over a polygon (anticlockwise) from z = bottom to top; its ends may be left out.
inline Surface prism(const std::vector<Eigen::Vector2d>& outline, double bottom, double top,
                     bool ends = true) {
  Surface result;
  const auto n = static_cast<int>(outline.size());
  for (const double z : {bottom, top}) {
    for (const Eigen::Vector2d& point : outline) result.points.emplace_back(point.x(), point.y(), z);
  }
  for (int a = 0; a < n; ++a) {
    const int b = (a + 1) % n;
    result.triangles.push_back({a, b, n + b});
    result.triangles.push_back({a, n + b, n + a});
    if (ends && a > 0 && b > 0) {
      result.triangles.push_back({0, b, a});
      result.triangles.push_back({n, n + a, n + b});
    }
  }
  return result;
}

inline Surface box_surface(const Eigen::Vector3d& lower, const Eigen::Vector3d& upper) {
  return prism(
      {{lower.x(), lower.y()}, {upper.x(), lower.y()}, {upper.x(), upper.y()}, {lower.x(), upper.y()}},
      lower.z(), upper.z());
}

/// A regular polygon of `corners` corners with its first one on +x.
inline std::vector<Eigen::Vector2d> regular_polygon(int corners, double radius) {
  std::vector<Eigen::Vector2d> result;
  for (int c = 0; c < corners; ++c) {
    const double angle = 2 * pi * c / corners;
    result.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return result;
}

/// A ball of flat triangles about a centre, its corners on the sphere.
inline Surface ball_surface(const Eigen::Vector3d& centre, double radius, int meridians) {
  Surface result;
  const int rings = meridians / 2 - 1;
  const auto add = [&](double latitude, double longitude) {
    result.points.emplace_back(centre + radius * Eigen::Vector3d(std::cos(latitude) * std::cos(longitude),
                                                                 std::cos(latitude) * std::sin(longitude),
                                                                 std::sin(latitude)));
  };
  for (int r = 0; r < rings; ++r) {
    for (int m = 0; m < meridians; ++m)
      add(pi * ((r + 1.0) / (rings + 1) - 0.5), 2 * pi * (m + 0.3) / meridians);
  }
  const auto south = static_cast<int>(result.points.size()), north = south + 1;
  add(-pi / 2, 0);
  add(pi / 2, 0);
  for (int m = 0; m < meridians; ++m) {
    const int next = (m + 1) % meridians, last = (rings - 1) * meridians;
    result.triangles.push_back({south, next, m});
    result.triangles.push_back({north, last + m, last + next});
    for (int r = 0; r + 1 < rings; ++r) {
      const int row = r * meridians;
      result.triangles.push_back({row + m, row + next, row + meridians + next});
      result.triangles.push_back({row + m, row + meridians + next, row + meridians + m});
    }
  }
  return result;
}

/// Text of an ASCII STL.
inline std::string stl_text(const Surface& surface, const std::string& name = "wall") {
  std::ostringstream text;
  text.precision(17);
  text << "solid " << name << '\n';
  for (const auto& triangle : surface.triangles) {
    text << "  facet normal 0 0 0\n    outer loop\n";
    for (const int corner : triangle) {
      const Eigen::Vector3d& p = surface.points[static_cast<std::size_t>(corner)];
      text << "      vertex " << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
    }
    text << "    endloop\n  endfacet\n";
  }
  text << "endsolid " << name << '\n';
  return text.str();
}

/// Only some of a surface's triangles.
inline Surface part_of(const Surface& surface, std::size_t first, std::size_t end) {
  Surface part;
  part.points = surface.points;
  part.triangles.assign(surface.triangles.begin() + static_cast<std::ptrdiff_t>(first),
                        surface.triangles.begin() + static_cast<std::ptrdiff_t>(end));
  return part;
}

/// A binary STL file of a surface.
inline std::string binary_stl(const Surface& surface) {
  std::string bytes = "solid that is binary";
  bytes.resize(80);
  const auto put = [&](const auto& value) {
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    bytes.append(raw, sizeof value);
  };
  put(static_cast<std::uint32_t>(surface.triangles.size()));
  for (const auto& triangle : surface.triangles) {
    bytes.append(12, '\0');
    for (const int corner : triangle) {
      for (const double x : surface.points[static_cast<std::size_t>(corner)]) put(static_cast<float>(x));
    }
    bytes.append(2, '\0');
  }
  return bytes;
}

/// Why STL files are refused.
inline std::string refusal(const std::vector<std::filesystem::path>& files) {
  return message_of<SurfaceError>([&] { read_surface(files); });
}

}  // namespace millfoam::averaging
