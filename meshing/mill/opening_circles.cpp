// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/mill/opening_circles.hpp"

#include <algorithm>

#include "meshing/mill/mill_shape.hpp"
#include "meshing/surface/pi.hpp"

namespace millfoam::meshing {

std::vector<double> opening_circles(const Geometry& geometry) {
  if (!geometry.circles_of_whole.empty()) return geometry.circles_of_whole;
  std::vector<double> circles;
  if (geometry.inlet && geometry.inlet->radius >= smallest_circle * lifter_top_distance(geometry)) {
    circles.push_back(geometry.inlet->radius);
  }
  if (geometry.grates) {
    circles.push_back(geometry.grates->inner_radius);
    circles.push_back(geometry.grates->outer_radius);
  }
  if (geometry.pulp_lifters) circles.push_back(geometry.pulp_lifters->discharge_radius);
  std::sort(circles.begin(), circles.end());
  circles.erase(
      std::unique(circles.begin(), circles.end(), [](double a, double b) { return b - a < same_circle * b; }),
      circles.end());
  return circles;
}

double asked_inlet_area(const Geometry& geometry) {
  return geometry.inlet ? pi * geometry.inlet->radius * geometry.inlet->radius : 0;
}

double asked_grate_area(const Geometry& geometry) {
  if (!geometry.grates) return 0;
  const Grates& g = *geometry.grates;
  return pi * (g.outer_radius * g.outer_radius - g.inner_radius * g.inner_radius) * g.sector_share;
}

}  // namespace millfoam::meshing
