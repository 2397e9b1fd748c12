// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/walls/cad_surface.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <fstream>

#include "meshing/faces/face_geometry.hpp"
#include "meshing/mill_mesh/mill_mesh.hpp"
#include "meshing/mill_mesh/section_blocks.hpp"
#include "meshing/volume/mesh_quality.hpp"
#include "meshing/walls/surface_check.hpp"
#include "meshing/walls/wall_files.hpp"
#include "tests/meshing/polygon_support.hpp"
#include "tests/meshing/test_geometry.hpp"
#include "tests/meshing/test_mill.hpp"

namespace millfoam::meshing {
namespace {

using Eigen::Vector3d;
using CadTriangle = std::array<Vector3d, 3>;
using CadTriangles = std::vector<CadTriangle>;

/// A box around the axis from z = 0 to its height, its triangles facing outwards.
CadTriangles box(double width, double height) {
  PolygonSet set = empty_set();
  const double w = width / 2;
  add_prism(set, {{-w, -w}, {w, -w}, {w, w}, {-w, w}}, 0, height);
  std::reverse(set.polygons[4].points.begin(), set.polygons[4].points.end());
  CadTriangles triangles;
  for (const Polygon& polygon : set.polygons) {
    const auto at = [&](std::size_t i) { return set.points[static_cast<std::size_t>(polygon.points[i])]; };
    triangles.push_back({at(0), at(1), at(2)});
    triangles.push_back({at(0), at(2), at(3)});
  }
  return triangles;
}

void turn(CadTriangle& triangle) {
  std::swap(triangle[1], triangle[2]);
}

CadTriangles moved(CadTriangles triangles, const Vector3d& by) {
  for (CadTriangle& triangle : triangles) {
    for (Vector3d& corner : triangle) corner += by;
  }
  return triangles;
}

/// Text in which a triangle's facet begins in line 2 + 7 i.
std::string stl(const CadTriangles& triangles) {
  std::ostringstream text;
  text.precision(9);
  text << "solid from CAD\n";
  for (const CadTriangle& triangle : triangles) {
    text << "facet normal 0 0 0\n outer loop\n";
    for (const Vector3d& p : triangle) text << "  vertex " << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
    text << " endloop\nendfacet\n";
  }
  return text.str() + "endsolid from CAD\n";
}

std::string binary_stl(const CadTriangles& triangles) {
  std::string bytes = "solid, but binary";
  bytes.resize(80, ' ');
  const auto append = [&](auto number) {
    std::string part(sizeof number, '\0');
    std::memcpy(part.data(), &number, sizeof number);
    bytes += part;
  };
  append(static_cast<std::uint32_t>(triangles.size()));
  for (const CadTriangle& triangle : triangles) {
    for (int i = 0; i < 3; ++i) append(0.0F);
    for (const Vector3d& corner : triangle) {
      for (double x : corner) append(static_cast<float>(x));
    }
    append(static_cast<std::uint16_t>(0));
  }
  return bytes;
}

CadReport examine_text(const std::string& text, double scale = 1, double tolerance = 0) {
  const TemporaryFolder folder;
  return examine({{"shell", folder.write("shell.stl", text)}}, scale, tolerance);
}

CadReport examined(const CadTriangles& triangles, double tolerance = 0) {
  return examine_text(stl(triangles), 1, tolerance);
}

std::string joined(const std::vector<std::string>& sentences) {
  std::string text;
  for (const std::string& sentence : sentences) text += sentence + '\n';
  return text;
}

void expect_in(const std::vector<std::string>& sentences, const std::string& part) {
  EXPECT_NE(joined(sentences).find(part), std::string::npos) << joined(sentences);
}

void expect_clean(const CadReport& report) {
  EXPECT_EQ(joined(report.problems) + joined(report.repairs) + joined(report.warnings), "");
}

TEST(Examine, finds_nothing_wrong_with_a_box) {
  const CadReport report = examined(box(0.2, 0.1));
  expect_clean(report);
  EXPECT_EQ(report.triangles, 12);
  EXPECT_NEAR(report.volume, 0.004, 1e-15);
  ASSERT_EQ(report.surface.parts.size(), 4u);
  EXPECT_EQ(report.surface.parts[0].triangles.size(), 12u);
  EXPECT_TRUE(report.surface.parts[1].triangles.empty());
  EXPECT_NEAR(require_watertight(report.surface), 0.004, 1e-15);
}

TEST(Examine, reads_binary_files_that_begin_with_solid_and_scales) {
  const CadReport report = examine_text(binary_stl(box(200, 100)), 0.001);
  expect_clean(report);
  EXPECT_NEAR(report.volume, 0.004, 1e-10);
  EXPECT_NEAR(report.high.z(), 0.1, 1e-8);
}

TEST(Examine, takes_millMeshs_own_walls_as_they_are) {
  const TemporaryFolder folder;
  const TestMill mill = ordinary_mills()[3];
  const WallSurface own = make_wall_surface(make_cross_section(mill.geometry, mill.cell_size), 0.024);
  std::vector<PartFile> parts;
  for (const auto& file : write_walls(own, Ends::plain, folder.path())) parts.push_back({file.stem(), file});
  const CadReport report = examine(parts);
  expect_clean(report);
  EXPECT_NEAR(report.volume, require_watertight(own), 1e-16);
  EXPECT_EQ(write_walls(report.surface, Ends::plain, folder.path() / "again").size(), 4u);
  EXPECT_EQ(report.surface.parts[1].triangles.size(), own.parts[1].triangles.size());
}

/// The walls of a slice, without ends.
std::vector<PartFile> slice_walls(const TemporaryFolder& folder, double& volume) {
  const TestMill mill = ordinary_mills()[3];
  const WallSurface own = make_wall_surface(make_cross_section(mill.geometry, mill.cell_size), 0.024);
  volume = require_watertight(own);
  std::vector<PartFile> parts;
  for (const auto& file : write_walls(own, Ends::periodic, folder.path()))
    parts.push_back({file.stem(), file});
  return parts;
}

TEST(Examine, takes_the_walls_of_a_slice_that_are_open_at_its_ends) {
  const TemporaryFolder folder;
  double volume = 0;
  const auto parts = slice_walls(folder, volume);
  ASSERT_EQ(parts.size(), 2u);
  expect_in(examine(parts).problems, "a hole: the edge from ");
  const CadReport report = examine(parts, 1, 0, Ends::periodic);
  expect_clean(report);
  EXPECT_NEAR(report.volume, volume, 1e-16);
}

TEST(Examine, turns_a_slice_and_finds_holes_between_its_ends) {
  CadTriangles tube = box(0.2, 0.1);
  tube.resize(8);  // without bottom and top
  const TemporaryFolder folder;
  const auto slice = [&](const CadTriangles& triangles) {
    return examine({{"shell", folder.write("shell.stl", stl(triangles))}}, 1, 0, Ends::periodic);
  };
  expect_clean(slice(tube));
  CadTriangles inwards = tube;
  for (CadTriangle& triangle : inwards) turn(triangle);
  expect_in(slice(inwards).repairs, "the whole surface faced into the mill's interior and was turned");
  EXPECT_NEAR(slice(inwards).volume, 0.004, 1e-15);
  CadTriangles gap = tube;
  gap.pop_back();
  EXPECT_FALSE(slice(gap).usable());
  CadTriangles hanging = tube;
  hanging.push_back({Vector3d(-0.1, -0.1, 0.1), Vector3d(0.1, -0.1, 0.1), Vector3d(0, 0, 0.05)});
  EXPECT_FALSE(slice(hanging).usable());
  EXPECT_THROW(examine({{"feedEnd", folder.path() / "shell.stl"}}, 1, 0, Ends::periodic), std::runtime_error);
}

TEST(Examine, turns_a_surface_that_faces_inwards) {
  CadTriangles triangles = box(0.2, 0.1);
  for (CadTriangle& triangle : triangles) turn(triangle);
  const CadReport report = examined(triangles);
  EXPECT_TRUE(report.usable());
  expect_in(report.repairs, "the whole surface faced into the mill's interior and was turned");
  EXPECT_NO_THROW(require_watertight(report.surface));
}

TEST(Examine, reads_keywords_in_capitals) {
  std::string text = stl(box(0.2, 0.1));
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  expect_clean(examine_text(text));
  EXPECT_EQ(examine_text(text).triangles, 12);
}

TEST(Examine, turns_triangles_that_face_against_their_neighbours) {
  CadTriangles triangles = box(0.2, 0.1);
  turn(triangles[3]);
  turn(triangles[7]);
  const CadReport report = examined(triangles);
  EXPECT_TRUE(report.usable());
  expect_in(report.repairs, "2 triangles that faced against their neighbours were turned, the first ");
  expect_in(report.repairs, "shell.stl:23, around (0.1 ");
  EXPECT_NO_THROW(require_watertight(report.surface));
}

TEST(Examine, lets_a_body_inside_another_face_into_itself) {
  CadTriangles triangles = box(0.2, 0.1);
  for (const CadTriangle& triangle : moved(box(0.02, 0.02), {0.05, 0, 0.04})) triangles.push_back(triangle);
  const CadReport report = examined(triangles);
  EXPECT_TRUE(report.usable());
  expect_in(report.repairs, "1 of 2 bodies faced into the mill's interior and was turned");
  expect_in(report.warnings, "2 bodies that are not connected: 12 triangles with ");
  expect_in(report.warnings, ", inside another");
  EXPECT_NEAR(report.volume, 0.004 - 8e-6, 1e-15);
  EXPECT_NEAR(require_watertight(report.surface), 0.004 - 8e-6, 1e-15);
}

TEST(Examine, joins_corners_and_leaves_out_the_triangles_that_this_flattens) {
  CadTriangles triangles = box(0.2, 0.1);
  triangles[0][0].x() += 1e-8;
  triangles.push_back({Vector3d(0.1, 0.1, 0), Vector3d(0.1, 0.1, 1e-8), Vector3d(0, 0, 0)});
  const CadReport report = examined(triangles);
  EXPECT_TRUE(report.usable()) << joined(report.problems);
  EXPECT_EQ(report.triangles, 12);
  expect_in(report.repairs,
            "corners nearer than 3e-07 m to another were joined to it, the farthest over 1e-08 m");
  expect_in(report.repairs, "1 triangle with two equal corners was left out, the first ");
}

TEST(Examine, refuses_holes_and_edges_with_three_triangles) {
  CadTriangles open = box(0.2, 0.1);
  open.pop_back();
  expect_in(examined(open).problems, "a hole: the edge from ");
  EXPECT_FALSE(examined(open).usable());

  CadTriangles fin = box(0.2, 0.1);
  fin.push_back({Vector3d(-0.1, -0.1, 0.1), Vector3d(0.1, -0.1, 0.1), Vector3d(0, 0, 0.2)});
  expect_in(examined(fin).problems, "has 3 triangles: expected two");
  expect_in(examined(fin).problems, "a dangling face");
  EXPECT_EQ(joined(examined(fin).warnings), "");  // no list of the bodies that this cuts it into
}

TEST(Examine, refuses_doubled_and_flat_triangles) {
  CadTriangles doubled = box(0.2, 0.1);
  doubled.push_back(doubled[4]);
  expect_in(examined(doubled).problems, "a doubled face: the same points as ");

  CadTriangles flat = box(0.2, 0.1);
  flat.push_back({Vector3d(-0.1, -0.1, 0), Vector3d(0, -0.1, 0), Vector3d(0.1, -0.1, 0)});
  expect_in(examined(flat).problems, "shell.stl:86: the triangle around (0 -0.1 0) has no area");
}

TEST(Examine, refuses_crossing_triangles) {
  CadTriangles triangles = box(0.2, 0.1);
  for (const CadTriangle& triangle : moved(box(0.05, 0.05), {0.1, 0.01, 0.02})) triangles.push_back(triangle);
  expect_in(examined(triangles).problems, ": the triangle crosses ");
  triangles = box(0.2, 0.1);
  for (CadTriangle& triangle : triangles) {
    for (Vector3d& corner : triangle) {
      if (corner == Vector3d(0.1, 0.1, 0.1)) corner = {-0.3, -0.25, 0.05};  // a corner pulled through the box
    }
  }
  expect_in(examined(triangles).problems, ": the triangle crosses ");
}

TEST(Examine, refuses_a_surface_with_one_side) {
  CadTriangles strip;
  const auto at = [](int i, double side) {
    const double angle = 2 * M_PI * i / 12, half = side * std::cos(angle / 2) * 0.03;
    return Vector3d((0.1 + half) * std::cos(angle), (0.1 + half) * std::sin(angle),
                    0.05 + side * 0.03 * std::sin(angle / 2));
  };
  for (int i = 0; i < 12; ++i) {
    strip.push_back({at(i, -1), at(i + 1, -1), at(i + 1, 1)});
    strip.push_back({at(i, -1), at(i + 1, 1), at(i, 1)});
  }
  expect_in(examined(strip).problems, "is one-sided");
}

TEST(Examine, asks_for_the_unit_and_the_frame) {
  expect_in(examined(box(300, 200)).problems,
            "the bounding box is 300 m long, above 20 m: is this in millimetres?");
  expect_in(examined(box(0.002, 0.001)).warnings, "the bounding box is only 0.002 m long");
  const CadReport off = examined(moved(box(0.2, 0.1), {0.01, 0, -0.05}));
  EXPECT_TRUE(off.usable());
  expect_in(off.warnings, "the bounding box's middle is x = 0.01, y = ");
  expect_in(off.warnings, "the bounding box begins at z = -0.05 m: expected the feed end at z = 0");
}

TEST(Examine, refuses_a_tolerance_that_removes_a_part_and_warns_of_a_wide_one) {
  const CadReport removed = examined(box(0.2, 0.1), 1);
  EXPECT_FALSE(removed.usable());
  expect_in(removed.problems, "shell: none of its 12 triangles is left");
  expect_in(removed.problems, "expected a smaller --tolerance");
  const CadReport wide = examined(box(0.2, 0.1), 4e-4);
  EXPECT_TRUE(wide.usable());
  expect_in(wide.warnings, "corners nearer than 0.0004 m were joined");
  EXPECT_TRUE(examined(box(0.2, 0.1), 2e-4).warnings.empty());
}

TEST(Examine, warns_of_needles_with_the_worst) {
  const CadReport report = examined(box(10, 0.002));
  EXPECT_TRUE(report.usable());
  expect_in(report.warnings,
            "8 needle triangles, with a height below 0.001 of the longest side; the worst has 0.0002 at (");
}

std::string refusal_of(const std::string& text) {
  try {
    examine_text(text);
  } catch (const std::runtime_error& error) {
    const std::string message = error.what();
    return message.substr(message.find("shell.stl"));
  }
  return "accepted";
}

TEST(Examine, refuses_files_that_it_cannot_read_with_the_line) {
  EXPECT_EQ(refusal_of(""), "shell.stl: has no triangles");
  EXPECT_EQ(refusal_of("solid\nendsolid\n"), "shell.stl: has no triangles");
  EXPECT_EQ(refusal_of("binary"),
            "shell.stl:1: 'binary': expected 'solid', or a binary file with a header of 84 bytes");
  EXPECT_EQ(refusal_of("solid\nfacet\nouter loop\nvertex 0 0 nan\n"),
            "shell.stl:4: 'nan': expected three coordinates, finite numbers");
  EXPECT_EQ(refusal_of("solid\nfacet\nouter loop\nvertex 0 0 0 1\n"),
            "shell.stl:4: '1' after three coordinates: expected the end of the line");
  EXPECT_EQ(refusal_of("solid\nfacet\nouter loop\nvertex 0 0 0\nfacet\n"),
            "shell.stl:5: the facet before this has 1 corner: expected 3");
  EXPECT_EQ(refusal_of("solid\nvertex 0 0 0\n"), "shell.stl:2: 'vertex': expected 'facet' or 'endsolid'");
  EXPECT_EQ(refusal_of("solid\nfacet\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nvertex 1 1 0\n"),
            "shell.stl:7: a fourth corner of a facet: expected 3");
  EXPECT_EQ(refusal_of("solid\nfacet\nvertex 0 0 0\n"), "shell.stl:3: 'vertex': expected 'outer'");
  EXPECT_EQ(refusal_of("solid\nfacet\nouter loop\nvertex 0 0 0\n"),
            "shell.stl:4: the file ends within a facet");
  EXPECT_EQ(refusal_of("solid\n"), "shell.stl:1: is cut short: the text ends here, expected 'endsolid'");
  EXPECT_EQ(refusal_of("solid\ntriangle\n"), "shell.stl:2: 'triangle': expected 'facet' or 'endsolid'");
  std::string cut = binary_stl(box(0.2, 0.1));
  const std::string announced = std::to_string(cut.size()) + " for the 12 triangles announced in its header";
  const auto sizes = [&] {
    return ": there are " + std::to_string(cut.size()) + " bytes, expected " + announced;
  };
  cut.resize(cut.size() - 10);
  EXPECT_EQ(refusal_of(cut), "shell.stl: is cut short" + sizes());
  cut.resize(cut.size() + 11);
  EXPECT_EQ(refusal_of(cut), "shell.stl: is too long" + sizes());
  CadTriangles infinite = box(0.2, 0.1);
  infinite[2][1].y() = std::numeric_limits<double>::infinity();
  EXPECT_EQ(refusal_of(binary_stl(infinite)), "shell.stl: triangle 3: a coordinate that is not finite");
}

TEST(Examine, refuses_unknown_and_doubled_parts_and_impossible_scales) {
  const TemporaryFolder folder;
  const auto file = folder.write("a.stl", stl(box(0.2, 0.1)));
  EXPECT_THROW(examine({{"lid", file}}), std::runtime_error);
  EXPECT_THROW(examine({{"shell", file}, {"shell", file}}), std::runtime_error);
  EXPECT_THROW(examine({{"shell", file}}, 0), std::runtime_error);
  EXPECT_THROW(examine({{"shell", file}}, std::numeric_limits<double>::infinity()), std::runtime_error);
  EXPECT_THROW(examine({{"shell", folder.path() / "none.stl"}}), PolygonError);
}

TEST(OwnWalls, have_no_needles_and_the_volume_of_the_mesh_in_both_laboratory_mills) {
  for (const TestMill& mill : ordinary_mills()) {
    const CrossSection section = make_cross_section(mill.geometry, mill.cell_size);
    const WallSurface walls = make_wall_surface(section, mill.geometry.length);
    EXPECT_GT(find_needles(walls).smallest_ratio, 0.02);
    EXPECT_NO_THROW(require_no_needles(walls));
    const double volume = quality(make_mill_mesh(section, mill.geometry, 2)).volume;
    EXPECT_NO_THROW(require_same_volume(require_watertight(walls), volume));
  }
}

TEST(RequireNoNeedles, names_the_worst) {
  WallSurface surface{{{0, 0, 0}, {1, 0, 0}, {0.5, 0.0005, 0}, {0.5, 1, 0}},
                      {{"shell", {{0, 1, 2}, {0, 1, 3}}}}};
  try {
    require_no_needles(surface);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(std::string(error.what()),
              "the walls have 1 needle triangle, the worst, of height over longest side 0.0005, at (0.5 "
              "0.000166666667 0): expected at least 0.001; choose another resolution.cell_size");
  }
}

TEST(RequireSameVolume, refuses_a_difference_above_a_millionth) {
  EXPECT_NO_THROW(require_same_volume(1 + 9e-7, 1));
  EXPECT_THROW(require_same_volume(1 + 2e-6, 1), std::runtime_error);
}

}  // namespace
}  // namespace millfoam::meshing
