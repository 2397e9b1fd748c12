// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/polygons/face_file.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>

#include "meshing/mill_mesh/mill_mesh.hpp"
#include "meshing/mill_mesh/section_blocks.hpp"
#include "meshing/polygons/assembly.hpp"
#include "meshing/polygons/obj_file.hpp"
#include "tests/meshing/polygon_support.hpp"
#include "tests/meshing/test_geometry.hpp"
#include "tests/meshing/test_mill.hpp"

namespace millfoam::meshing {
namespace {

using Eigen::Vector3d;

PolygonSet read(const std::string& name, const std::string& text) {
  const TemporaryFolder folder;
  return read_faces(folder.write(name, text));
}

/// The message with which a file is refused, without its folder.
std::string read_refusal(const std::string& name, const std::string& text) {
  try {
    read(name, text);
  } catch (const PolygonError& error) {
    const std::string message = error.what();
    return message.substr(message.find(name));
  }
  return "accepted";
}

const std::string tetrahedron = R"(# by hand
v 0 0 0
v 1 0 0 1.0
v 0 +1e0 0
v 0 0 1
f 1 2 3
g base more
usemtl steel
f 1/1 2/2 \
  4/3
g
f 1//1 -2 -1
g base
f 2/5/7 3 4
)";

TEST(ReadObj, gives_points_faces_groups_and_lines) {
  const PolygonSet set = read("t.obj", tetrahedron);
  ASSERT_EQ(set.points.size(), 4u);
  EXPECT_EQ(set.points[2], Vector3d(0, 1, 0));
  ASSERT_EQ(set.polygons.size(), 4u);
  EXPECT_EQ(set.groups, (std::vector<std::string>{"walls", "base"}));
  EXPECT_EQ(set.polygons[1].points, (std::vector<int>{0, 1, 3}));
  EXPECT_EQ(set.polygons[1].group, 1);
  EXPECT_EQ(set.polygons[1].line, 9);
  EXPECT_EQ(set.polygons[2].points, (std::vector<int>{0, 2, 3}));
  EXPECT_EQ(set.polygons[2].group, 0);
  EXPECT_EQ(set.polygons[3].line, 14);
  EXPECT_EQ(assemble(set).mesh.cells, 1);
}

TEST(ReadObj, refuses_what_it_cannot_read_with_the_line) {
  EXPECT_EQ(read_refusal("t.obj", ""), "t.obj: has no faces (lines that begin with 'f')");
  EXPECT_EQ(read_refusal("t.obj", "v 0 0 nan\n"),
            "t.obj:1: 'nan': expected three coordinates, finite numbers");
  EXPECT_EQ(read_refusal("t.obj", "v 0 0\n"), "t.obj:1: '': expected three coordinates, finite numbers");
  EXPECT_EQ(read_refusal("t.obj", "v 0 0 0\nf 1 2 3\n"),
            "t.obj:2: point 2: expected an index from 1 to 1, the number of points so far");
  EXPECT_EQ(read_refusal("t.obj", "v 0 0 0\nf 1 0 1\n"),
            "t.obj:2: point 0: expected an index from 1 to 1, the number of points so far");
  EXPECT_EQ(read_refusal("t.obj", "v 0 0 0\nf 1 x\n"), "t.obj:2: 'x': expected the index of a point");
  EXPECT_EQ(read_refusal("t.obj", "\nsolid cube\n"),
            "t.obj:2: 'solid': expected v, f, g or another keyword of a polygonal OBJ file");
}

TEST(ReadFaces, refuses_missing_files_and_other_formats) {
  const auto message = [](const std::string& file) {
    try {
      read_faces(file);
    } catch (const PolygonError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_EQ(message("none.obj"), "none.obj: cannot be read");
  EXPECT_EQ(message("none.PLY"), "none.PLY: cannot be read");
  EXPECT_EQ(message("cube.vtk"), "cube.vtk: expected a file of faces that ends in .obj or .ply");
}

TEST(WriteObj, gives_a_mesh_back_to_the_last_bit) {
  const TemporaryFolder folder;
  const TestMill mill = ordinary_mills()[3];
  const VolumeMesh mesh = make_mill_mesh(make_cross_section(mill.geometry, mill.cell_size), mill.geometry, 2);
  write_obj(mesh, folder.path() / "mesh.obj");
  const PolygonSet set = read_faces(folder.path() / "mesh.obj");
  EXPECT_EQ(set.points, mesh.points);
  EXPECT_EQ(set.groups,
            (std::vector<std::string>{"shell", "lifters", "feedEnd", "dischargeEnd", "internal"}));
  const Assembly found = assemble(set);
  EXPECT_EQ(found.mesh.cells, mesh.cells);
  ASSERT_EQ(found.mesh.patches.size(), mesh.patches.size());
  for (std::size_t i = 0; i < mesh.patches.size(); ++i) {
    EXPECT_EQ(found.mesh.patches[i].name, mesh.patches[i].name);
    EXPECT_EQ(found.mesh.patches[i].start, mesh.patches[i].start);
    EXPECT_EQ(found.mesh.patches[i].size, mesh.patches[i].size);
  }
}

TEST(WriteObj, says_which_patches_are_no_walls) {
  const TemporaryFolder folder;
  const Geometry geometry = mill_with_grates();
  const VolumeMesh mesh = make_mill_mesh(make_cross_section(geometry, 0.012), geometry, 2);
  write_obj(mesh, folder.path() / "mesh.obj");
  std::ifstream file(folder.path() / "mesh.obj");
  std::vector<std::string> groups;
  for (std::string line; std::getline(file, line);) {
    if (line[0] == 'g') groups.push_back(line);
  }
  EXPECT_EQ(groups, (std::vector<std::string>{"g shell", "g lifters", "g feedEnd", "g dischargeEnd",
                                              "g inlet patch", "g grates patch", "g internal"}));
  EXPECT_EQ(read_faces(folder.path() / "mesh.obj").open, (std::set<std::string>{"inlet", "grates"}));
}

TEST(ReadObj, takes_no_other_word_for_a_type) {
  EXPECT_TRUE(read("t.obj", tetrahedron).open.empty());
}

std::string ply_header(const std::string& format) {
  return "ply\nformat " + format + R"( 1.0
comment a tetrahedron with an element that is passed over
element vertex 4
property double x
property double y
property double z
property uchar red
element face 4
property int patch
property list uchar int vertex_indices
element edge 1
property int vertex1
end_header
)";
}

TEST(ReadPly, reads_text) {
  const PolygonSet set = read("t.ply", ply_header("ascii") +
                                           "0 0 0 9\n1 0 0 9\n0 1 0 9\n0 0 1 9\n"
                                           "2 3 0 1 2\n2 3 0 1 3\n7 3 0 2 3\n7 3 1 2 3\n0\n");
  EXPECT_EQ(set.groups, (std::vector<std::string>{"patch2", "patch7"}));
  EXPECT_EQ(set.polygons[2].line, 21);
  EXPECT_EQ(set.polygons[3].points, (std::vector<int>{1, 2, 3}));
  EXPECT_EQ(assemble(set).mesh.patches.size(), 2u);
}

/// The bytes of a number, in either order.
template <typename Number>
void append(std::string& bytes, Number number, bool big) {
  std::string part(sizeof number, '\0');
  std::memcpy(part.data(), &number, sizeof number);
  if (big) std::reverse(part.begin(), part.end());
  bytes += part;
}

std::string binary_tetrahedron(bool big) {
  std::string bytes = ply_header(big ? "binary_big_endian" : "binary_little_endian");
  for (int i = 0; i < 4; ++i) {
    for (int axis = 0; axis < 3; ++axis) append(bytes, axis + 1 == i ? 0.1 : 0.0, big);
    append(bytes, static_cast<unsigned char>(9), big);
  }
  for (int skipped = 3; skipped >= 0; --skipped) {
    append(bytes, skipped < 2 ? 7 : 2, big);
    append(bytes, static_cast<unsigned char>(3), big);
    for (int i = 0; i < 4; ++i) {
      if (i != skipped) append(bytes, i, big);
    }
  }
  append(bytes, 0, big);
  return bytes;
}

TEST(ReadPly, reads_binary_of_either_byte_order) {
  for (const bool big : {false, true}) {
    const PolygonSet set = read("t.ply", binary_tetrahedron(big));
    EXPECT_EQ(set.points[3], Vector3d(0, 0, 0.1));
    EXPECT_EQ(set.polygons[3].points, (std::vector<int>{1, 2, 3}));
    EXPECT_EQ(place(set, 3).substr(place(set, 3).find("t.ply")), "t.ply: face 4");
    EXPECT_NEAR(assemble(set).volume, 1e-3 / 6, 1e-18);
  }
}

TEST(ReadPly, refuses_what_it_cannot_read_with_the_line_or_the_item) {
  const std::string text = ply_header("ascii") + "0 0 0 9\n1 0 0 9\n0 1 0 9\n0 0 1 9\n";
  EXPECT_EQ(read_refusal("t.ply", "solid\n"), "t.ply:1: expected 'ply' in the first line");
  EXPECT_EQ(read_refusal("t.ply", "ply\n"), "t.ply:2: the file ends: expected 'end_header'");
  EXPECT_EQ(read_refusal("t.ply", "ply\nformat binary 1.0\n"),
            "t.ply:2: format 'binary': expected ascii, binary_little_endian or binary_big_endian");
  EXPECT_EQ(read_refusal("t.ply", text + "2 3 0 1 x\n"), "t.ply:19: face 1: 'x': expected a finite number");
  EXPECT_EQ(read_refusal("t.ply", text + "2 3 0 1 2\n"), "t.ply:20: face 2: the file ends: expected face 2");
  EXPECT_EQ(read_refusal("t.ply", text + "2 3 0 1 4\n2 3 0 1 2\n2 3 0 1 2\n2 3 0 1 2\n0\n"),
            "t.ply:19: point 4: expected an index from 0 to 3");
  EXPECT_EQ(read_refusal("t.ply", text + "2 3 0 1 -1\n"),
            "t.ply:19: face 1: point -1: expected an index from 0");
  EXPECT_EQ(read_refusal("t.ply", text + "2.4 3 0 1 2\n"),
            "t.ply:19: face 1: patch 2.4: expected a whole number from 0");
  EXPECT_EQ(read_refusal("t.ply", text + "-2 3 0 1 2\n"),
            "t.ply:19: face 1: patch -2: expected a whole number from 0");
  EXPECT_EQ(read_refusal("t.ply", with(text, "vertex_indices", "corners")),
            "t.ply:14: the header's element 'face' has no list 'vertex_indices' or 'vertex_index'");
  EXPECT_EQ(read_refusal("t.ply", with(text, "list uchar int vertex_indices", "int vertex_index")),
            "t.ply:14: the header's element 'face' has no list 'vertex_indices' or 'vertex_index'");
  std::string binary = binary_tetrahedron(false);
  binary.resize(binary.size() - 8);
  EXPECT_EQ(read_refusal("t.ply", binary), "t.ply: face 4: the file ends here");
  EXPECT_EQ(read_refusal("t.ply", "ply\nformat ascii 1.0\nelement vertex 999999999\n"),
            "t.ply:3: expected 'element NAME COUNT' with a count that the file's size allows");
}

}  // namespace
}  // namespace millfoam::meshing
