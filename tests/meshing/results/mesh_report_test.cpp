// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/results/mesh_report.hpp"

#include <gtest/gtest.h>

#include "meshing/mill_mesh/mill_mesh.hpp"
#include "meshing/mill_mesh/section_blocks.hpp"
#include "tests/meshing/test_geometry.hpp"

namespace millfoam::meshing {
namespace {

std::string report_of(const Geometry& geometry, double ball) {
  Mill mill;
  mill.geometry = geometry;
  mill.charge.classes = {{0.001, 1}, {ball, 1}};
  const CrossSection section = make_cross_section(geometry, 0.012);
  const VolumeMesh mesh = make_mill_mesh(section, geometry, 20);
  return mesh_report(mill, mesh, quality(mesh), find_openings(section, geometry));
}

void expect_lines(const std::string& report, const std::vector<std::string>& parts) {
  for (const std::string& part : parts)
    EXPECT_NE(('\n' + report).find('\n' + part), std::string::npos) << part << "\n" << report;
}

TEST(MeshReport, holds_the_quality_against_its_limits) {
  expect_lines(report_of(mill_with_grates(), 0.002),
               {"cells                    33200, 1660 of them in the cross-section\n"
                "faces                    102460\n"
                "volume                   0.0209316 m^3 (closed form 0.0209509)\n"
                "volume error             9.19e-04 (limit 0.005)\n"
                "max non-orthogonality    25.3 degrees (limit 45)\n"
                "max skewness             0.49 (limit 1)\n"
                "max volume ratio         2.11 (limit 3)\n"
                "edges                    3.2 to 15.3 mm\n",
                "largest ball             2 mm; cells 5.47 mm (smallest), 8.57 mm (mean volume's)\n"});
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
  expect_lines(
      report_of(mill_with_grates(), 0.007),
      {"largest ball             7 mm; cells 5.47 mm (smallest), 8.57 mm (mean volume's)\n"
       "advice: 44.3 % of the cells are smaller than the largest ball, of which the smallest holds 0.46 in a "
       "dense charge; drag laws were derived on averages over 8 to 64: average on voxels coarser than the "
       "cells (millAverage --box), or on the mesh with --smooth; see averaging/README.md\n"});
  EXPECT_EQ(report_of(mill_with_grates(), 0.002).find("advice"), std::string::npos);
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
