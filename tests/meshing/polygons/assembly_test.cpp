// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/polygons/assembly.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <map>
#include <set>

#include "meshing/faces/face_geometry.hpp"
#include "meshing/mill_mesh/mill_mesh.hpp"
#include "meshing/mill_mesh/section_blocks.hpp"
#include "tests/meshing/polygon_support.hpp"
#include "tests/meshing/test_geometry.hpp"

namespace millfoam::meshing {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

VolumeMesh mill(const TestMill& mill) {
  return make_mill_mesh(make_cross_section(mill.geometry, mill.cell_size), mill.geometry, 2);
}

using Corners = std::vector<std::array<double, 3>>;

/// Faces and cells by the coordinates of their points, independent of the numbering.
struct Content {
  std::map<Corners, std::string> patch_of;  ///< of each face; empty between two cells
  std::set<std::set<Corners>> cells;
};

template <typename Mesh>
Content content(const Mesh& mesh) {
  Content content;
  std::vector<std::set<Corners>> cells(static_cast<std::size_t>(mesh.cells));
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    Corners corners;
    for (int p : mesh.faces[f]) {
      const Vector3d& point = mesh.points[static_cast<std::size_t>(p)];
      corners.push_back({point.x(), point.y(), point.z()});
    }
    std::sort(corners.begin(), corners.end());
    cells[static_cast<std::size_t>(mesh.owner[f])].insert(corners);
    if (f < mesh.neighbour.size()) cells[static_cast<std::size_t>(mesh.neighbour[f])].insert(corners);
    content.patch_of[corners];
    for (const Patch& patch : mesh.patches) {
      const int i = static_cast<int>(f);
      if (i >= patch.start && i < patch.start + patch.size) content.patch_of[corners] = patch.name;
    }
  }
  content.cells = {cells.begin(), cells.end()};
  return content;
}

/// Sizes and kinds of the patches that have faces.
template <typename Mesh>
std::map<std::string, std::pair<int, bool>> patches(const Mesh& mesh) {
  std::map<std::string, std::pair<int, bool>> found;
  for (const Patch& patch : mesh.patches) {
    if (patch.size > 0) found[patch.name] = {patch.size, patch.open};
  }
  return found;
}

/// For each place the numbers of cells that each of the points there belongs to.
template <typename Mesh>
std::map<std::array<double, 3>, std::multiset<std::size_t>> corners_in_cells(const Mesh& mesh) {
  std::vector<std::set<int>> cells(mesh.points.size());
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    for (int p : mesh.faces[f]) {
      cells[static_cast<std::size_t>(p)].insert(mesh.owner[f]);
      if (f < mesh.neighbour.size()) cells[static_cast<std::size_t>(p)].insert(mesh.neighbour[f]);
    }
  }
  std::map<std::array<double, 3>, std::multiset<std::size_t>> found;
  for (std::size_t p = 0; p < cells.size(); ++p) {
    const Vector3d& point = mesh.points[p];
    found[{point.x(), point.y(), point.z()}].insert(cells[p].size());
  }
  return found;
}

/// Volumes of the cells from faces that point out of their owners.
std::vector<double> cell_volumes(const PolyMesh& mesh) {
  std::vector<double> volumes(static_cast<std::size_t>(mesh.cells), 0);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const double volume = pyramid_volume(mesh.points, mesh.faces[f], mesh.points[0]);
    volumes[static_cast<std::size_t>(mesh.owner[f])] += volume;
    if (f < mesh.neighbour.size()) volumes[static_cast<std::size_t>(mesh.neighbour[f])] -= volume;
  }
  return volumes;
}

void expect_openfoams_order(const PolyMesh& mesh) {
  for (std::size_t f = 0; f < mesh.neighbour.size(); ++f) {
    ASSERT_LT(mesh.owner[f], mesh.neighbour[f]);
    if (f == 0) continue;
    ASSERT_LT(std::make_pair(mesh.owner[f - 1], mesh.neighbour[f - 1]),
              std::make_pair(mesh.owner[f], mesh.neighbour[f]));
  }
  int next = static_cast<int>(mesh.neighbour.size());
  for (const Patch& patch : mesh.patches) {
    EXPECT_EQ(patch.start, next);
    next += patch.size;
  }
  EXPECT_EQ(next, static_cast<int>(mesh.faces.size()));
}

void expect_same(const VolumeMesh& mesh, const Assembly& found) {
  const Content before = content(mesh), after = content(found.mesh);
  EXPECT_EQ(found.mesh.cells, mesh.cells);
  EXPECT_EQ(found.mesh.points.size(), mesh.points.size());
  EXPECT_EQ(found.mesh.faces.size(), mesh.faces.size());
  EXPECT_EQ(found.bodies, 1);
  EXPECT_EQ(found.warnings, std::vector<std::string>());
  EXPECT_EQ(patches(found.mesh), patches(mesh));
  EXPECT_EQ(corners_in_cells(found.mesh), corners_in_cells(mesh));
  EXPECT_TRUE(before.patch_of == after.patch_of);
  EXPECT_TRUE(before.cells == after.cells);
  expect_openfoams_order(found.mesh);
  double volume = 0;
  for (double v : cell_volumes(found.mesh)) {
    EXPECT_GT(v, 0);
    volume += v;
  }
  EXPECT_NEAR(volume / found.volume, 1, 1e-12);
}

TEST(Assemble, gives_a_mill_that_was_taken_apart_back) {
  unsigned seed = 1;
  for (const TestMill& m : all_mills()) {
    if (m.cell_size < 0.004) continue;
    SCOPED_TRACE(seed);
    const VolumeMesh mesh = mill(m);
    expect_same(mesh, assemble(taken_apart(mesh, seed++)));
  }
}

TEST(Assemble, gives_a_mill_with_grates_back_and_their_patches_types) {
  const Geometry geometry = mill_with_grates();
  const VolumeMesh mesh = make_mill_mesh(make_cross_section(geometry, 0.012), geometry, 3);
  const Assembly found = assemble(taken_apart(mesh, 3));
  expect_same(mesh, found);
  EXPECT_TRUE(patches(found.mesh).at("grates").second);
  EXPECT_TRUE(patches(found.mesh).at("inlet").second);
  EXPECT_EQ(found.baffles, 0);
}

TEST(Assemble, gives_a_mill_with_pulp_lifters_back_with_both_sides_of_their_walls) {
  for (const Geometry& geometry : {mill_with_pulp_lifters(), shipped_mill(2)}) {
    const VolumeMesh mesh = make_mill_mesh(make_cross_section(geometry, 0.012), geometry, 3);
    const Assembly found = assemble(taken_apart(mesh, 4));
    expect_same(mesh, found);
    EXPECT_GT(found.baffles, 100);
    EXPECT_EQ(found.points_joined, found.points_separated);
  }
}

/// Two cubes next to each other, each with all its faces.
PolygonSet two_whole_cubes() {
  PolygonSet set = cube();
  add_cube(set, {1, 0, 0}, 1);
  return set;
}

TEST(Assemble, takes_a_pair_of_faces_between_two_cells_for_a_wall) {
  PolygonSet set = two_whole_cubes();
  set.polygons[1].group = group_index(set, "left");  // the first cube's side to +x
  set.polygons[9].group = group_index(set, "right");
  for (std::size_t f = 0; f < 6; ++f) {  // points that the cube's faces share, as the sides of a wall need
    for (std::size_t cube : {0u, 6u}) {
      for (int& p : set.polygons[f + cube].points) {
        for (std::size_t first = cube; first < f + cube; ++first) {
          for (int q : set.polygons[first].points) {
            if (set.points[static_cast<std::size_t>(q)] == set.points[static_cast<std::size_t>(p)]) p = q;
          }
        }
      }
    }
  }
  const Assembly found = assemble(set);
  EXPECT_EQ(found.mesh.cells, 2);
  EXPECT_EQ(found.bodies, 2);
  EXPECT_EQ(found.baffles, 1);
  EXPECT_EQ(found.mesh.points.size(), 16u);
  EXPECT_TRUE(found.mesh.neighbour.empty());
  EXPECT_EQ(patches(found.mesh).at("left").first, 1);
  for (const Patch& patch : found.mesh.patches) {
    const double x =
        found.mesh
            .points[static_cast<std::size_t>(found.mesh.faces[static_cast<std::size_t>(patch.start)][0])]
            .x();
    if (patch.name != "left" && patch.name != "right") continue;
    EXPECT_EQ(x, 1);
    double largest = 0;  // of the cell's points
    for (std::size_t f = 0; f < found.mesh.faces.size(); ++f) {
      if (found.mesh.owner[f] != found.mesh.owner[static_cast<std::size_t>(patch.start)]) continue;
      for (int p : found.mesh.faces[f])
        largest = std::max(largest, found.mesh.points[static_cast<std::size_t>(p)].x());
    }
    EXPECT_EQ(largest, patch.name == "left" ? 1 : 2);
  }
  for (double volume : cell_volumes(found.mesh)) EXPECT_NEAR(volume, 1, 1e-15);
}

TEST(Assemble, warns_of_a_hole_in_the_outer_wall_of_many_cells) {
  VolumeMesh mesh = mill(ordinary_mills()[3]);
  PolygonSet set = taken_apart(mesh, 1);
  set.groups[static_cast<std::size_t>(group_index(set, "internal"))] = "inside";
  EXPECT_EQ(assemble(set).warnings, std::vector<std::string>());
  const auto wall = std::find_if(set.polygons.begin(), set.polygons.end(), [&](const Polygon& polygon) {
    return set.groups[static_cast<std::size_t>(polygon.group)] == "feedEnd" &&
           middle(set.points, polygon.points).norm() < 0.01;
  });
  set.polygons.erase(wall);
  const Assembly found = assemble(set);
  EXPECT_EQ(found.mesh.cells, mesh.cells - 1);
  ASSERT_EQ(found.warnings.size(), 5u);
  for (const std::string& warning : found.warnings) {
    EXPECT_NE(warning.find(" of the group 'inside' is at the boundary, and "), std::string::npos) << warning;
    EXPECT_NE(warning.find("around ("), std::string::npos) << warning;
  }
}

TEST(Assemble, warns_of_a_cell_that_a_missing_face_made_of_two) {
  const VolumeMesh mesh = mill(ordinary_mills()[3]);
  PolygonSet set = taken_apart(mesh, 1);
  const auto inside = std::find_if(set.polygons.begin(), set.polygons.end(), [&](const Polygon& polygon) {
    return set.groups[static_cast<std::size_t>(polygon.group)] == "internal";
  });
  set.polygons.erase(inside);
  const Assembly found = assemble(set);
  EXPECT_EQ(found.mesh.cells, mesh.cells - 1);
  ASSERT_EQ(found.warnings.size(), 1u);
  EXPECT_NE(found.warnings[0].find(
                " has 10 faces, and nearly all others have 6: is one between two cells missing?"),
            std::string::npos)
      << found.warnings[0];
}

TEST(Assemble, warns_of_two_cells_with_several_faces_between_them) {
  PolygonSet set = empty_set();
  add_prism(set, {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}, 0, 1);
  EXPECT_EQ(assemble(set).warnings, std::vector<std::string>());
  add_prism(set, {{1, 1}, {2, 1}, {2, 2}, {1, 2}}, 0, 1);
  set.polygons.erase(set.polygons.begin() + 8);
  set.polygons.erase(set.polygons.begin() + 10);
  EXPECT_EQ(
      assemble(set).warnings,
      std::vector<std::string>{"hand.obj:40: the face around (1 1.5 0.5) lies between the same two cells as "
                               "hand.obj:30, one of 2 such faces: is a face between them missing?"});
}

TEST(Assemble, gives_a_mill_with_warped_faces_back) {
  VolumeMesh mesh = mill(ordinary_mills()[3]);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> part(-0.15, 0.15);
  for (Vector3d& point : mesh.points) point += 0.003 * Vector3d(part(random), part(random), part(random));
  expect_same(mesh, assemble(taken_apart(mesh, 5)));
}

TEST(Assemble, makes_a_tetrahedron_one_cell) {
  PolygonSet set = empty_set();
  const Vector3d o(0, 0, 0), x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  add_polygon(set, {o, x, y});
  add_polygon(set, {o, x, z});
  add_polygon(set, {o, y, z});
  add_polygon(set, {x, y, z});
  const Assembly found = assemble(set);
  EXPECT_EQ(found.mesh.cells, 1);
  EXPECT_EQ(found.mesh.points.size(), 4u);
  EXPECT_EQ(found.points_joined, 8);
  EXPECT_NEAR(found.volume, 1.0 / 6, 1e-15);
  EXPECT_NEAR(cell_volumes(found.mesh)[0], 1.0 / 6, 1e-15);
}

TEST(Assemble, finds_two_cubes_on_both_sides_of_a_face) {
  PolygonSet set = cube();
  add_cube(set, {1, 0, 0}, 1);
  set.polygons.erase(set.polygons.begin() + 9);  // the second cube's side to -x
  const Assembly found = assemble(set);
  EXPECT_EQ(found.mesh.cells, 2);
  EXPECT_EQ(found.bodies, 1);
  EXPECT_EQ(found.mesh.neighbour, std::vector<int>{1});
  EXPECT_EQ(found.mesh.patches.size(), 3u);
  EXPECT_EQ(found.patches[0].name, "sides");
  EXPECT_EQ(found.patches[0].faces, 6);
  EXPECT_EQ(found.patches[0].between_cells, 1);
  EXPECT_NEAR(found.patches[0].area, 6, 1e-15);
  for (double volume : cell_volumes(found.mesh)) EXPECT_NEAR(volume, 1, 1e-15);
  expect_openfoams_order(found.mesh);
}

TEST(Assemble, finds_concave_cells) {
  PolygonSet set = empty_set();
  add_prism(set, {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}, 0, 1);
  const Assembly found = assemble(set);
  EXPECT_EQ(found.mesh.cells, 1);
  EXPECT_NEAR(found.volume, 3, 1e-15);

  add_prism(set, {{1, 1}, {2, 1}, {2, 2}, {1, 2}}, 0, 1);  // fills the corner; two of its sides are there
  set.polygons.erase(set.polygons.begin() + 8);
  set.polygons.erase(set.polygons.begin() + 10);
  const Assembly filled = assemble(set);
  EXPECT_EQ(filled.mesh.cells, 2);
  EXPECT_EQ(filled.mesh.neighbour.size(), 2u);
  EXPECT_NEAR(filled.volume, 4, 1e-15);
}

TEST(Assemble, finds_wedges_with_a_common_edge) {
  PolygonSet set = empty_set();
  const auto at = [](double angle, double z) { return Vector3d(std::cos(angle), std::sin(angle), z); };
  const Vector3d low(0, 0, 0), high(0, 0, 1);
  const int wedges = 5;  // of 0.2 rad
  for (int i = 0; i <= wedges; ++i) {
    const double a = 0.2 * i, b = a + 0.2;
    add_polygon(set, {low, at(a, 0), at(a, 1), high}, i == 0 || i == wedges ? "sides" : "internal");
    if (i == wedges) continue;
    add_polygon(set, {low, at(b, 0), at(a, 0)}, "ends");
    add_polygon(set, {high, at(b, 1), at(a, 1)}, "ends");
    add_polygon(set, {at(a, 0), at(b, 0), at(b, 1), at(a, 1)}, "rim");
  }
  const Assembly found = assemble(set);
  EXPECT_EQ(found.mesh.cells, wedges);
  EXPECT_EQ(found.mesh.neighbour.size(), 4u);
  EXPECT_EQ(found.mesh.patches.size(), 3u);
  for (double volume : cell_volumes(found.mesh)) EXPECT_NEAR(volume, std::sin(0.2) / 2, 1e-15);
}

TEST(Assemble, finds_prisms_over_polygons_of_many_sides) {
  PolygonSet set = empty_set();
  std::vector<Vector2d> section;
  for (int i = 0; i < 11; ++i) section.emplace_back(std::cos(2 * M_PI * i / 11), std::sin(2 * M_PI * i / 11));
  add_prism(set, section, 0, 2);
  const Assembly found = assemble(set);
  EXPECT_EQ(found.mesh.faces.size(), 13u);
  EXPECT_NEAR(found.volume, 11 * std::sin(2 * M_PI / 11), 1e-14);
}

TEST(Assemble, gives_the_space_between_nested_boxes_both_their_faces) {
  PolygonSet set = empty_set();
  add_cube(set, {0, 0, 0}, 4);
  add_cube(set, {0.5, 1, 1}, 2);
  const Assembly found = assemble(set);
  EXPECT_EQ(found.mesh.cells, 2);
  EXPECT_EQ(found.bodies, 1);
  EXPECT_EQ(found.mesh.neighbour.size(), 6u);
  EXPECT_EQ(found.mesh.faces.size(), 12u);
  EXPECT_NEAR(found.smallest_cell, 8, 1e-14);
  EXPECT_NEAR(found.largest_cell, 64 - 8, 1e-13);
  const auto volumes = cell_volumes(found.mesh);
  EXPECT_NEAR(*std::max_element(volumes.begin(), volumes.end()), 56, 1e-13);
}

TEST(Assemble, finds_the_innermost_of_three_nested_boxes_and_two_in_one) {
  PolygonSet set = empty_set();
  add_cube(set, {0, 0, 0}, 10);
  add_cube(set, {1, 1, 1}, 5);
  add_cube(set, {2, 2, 2}, 1);
  add_cube(set, {7, 7, 7}, 2);
  const Assembly found = assemble(set);
  std::vector<double> volumes = cell_volumes(found.mesh);
  std::sort(volumes.begin(), volumes.end());
  ASSERT_EQ(volumes.size(), 4u);
  EXPECT_NEAR(volumes[0], 1, 1e-12);
  EXPECT_NEAR(volumes[1], 8, 1e-12);
  EXPECT_NEAR(volumes[2], 125 - 1, 1e-12);
  EXPECT_NEAR(volumes[3], 1000 - 125 - 8, 1e-11);
}

TEST(Assemble, counts_bodies_apart) {
  PolygonSet set = cube();
  add_cube(set, {3, 0, 0}, 1);
  EXPECT_EQ(assemble(set).bodies, 2);
}

TEST(Assemble, welds_points_within_the_tolerance_only) {
  PolygonSet set = cube();
  set.points[0] += Vector3d(1e-6, 0, 0);
  EXPECT_THROW(assemble(set), PolygonError);
  EXPECT_EQ(assemble(set, 1e-5).mesh.points.size(), 8u);
  set.points.emplace_back(5, 5, 5);
  EXPECT_EQ(assemble(set, 1e-5).points_unused, 1);
}

std::string refusal(const PolygonSet& set) {
  try {
    assemble(set);
  } catch (const PolygonError& error) {
    return error.what();
  }
  return "accepted";
}

void expect_refusal(const PolygonSet& set, const std::string& sentence) {
  EXPECT_NE(refusal(set).find(sentence), std::string::npos) << refusal(set);
}

TEST(AssembleRefuses, a_hole_with_the_edges_around_it) {
  PolygonSet set = cube();
  set.polygons.pop_back();
  expect_refusal(set,
                 "hand.obj:10: a hole: the edge from (1 0 1) to (0 0 1) has no other face, one of 4 such "
                 "edges around (0.5 0.5 1)");
}

TEST(AssembleRefuses, a_face_that_hangs_free) {
  PolygonSet set = cube();
  add_polygon(set, {{0, 0, 1}, {0, 1, 1}, {0, 1, 2}, {0, 0, 2}});
  expect_refusal(set, "hand.obj:70: a dangling face, or a neighbouring face is missing: the edge from");
  PolygonSet alone = cube();
  add_polygon(alone, {{0.2, 0.2, 0.5}, {0.4, 0.2, 0.5}, {0.2, 0.4, 0.5}});
  expect_refusal(alone, "hand.obj:70: a dangling face, or a neighbouring face is missing: the edge from");
}

TEST(AssembleRefuses, a_face_with_one_cell_on_both_sides) {
  PolygonSet set = empty_set();  // a square ring, cut across once
  const std::array<std::array<Vector2d, 4>, 2> rings{
      {{Vector2d(0, 0), Vector2d(3, 0), Vector2d(3, 3), Vector2d(0, 3)},
       {Vector2d(1, 1), Vector2d(2, 1), Vector2d(2, 2), Vector2d(1, 2)}}};
  const auto at = [&](std::size_t ring, std::size_t i, double z) {
    return Vector3d(rings[ring][i % 4].x(), rings[ring][i % 4].y(), z);
  };
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t ring : {0u, 1u})
      add_polygon(set, {at(ring, i, 0), at(ring, i + 1, 0), at(ring, i + 1, 1), at(ring, i, 1)});
    for (double z : {0.0, 1.0})
      add_polygon(set, {at(0, i, z), at(0, i + 1, z), at(1, i + 1, z), at(1, i, z)});
  }
  EXPECT_EQ(refusal(set), "accepted");
  add_polygon(set, {at(0, 0, 0), at(1, 0, 0), at(1, 0, 1), at(0, 0, 1)});
  expect_refusal(
      set, "hand.obj:170: a dangling face: both sides of the face around (0.5 0.5 0.5) are in the same cell");
}

TEST(AssembleRefuses, a_doubled_face) {
  PolygonSet set = cube();
  add_polygon(set, {{1, 0, 1}, {0, 0, 1}, {0, 0, 0}, {1, 0, 0}});
  expect_refusal(set, "hand.obj:70: a doubled face: the same points as hand.obj:10, around (0.5 0 0.5)");
}

TEST(AssembleRefuses, pairs_of_faces_that_are_no_wall_between_two_cells) {
  PolygonSet same_points = two_whole_cubes();
  same_points.polygons[9].points = same_points.polygons[1].points;
  expect_refusal(same_points,
                 "hand.obj:100: a doubled face: the same points as hand.obj:20, around (1 0.5 0.5)");
  PolygonSet internal = two_whole_cubes();
  internal.polygons[9].group = group_index(internal, "internal");
  expect_refusal(internal, "hand.obj:100: a doubled face: the same points as hand.obj:20");
  PolygonSet thrice = two_whole_cubes();
  add_polygon(thrice, {{1, 0, 0}, {1, 1, 0}, {1, 1, 1}, {1, 0, 1}});
  expect_refusal(thrice, "hand.obj:130: a doubled face: the same points as hand.obj:100");
  PolygonSet unknown = two_whole_cubes();  // no face of either cube shares a point with it
  unknown.polygons[9].group = group_index(unknown, "right");
  expect_refusal(unknown, "hand.obj:100: a doubled face: the same points as hand.obj:20");
}

TEST(AssembleRefuses, doubled_faces_that_are_no_faces_once_only) {
  PolygonSet set = cube();
  add_polygon(set, {});
  add_polygon(set, {});
  EXPECT_EQ(refusal(set),
            "hand.obj:70: a face of 0 points: expected three or more\n"
            "hand.obj:80: a face of 0 points: expected three or more");
}

TEST(AssembleRefuses, bodies_that_touch_in_an_edge_only) {
  PolygonSet set = cube();
  add_cube(set, {1, 1, 0}, 1);
  expect_refusal(set,
                 "a non-manifold edge from (1 1 0) to (1 1 1): around it the outside appears more than once, "
                 "because 4 faces meet there");
}

TEST(AssembleRefuses, faces_that_cross) {
  PolygonSet set = cube();
  add_cube(set, {0.5, 0.5, 0.5}, 1);
  expect_refusal(set, "hand.obj:20: the face crosses or touches hand.obj:70 near (");
}

TEST(AssembleRefuses, faces_that_overlap_at_an_edge) {
  PolygonSet set = cube();
  add_polygon(set, {{0, 0, 0}, {0, 0, 1}, {0.5, 0, 0.5}});
  add_polygon(set, {{0, 0, 0}, {0.5, 0, 0.5}, {0.2, 0.5, 0.5}});
  add_polygon(set, {{0, 0, 1}, {0.5, 0, 0.5}, {0.2, 0.5, 0.5}});
  add_polygon(set, {{0, 0, 1}, {0, 0, 0}, {0.2, 0.5, 0.5}});
  expect_refusal(set, "overlaps with hand.obj:");
  expect_refusal(set, "at the edge from (0 0 0) to (0 0 1)");
}

TEST(AssembleRefuses, t_junctions_rather_than_the_holes_that_they_make) {
  PolygonSet set = cube();
  set.polygons.pop_back();
  add_polygon(set, {{0, 0, 1}, {0.5, 0, 1}, {0.5, 1, 1}, {0, 1, 1}});
  add_polygon(set, {{0.5, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0.5, 1, 1}});
  expect_refusal(set,
                 "hand.obj:10: a T-junction: the edge from (1 0 1) to (0 0 1) has the point (0.5 0 1) on it");
  EXPECT_EQ(refusal(set).find("hole"), std::string::npos);
}

TEST(Assemble, leaves_out_points_of_no_face_wherever_they_are) {
  PolygonSet set = cube();
  set.points.emplace_back(0.5, 0, 0);  // on an edge
  EXPECT_EQ(assemble(set).points_unused, 1);
}

TEST(AssembleRefuses, polygons_that_are_no_faces) {
  PolygonSet set = cube();
  add_polygon(set, {{0, 0, 0}, {1, 0, 0}});
  add_polygon(set, {{0, 0, 0}, {1, 0, 0}, {0, 0, 0}, {0, 1, 0}});
  add_polygon(set, {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}});
  add_polygon(set, {{0, 0, 5}, {2, 2, 5}, {3, 0, 5}, {0, 1, 5}});
  expect_refusal(set, "hand.obj:70: a face of 2 points around (0.5 0 0): expected three or more");
  expect_refusal(set, "hand.obj:80: the face has the point (0 0 0) twice");
  expect_refusal(set, "hand.obj:90: the face around (1 0 0) has no area");
  expect_refusal(set, "hand.obj:100: sides of the face around (1.25 0.75 5) cross");
}

TEST(AssembleRefuses, faces_that_enclose_nothing) {
  PolygonSet set = empty_set();
  const Vector3d a(0, 0, 0), b(1, 0, 0), c(1, 1, 0), d(0, 1, 0);
  add_polygon(set, {a, b, c});
  add_polygon(set, {a, c, d});
  add_polygon(set, {a, b, d});
  add_polygon(set, {b, c, d});
  expect_refusal(set, "hand.obj:10: the face overlaps with hand.obj:");
}

TEST(AssembleRefuses, sheets_that_enclose_nothing) {
  PolygonSet set = empty_set();  // a square and its four triangles, all in one plane
  const Vector3d a(0, 0, 0), b(1, 0, 0), c(1, 1, 0), d(0, 1, 0), m(0.5, 0.5, 0);
  add_polygon(set, {a, b, c, d});
  for (const auto& [from, to] : {std::pair{a, b}, {b, c}, {c, d}, {d, a}}) add_polygon(set, {from, to, m});
  expect_refusal(set, "hand.obj:10: the face overlaps with hand.obj:20 at the edge from (0 0 0) to (1 0 0)");
}

TEST(AssembleRefuses, an_internal_face_at_the_boundary) {
  const VolumeMesh mesh = mill(ordinary_mills()[3]);
  PolygonSet set = taken_apart(mesh, 1);
  const auto at_axis = [&](const Polygon& polygon) {
    return set.groups[static_cast<std::size_t>(polygon.group)] == "feedEnd" &&
           middle(set.points, polygon.points).norm() < 0.01;
  };
  const auto wall = std::find_if(set.polygons.begin(), set.polygons.end(), at_axis);
  set.polygons.erase(wall);
  expect_refusal(set, "of the group 'internal' has a cell on one side only: a neighbouring face is missing");
}

TEST(AssembleRefuses, a_name_that_cannot_name_a_patch) {
  for (const std::string name : {"a/b", "1wall", "-", "in let", "a\u00e9", "a:b", ""}) {
    PolygonSet set = cube();
    set.groups[1] = name;
    const auto first = std::find_if(set.polygons.begin(), set.polygons.end(),
                                    [](const Polygon& polygon) { return polygon.group == 1; });
    ASSERT_NE(first, set.polygons.end());
    expect_refusal(set, "hand.obj:" + std::to_string(first->line) + ": the group '" + name +
                            "' cannot name a patch of OpenFOAM: expected a letter or '_'");
  }
  for (const std::string name : {"a", "_", "wall.1-B_2"}) {
    PolygonSet set = cube();
    set.groups[1] = name;
    EXPECT_EQ(refusal(set), "accepted");
  }
}

TEST(AssembleRefuses, with_ten_sentences_of_a_kind_and_the_number_of_the_rest) {
  PolygonSet set = cube();
  for (int i = 0; i < 13; ++i) add_polygon(set, {{1.0 * i, 0, 0}, {1, 1, 1}});
  expect_refusal(set, "\nand 3 more: too few points");
}

}  // namespace
}  // namespace millfoam::meshing
