// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/wall_fit.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>

#include "meshing/surface/pi.hpp"

namespace millfoam::dem_driver {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int directions = 360;
constexpr int circle_steps = 5000;
constexpr double circle_accuracy = 1e-3;  // of the radius

/// The point of all walls that lies farthest in a direction, and the wall that has it.
struct Extreme {
  Vector3d point = Vector3d::Zero();
  const Wall* wall = nullptr;
};

Extreme farthest(const std::vector<Wall>& walls, const Vector3d& direction) {
  Extreme found;
  for (const Wall& wall : walls)
    for (const Vector3d& point : wall.surface.points)
      if (found.wall == nullptr || point.dot(direction) > found.point.dot(direction)) found = {point, &wall};
  return found;
}

/// Seen along the axis.
struct Circle {
  Vector2d centre = Vector2d::Zero();
  Extreme farthest;  ///< from the centre
  double radius() const { return (farthest.point.head<2>() - centre).norm(); }
};

/// The smallest circle around all walls, to a thousandth: the centre goes by ever smaller steps towards the
/// point that is farthest from it. M. Badoiu & K. L. Clarkson, Proc. SODA (2003) 801.
Circle circle_around(const std::vector<Wall>& walls) {
  std::vector<Extreme> rim;
  for (int i = 0; i < directions; ++i) {
    const double angle = 2 * pi * i / directions;
    rim.push_back(farthest(walls, {std::cos(angle), std::sin(angle), 0}));
  }
  Circle circle;
  for (int step = 1; step <= circle_steps; ++step) {
    circle.farthest = *std::max_element(rim.begin(), rim.end(), [&](const Extreme& a, const Extreme& b) {
      return (a.point.head<2>() - circle.centre).squaredNorm() <
             (b.point.head<2>() - circle.centre).squaredNorm();
    });
    circle.centre += (circle.farthest.point.head<2>() - circle.centre) / (step + 1);
  }
  return circle;
}

std::string box_in_words(const std::vector<Wall>& walls) {
  std::ostringstream text;
  text.precision(4);
  const char* axes = "xyz";
  for (int i = 0; i < 3; ++i)
    text << (i > 0 ? ", " : "") << axes[i] << " from " << farthest(walls, -Vector3d::Unit(i)).point[i]
         << " to " << farthest(walls, Vector3d::Unit(i)).point[i];
  return text.str() + " m";
}

[[noreturn]] void refuse(const Extreme& extreme, const std::string& what, const std::vector<Wall>& walls,
                         const meshing::Geometry& geometry) {
  std::ostringstream text;
  text.precision(4);
  text << extreme.wall->file.string() << ": " << what << " (all walls: " << box_in_words(walls)
       << "), expected the walls of mill.yaml: radius " << geometry.radius() << " m, z from 0 to "
       << geometry.length << " m, coordinates in m, axis x = y = 0";
  throw std::runtime_error(text.str());
}

}  // namespace

void require_fit(const std::vector<Wall>& walls, const meshing::Geometry& geometry) {
  const Circle circle = circle_around(walls);
  const double allowed = allowed_misfit * geometry.radius();
  std::ostringstream found;
  found.precision(4);
  if (std::abs(circle.radius() - geometry.radius()) > allowed) {
    found << "the walls have a radius of " << circle.radius() << " m";
    refuse(circle.farthest, found.str(), walls, geometry);
  }
  if (circle.centre.norm() > allowed) {
    const double unit = circle_accuracy * geometry.radius();
    const auto rounded = [&](double value) { return std::round(value / unit) * unit + 0.0; };
    found << "the walls' axis is x = " << rounded(circle.centre.x()) << ", y = " << rounded(circle.centre.y())
          << " m";
    refuse(circle.farthest, found.str(), walls, geometry);
  }
  const Extreme low = farthest(walls, -Vector3d::UnitZ()), high = farthest(walls, Vector3d::UnitZ());
  const double off = allowed_misfit * geometry.length;
  found << "the walls reach from z = " << low.point.z() << " to " << high.point.z() << " m";
  if (std::abs(low.point.z()) > off) refuse(low, found.str(), walls, geometry);
  if (std::abs(high.point.z() - geometry.length) > off) refuse(high, found.str(), walls, geometry);
}

EndCover cover_of_ends(const std::vector<Wall>& walls, const meshing::Geometry& geometry) {
  const double section = pi * geometry.radius() * geometry.radius();
  EndCover cover;
  for (const Wall& wall : walls)
    for (const auto& polygon : wall.surface.polygons) {
      const auto corner = [&](std::size_t i) -> const Vector3d& {
        return wall.surface.points[static_cast<std::size_t>(polygon.points[i])];
      };
      const double area = std::abs((corner(1) - corner(0)).cross(corner(2) - corner(0)).z()) / 2;
      const double middle = (corner(0).z() + corner(1).z() + corner(2).z()) / 3;
      (middle < geometry.length / 2 ? cover.feed : cover.discharge) += area / section;
    }
  return cover;
}

}  // namespace millfoam::dem_driver
