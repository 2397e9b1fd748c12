// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/results/mesh_report.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "meshing/mill/mill_shape.hpp"
#include "meshing/mill_mesh/mill_mesh.hpp"
#include "meshing/mill_mesh/section_blocks.hpp"
#include "meshing/surface/pi.hpp"
#include "tests/meshing/stirred_mill.hpp"
#include "tests/meshing/test_geometry.hpp"
#include "tests/meshing/test_mill.hpp"

namespace millfoam::meshing {
namespace {

/// A mill's mesh of 20 layers, what is measured on it, and its report.
struct Reported {
  Geometry geometry;
  VolumeMesh mesh;
  MeshQuality measured;
  std::string report;
};

Reported reported(const Geometry& geometry, double ball) {
  Mill mill;
  mill.geometry = geometry;
  mill.charge.classes = {{0.001, 1}, {ball, 1}};
  const CrossSection section = make_cross_section(geometry, 0.012);
  const VolumeMesh mesh = make_mill_mesh(section, geometry, 20);
  const MeshQuality measured = quality(mesh);
  return {geometry, mesh, measured, mesh_report(mill, mesh, measured, find_openings(section, geometry))};
}

std::string report_of(const Geometry& geometry, double ball) {
  return reported(geometry, ball).report;
}

template <typename... Values>
std::string line(const char* format, Values... values) {
  std::array<char, 400> text{};
  std::snprintf(text.data(), text.size(), format, values...);
  return text.data();
}

void expect_lines(const std::string& report, const std::vector<std::string>& parts) {
  for (const std::string& part : parts)
    EXPECT_NE(('\n' + report).find('\n' + part), std::string::npos) << part << "\n" << report;
}

/// Edges of the mesh's cells as cubes, m.
std::vector<double> cell_sizes(const VolumeMesh& mesh) {
  std::vector<double> sizes;
  for (const double volume : measure(mesh).cell_volume) sizes.push_back(std::cbrt(volume));
  return sizes;
}

TEST(MeshReport, holds_the_quality_against_its_limits) {
  const Reported mill = reported(mill_with_grates(), 0.002);
  const MeshQuality& q = mill.measured;
  const double closed_form = analytic_volume(mill.geometry);
  const std::vector<double> sizes = cell_sizes(mill.mesh);
  const double mean = std::cbrt(q.volume / static_cast<double>(mill.mesh.cells));
  expect_lines(
      mill.report,
      {line("cells                    %d, %d of them in the cross-section\n", mill.mesh.cells,
            mill.mesh.cells / 20),
       line("faces                    %zu\n", mill.mesh.faces.size()),
       line("volume                   %.6g m^3 (closed form %.6g)\n", q.volume, closed_form),
       line("volume error             %.2e (limit 0.005)\n", std::abs(q.volume / closed_form - 1)),
       line("max non-orthogonality    %.1f degrees (limit 45)\n", q.max_non_orthogonality),
       line("max skewness             %.2f (limit 1)\n", q.max_skewness),
       line("max volume ratio         %.2f (limit 3)\n", q.max_volume_ratio),
       line("edges                    %.3g to %.3g mm\n", 1e3 * q.smallest_edge, 1e3 * q.largest_edge),
       line("largest ball             2 mm; cells %.3g mm (smallest), %.3g mm (mean volume's)\n",
            1e3 * *std::min_element(sizes.begin(), sizes.end()), 1e3 * mean)});
}

TEST(MeshReport, says_below_which_shear_rate_a_slurry_has_no_yield_stress) {
  MillDescription description;
  description.mill.geometry = mill_with_grates();
  description.mill.slurry = {1239, 0.0014, 0.16, 0.07};
  const auto lines = [&] { return mill_lines(description); };
  expect_lines(lines(), {"slurry                   a liquid of 1.4 Pa s below a shear rate of 0.114 1/s\n"});
  EXPECT_EQ(lines().find("advice"), std::string::npos);
  description.mill.slurry.yield_stress = 14;
  // 14 Pa over 0.0014 Pa s and 1 /s
  expect_lines(
      lines(),
      {"slurry                   a liquid of 1.4 Pa s below a shear rate of 10 1/s\n"
       "advice: slurry that moves more slowly has no yield stress; with slurry.viscosity_ratio 1.1e+04 "
       "it has one down to 1 1/s"});
  description.mill.slurry.viscosity_ratio = 11000;
  EXPECT_EQ(lines().find("advice"), std::string::npos);
  description.mill.slurry = {1239, 1e-6, 1e6, 0.07};
  expect_lines(lines(), {"advice: slurry that moves more slowly has no yield stress\n"});
  description.mill.slurry.yield_stress = 0;
  EXPECT_EQ(lines().find("slurry "), std::string::npos);
}

TEST(MillLines, have_the_speed_in_turns_per_minute_too) {
  expect_lines(mill_lines(describe(example_mill, {"speed={angular_velocity: -6.2831853}"})),
               {"speed                    -6.283 rad/s (60 rpm), 49.1 % of the critical, clockwise seen"});
  expect_lines(stirred_lines(describe(stirred_mill)),
               {"speed                    31.42 rad/s (300 rpm), 2.215 m/s at the tips, anticlockwise"});
}

TEST(MeshReport, says_which_value_is_too_large) {
  const Geometry geometry = mill_with_grates();
  const CrossSection section = make_cross_section(geometry, 0.012);
  const VolumeMesh mesh = make_mill_mesh(section, geometry, 2);
  MeshQuality bad = quality(mesh);
  bad.max_volume_ratio = 4;
  Mill mill;
  mill.geometry = geometry;
  expect_lines(mesh_report(mill, mesh, bad, find_openings(section, geometry)),
               {"max volume ratio         4.00 (limit 3): too large\n"});
}

TEST(MeshReport, holds_the_areas_of_the_openings_against_those_asked_for) {
  expect_lines(report_of(mill_with_pulp_lifters(), 0.005),
               {"inlet                    128.68 cm^2 (requested 128.7, relative error",
                "grates                   221.17 cm^2 (requested 221.17, relative error",
                "outlet                   128.68 cm^2 (requested 128.68, relative error"});
  Geometry plain = mill_with_grates();
  plain.inlet.reset();
  plain.grates.reset();
  EXPECT_EQ(report_of(plain, 0.005).find("requested"), std::string::npos);
}

TEST(MeshReport, names_the_averages_to_use_where_the_smallest_cell_is_smaller_than_the_largest_ball) {
  const Reported mill = reported(mill_with_grates(), 0.007);
  const std::vector<double> sizes = cell_sizes(mill.mesh);
  const double smallest = *std::min_element(sizes.begin(), sizes.end());
  const auto below = std::count_if(sizes.begin(), sizes.end(), [](double size) { return size < 0.007; });
  const double held = 0.5 * std::pow(smallest, 3) / (pi / 6 * std::pow(0.007, 3));
  expect_lines(
      mill.report,
      {line(
          "advice: %.3g %% of the cells are smaller than the largest ball, of which the smallest holds %.2g "
          "in a dense charge; drag laws were derived on averages over 8 to 64: average on voxels coarser "
          "than the cells (millAverage --box), or on the mesh with --smooth; see averaging/README.md\n",
          100.0 * static_cast<double>(below) / static_cast<double>(sizes.size()), held)});
  EXPECT_EQ(report_of(mill_with_grates(), 0.002).find("advice"), std::string::npos);
}

TEST(MeshReport, asks_for_the_unit_of_a_viscosity_that_no_slurry_of_a_mill_has) {
  const Geometry geometry = mill_with_grates();
  const CrossSection section = make_cross_section(geometry, 0.012);
  const VolumeMesh mesh = make_mill_mesh(section, geometry, 2);
  const auto report_with = [&](double viscosity) {
    Mill mill;
    mill.geometry = geometry;
    mill.slurry.plastic_viscosity = viscosity;
    return mesh_report(mill, mesh, quality(mesh), find_openings(section, geometry));
  };
  expect_lines(report_with(14), {"advice: slurry.plastic_viscosity is 14 Pa s, more than slurries of mills "
                                 "have (water has 0.001 Pa s): is the value in mPa s?\n"});
  EXPECT_EQ(report_with(1).find("advice"), std::string::npos);
}

TEST(WallReport, has_triangles_the_flattest_and_the_difference_in_volume) {
  const WallSurface surface{{{0, 0, 0}, {1, 0, 0}, {0.5, 0.25, 0}, {0.5, 1, 0}},
                            {{"shell", {{0, 1, 2}, {0, 1, 3}}}}};
  EXPECT_EQ(wall_report(surface, 1.0000005, 1),
            "walls                    2 triangles, the flattest 0.25 (limit 0.001), volume error 5.0e-07 "
            "(limit 1e-06)\n");
}

}  // namespace
}  // namespace millfoam::meshing
