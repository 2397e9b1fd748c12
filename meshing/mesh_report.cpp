// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/mesh_report.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "meshing/mill_shape.hpp"
#include "meshing/pi.hpp"

namespace millfoam::meshing {
namespace {

/// Solidity of a charge in motion, for the advice only.
constexpr double charge_solidity = 0.5;

template <typename... Values>
std::string line(const char* format, Values... values) {
  std::array<char, 400> text{};
  std::snprintf(text.data(), text.size(), format, values...);
  return std::string(text.data()) + '\n';
}

std::string quality_line(const char* what, const char* format, double value, double limit) {
  const std::string row = std::string("%-24s ") + format + " (limit %g)%s";
  return line(row.c_str(), what, value, limit, value <= limit ? "" : ": too large");
}

std::string area_line(const char* what, double area, double asked) {
  return line("%-24s %.5g cm^2 (asked for %.5g, relative error %.2e)", what, 1e4 * area, 1e4 * asked,
              area / asked - 1);
}

std::string openings_lines(const Geometry& geometry, const Openings& openings) {
  std::string text;
  if (geometry.inlet) text += area_line("inlet", openings.inlet_area, asked_inlet_area(geometry));
  if (geometry.grates) text += area_line("grates", openings.grate_area, asked_grate_area(geometry));
  if (geometry.pulp_lifters) {
    const double radius = geometry.pulp_lifters->discharge_radius;
    text += area_line("outlet", openings.outlet_area, pi * radius * radius);
  }
  return text;
}

std::string ball_lines(double ball, double cell) {
  std::string text = line("largest ball             %.3g mm, %.2g cells of %.3g mm (the mean volume's)",
                          1e3 * ball, ball / cell, 1e3 * cell);
  if (cell >= ball) return text;
  const double balls = charge_solidity * std::pow(cell / ball, 3) * 6 / pi;
  return text +
         line(
             "advice: a cell is smaller than the largest ball and holds %.2g of them in a dense charge; "
             "drag laws were derived on averages over 8 to 64: average on voxels coarser than the cells "
             "(millAverage --box), or on the mesh with --smooth; see averaging/README.md",
             balls);
}

}  // namespace

std::string mesh_report(const Mill& mill, const VolumeMesh& mesh, const MeshQuality& q,
                        const Openings& openings) {
  const double closed_form = flow_volume(mill.geometry);
  double largest_ball = 0;
  for (const SizeClass& size : mill.charge.classes) largest_ball = std::max(largest_ball, size.diameter);
  return line("cells                    %d, %zu of them in the cross-section", mesh.cells,
              openings.compartment.size()) +
         line("faces                    %zu", mesh.faces.size()) +
         line("volume                   %.6g m^3 (closed form %.6g)", q.volume, closed_form) +
         quality_line("volume error", "%.2e", std::abs(q.volume / closed_form - 1), allowed_volume_error) +
         quality_line("max non-orthogonality", "%.1f degrees", q.max_non_orthogonality,
                      allowed_non_orthogonality) +
         quality_line("max skewness", "%.2f", q.max_skewness, allowed_skewness) +
         quality_line("max volume ratio", "%.2f", q.max_volume_ratio, allowed_volume_ratio) +
         line("edges                    %.3g to %.3g mm", 1e3 * q.smallest_edge, 1e3 * q.largest_edge) +
         openings_lines(mill.geometry, openings) + ball_lines(largest_ball, std::cbrt(q.volume / mesh.cells));
}

}  // namespace millfoam::meshing
