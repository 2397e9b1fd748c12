// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/results/mesh_report.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numeric>

#include "meshing/mill/mill_charge.hpp"
#include "meshing/mill/mill_shape.hpp"
#include "meshing/mill/opening_circles.hpp"
#include "meshing/mill/stirred_geometry.hpp"
#include "meshing/surface/pi.hpp"
#include "meshing/walls/surface_check.hpp"

namespace millfoam::meshing {
namespace {

/// Solidity of a charge in motion, for the advice only.
constexpr double charge_solidity = 0.5;
/// Shear rate, 1/s, down to which a slurry has its yield stress without an advice: below a mill's own, of
/// 2 to 10.
constexpr double slowest_yield = 1;

/// Slurries of mills have less, Pa s: a larger value may be in mPa s.
constexpr double unusual_viscosity = 1;

template <typename... Values>
std::string line(const char* format, Values... values) {
  std::array<char, 400> text{};
  std::snprintf(text.data(), text.size(), format, values...);
  return std::string(text.data()) + '\n';
}

/// One for each class of superquadrics.
std::string shape_lines(const Charge& charge) {
  std::string lines;
  for (const SizeClass& size : charge.classes) {
    if (!size.shape) continue;
    const auto& [a, b, c] = size.shape->half_axes;
    lines += line(
        "superquadric             half axes %.4g %.4g %.4g mm, blockiness %.4g, sphericity %.4f,\n"
        "                         least radius of curvature %.3g mm, longest way %.4g mm",
        1e3 * a, 1e3 * b, 1e3 * c, size.shape->blockiness, sphericity(*size.shape),
        1e3 * least_radius_of_curvature(*size.shape), 1e3 * longest_way(size));
  }
  return lines;
}

/// What is left of the yield stress of a slurry whose largest viscosity is limited.
std::string slurry_lines(const Slurry& slurry) {
  const double below = slurry.liquid_below();
  if (!(below > 0)) return {};
  std::string text = line("slurry                   a liquid of %.3g Pa s below a shear rate of %.3g 1/s",
                          slurry.viscosity_ratio * slurry.plastic_viscosity, below);
  if (below <= slowest_yield) return text;
  // Rounded up to the two digits that are shown
  const double least = slurry.yield_stress / (slowest_yield * slurry.plastic_viscosity) + 1;
  const double digit = std::pow(10, std::floor(std::log10(least)) - 1);
  const double enough = digit * std::ceil(least / digit);
  text += "advice: slurry that moves more slowly has no yield stress";
  if (enough > Slurry::largest_viscosity_ratio) return text + '\n';
  return text + line(
                    "; with slurry.viscosity_ratio %.2g it has one down to %g 1/s, in a flow that may need "
                    "more time",
                    enough, slowest_yield);
}

std::string quality_line(const char* what, const char* format, double value, double limit) {
  const std::string row = std::string("%-24s ") + format + " (limit %g)%s";
  return line(row.c_str(), what, value, limit, value <= limit ? "" : ": too large");
}

std::string area_line(const char* what, double area, double asked) {
  return line("%-24s %.5g cm^2 (requested %.5g, relative error %.2e)", what, 1e4 * area, 1e4 * asked,
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

std::string ball_lines(double ball, const std::vector<double>& volumes) {
  const double smallest = std::cbrt(*std::min_element(volumes.begin(), volumes.end()));
  const double mean =
      std::cbrt(std::accumulate(volumes.begin(), volumes.end(), 0.0) / static_cast<double>(volumes.size()));
  std::string text =
      line("largest ball             %.3g mm; cells %.3g mm (smallest), %.3g mm (mean volume's)", 1e3 * ball,
           1e3 * smallest, 1e3 * mean);
  if (smallest >= ball) return text;
  const auto below = static_cast<double>(
      std::count_if(volumes.begin(), volumes.end(), [&](double volume) { return std::cbrt(volume) < ball; }));
  const double balls = charge_solidity * std::pow(smallest / ball, 3) * 6 / pi;
  return text +
         line(
             "advice: %.3g %% of the cells are smaller than the largest ball, of which the smallest holds "
             "%.2g "
             "in a dense charge; drag laws were derived on averages over 8 to 64: average on voxels coarser "
             "than the cells (millAverage --box), or on the mesh with --smooth; see averaging/README.md",
             100 * below / static_cast<double>(volumes.size()), balls);
}

std::string viscosity_lines(const Slurry& slurry) {
  if (slurry.plastic_viscosity <= unusual_viscosity) return "";
  return line(
      "advice: slurry.plastic_viscosity is %.4g Pa s, more than slurries of mills have (water has 0.001 Pa "
      "s): "
      "is the value in mPa s?",
      slurry.plastic_viscosity);
}

}  // namespace

std::string mill_lines(const MillDescription& description) {
  const Mill& mill = description.mill;
  const ChargeNumbers charge = count_charge(mill);
  std::string text =
      line("mill                     %s", mill.title.c_str()) +
      line(
          "speed                    %.4g rad/s (%.4g rpm), %.3g %% of the critical, %s seen with x to the "
          "right and y up",
          mill.angular_velocity, std::abs(mill.angular_velocity) / turn_per_minute,
          100 * std::abs(mill.angular_velocity) / critical_speed(mill.geometry), mill.sense()) +
      line("charge                   %ld balls, %.4g kg, load %.3g %%", charge.balls, charge.mass,
           100 * charge.load);
  if (charge.fines_mass > 0)
    text += line(
        "fines                    %.4g kg (%.3g %% of the mass) are left out; with them the load is %.3g %%",
        charge.fines_mass, 100 * charge.fines_mass / (charge.mass + charge.fines_mass),
        100 * charge.load_asked);
  return text + shape_lines(mill.charge) + slurry_lines(mill.slurry) +
         line("fingerprint              %s", description.mill.fingerprint.flow.c_str());
}

std::string stirred_lines(const MillDescription& description) {
  const Mill& mill = description.mill;
  const Impeller& impeller = *mill.geometry.impeller;
  const ChargeNumbers charge = count_charge(mill);
  return line("mill                     %s", mill.title.c_str()) +
         line("impeller                 %zu levels of pins, %zu discs, %.4g mm from tip to tip, gap %.3g mm",
              impeller.pins.size(), impeller.discs.size(), 2e3 * impeller_radius(impeller),
              1e3 * impeller_gap(mill.geometry)) +
         line("speed                    %.4g rad/s (%.4g rpm), %.4g m/s at the tips, %s seen from above",
              mill.angular_velocity, std::abs(mill.angular_velocity) / turn_per_minute,
              std::abs(mill.angular_velocity) * impeller_radius(impeller), mill.sense()) +
         line("charge                   %ld balls, %.4g kg", charge.balls, charge.mass) +
         shape_lines(mill.charge) + (mill.has_flow() ? slurry_lines(mill.slurry) : "") +
         line("fingerprint              %s", description.mill.fingerprint.charge.c_str());
}

std::string mesh_report(const Mill& mill, const VolumeMesh& mesh, const MeshQuality& q,
                        const Openings& openings, const QualityLimits& limits) {
  const double closed_form = flow_volume(mill.geometry);
  double largest_ball = 0;
  for (const SizeClass& size : mill.charge.classes) largest_ball = std::max(largest_ball, size.diameter);
  const std::string cells = mill.geometry.impeller
                                ? line("cells                    %d", mesh.cells)
                                : line("cells                    %d, %zu of them in the cross-section",
                                       mesh.cells, openings.compartment.size());
  return cells + line("faces                    %zu", mesh.faces.size()) +
         line("volume                   %.6g m^3 (closed form %.6g)", q.volume, closed_form) +
         quality_line("volume error", "%.2e", std::abs(q.volume / closed_form - 1), limits.volume_error) +
         quality_line("max non-orthogonality", "%.1f degrees", q.max_non_orthogonality,
                      limits.non_orthogonality) +
         quality_line("max skewness", "%.2f", q.max_skewness, limits.skewness) +
         quality_line("max volume ratio", "%.2f", q.max_volume_ratio, limits.volume_ratio) +
         line("edges                    %.3g to %.3g mm", 1e3 * q.smallest_edge, 1e3 * q.largest_edge) +
         openings_lines(mill.geometry, openings) + ball_lines(largest_ball, measure(mesh).cell_volume) +
         viscosity_lines(mill.slurry);
}

std::string wall_report(const WallSurface& walls, double volume, double expected, double limit) {
  std::size_t triangles = 0;
  for (const WallPart& part : walls.parts) triangles += part.triangles.size();
  return line(
      "walls                    %zu triangles, the flattest %.3g (limit %g), volume error %.1e (limit %g)",
      triangles, find_needles(walls).smallest_ratio, needle_ratio, std::abs(volume / expected - 1), limit);
}

}  // namespace millfoam::meshing
