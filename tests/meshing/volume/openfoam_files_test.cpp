// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/volume/openfoam_files.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <sstream>

#include "meshing/mill/mill_charge.hpp"
#include "meshing/mill_mesh/mill_mesh.hpp"
#include "meshing/mill_mesh/section_blocks.hpp"
#include "meshing/results/mill_properties.hpp"
#include "tests/meshing/test_geometry.hpp"
#include "tests/meshing/test_mill.hpp"

namespace millfoam::meshing {
namespace {

std::string text_of(const std::filesystem::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// The numbers after a file's header, brackets taken as blanks.
std::vector<double> numbers_of(const std::filesystem::path& file) {
  std::string text = text_of(file);
  text = text.substr(text.find('}') + 1);
  for (char& c : text) {
    if (c == '(' || c == ')') c = ' ';
  }
  std::istringstream words(text);
  return {std::istream_iterator<double>(words), {}};
}

VolumeMesh slice() {
  TestMill mill = test_mill(0.12, 12, 0.008, 0.006, 0.006, Ends::periodic);
  return make_mill_mesh(make_cross_section(mill.geometry, mill.cell_size), mill.geometry, 3);
}

TEST(PolyMesh, reads_back_to_the_last_bit) {
  const TemporaryFolder folder;
  const VolumeMesh mesh = turned(slice(), 0.3);
  write_poly_mesh(mesh, folder.path());
  const auto poly_mesh = folder.path() / "constant" / "polyMesh";

  const auto points = numbers_of(poly_mesh / "points");
  ASSERT_EQ(points.size(), 1 + 3 * mesh.points.size());
  EXPECT_EQ(points[0], static_cast<double>(mesh.points.size()));
  for (std::size_t p = 0; p < mesh.points.size(); ++p) {
    EXPECT_EQ(Eigen::Vector3d(points[1 + 3 * p], points[2 + 3 * p], points[3 + 3 * p]), mesh.points[p]);
  }
  const auto faces = numbers_of(poly_mesh / "faces");
  ASSERT_EQ(faces.size(), 1 + 5 * mesh.faces.size());
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    EXPECT_EQ(faces[1 + 5 * f], 4);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(faces[2 + 5 * f + i], mesh.faces[f][i]);
  }
  const auto owner = numbers_of(poly_mesh / "owner");
  EXPECT_EQ(std::vector<int>(owner.begin() + 1, owner.end()), mesh.owner);
  const auto neighbour = numbers_of(poly_mesh / "neighbour");
  EXPECT_EQ(std::vector<int>(neighbour.begin() + 1, neighbour.end()), mesh.neighbour);
}

TEST(PolyMesh, joins_the_ends_of_a_slice_by_its_length) {
  const TemporaryFolder folder;
  write_poly_mesh(slice(), folder.path());
  const std::string boundary = text_of(folder.path() / "constant" / "polyMesh" / "boundary");
  const std::string feed =
      boundary.substr(boundary.find("feedEnd"), boundary.find("dischargeEnd\n") - boundary.find("feedEnd"));
  EXPECT_NE(feed.find("cyclic"), std::string::npos);
  EXPECT_NE(feed.find("neighbourPatch  dischargeEnd;"), std::string::npos);
  EXPECT_NE(feed.find("separationVector (0 0 0.024);"), std::string::npos);
  EXPECT_NE(boundary.find("separationVector (0 0 -0.024);"), std::string::npos);
}

TEST(PolyMesh, takes_the_place_of_an_older_one_with_all_that_is_in_it) {
  const TemporaryFolder folder;
  const auto poly_mesh = folder.path() / "constant" / "polyMesh";
  std::filesystem::create_directories(poly_mesh / "sets");
  write_poly_mesh(slice(), folder.path());
  EXPECT_FALSE(std::filesystem::exists(poly_mesh / "sets"));
  EXPECT_FALSE(std::filesystem::exists(poly_mesh.string() + ".partial"));
  EXPECT_TRUE(std::filesystem::exists(poly_mesh / "boundary"));
}

TEST(PolyMesh, says_where_it_cannot_be_written) {
  const TemporaryFolder folder;
  const auto file = folder.write("case", "not a folder");
  try {
    write_poly_mesh(slice(), file);
    FAIL();
  } catch (const std::exception& error) {
    EXPECT_NE(std::string(error.what()).find(file.string()), std::string::npos) << error.what();
  }
}

TEST(MillProperties, hold_one_plain_line_per_number) {
  const TemporaryFolder folder;
  const MillDescription mill = describe_mill(folder.write("mill.yaml", example_mill));
  write_mill_properties(mill, {}, 0.25, folder.path());
  const std::string text = text_of(folder.path() / "constant" / "millProperties");
  for (const char* line :
       {"\nradius 0.06;\n", "\nlength 0.024;\n", "\nlifterHeight 0.008;\n", "\nendsType plain;\n",
        "\ntime0 0.25;\n", "\nballDensity 2700;\n", "\nslurryDensity 1239;\n", "\nslurryViscosity 0.0014;\n",
        "\nyieldStress 0.16;\n", "\nslurryViscosityRatio 1000;\n", "\nsurfaceTension 0.07;\n",
        "\n    level -0.012;\n", "\nairDensity 1.2;\n", "\nairViscosity 1.8e-05;\n"}) {
    EXPECT_NE(text.find(line), std::string::npos) << line;
  }
  const auto number = [&](const std::string& key) {
    return std::stod(text.substr(text.find("\n" + key + " ") + 2 + key.size()));
  };
  EXPECT_DOUBLE_EQ(number("omega"), -0.5 * std::sqrt(9.81 / 0.06));
  EXPECT_DOUBLE_EQ(number("slurryKinematicViscosity"), 0.0014 / 1239);
  EXPECT_DOUBLE_EQ(number("airKinematicViscosity"), 1.8e-5 / 1.2);
}

TEST(MillProperties, hold_the_shapes_of_the_balls_with_their_shares_of_the_volume) {
  const TemporaryFolder folder;
  MillDescription mill = describe_mill(folder.write("mill.yaml", example_mill));
  // Share of the volume, sphericity and crosswise sphericity of each class
  const auto shapes = [&] {
    write_mill_properties(mill, {}, 0, folder.path());
    const std::string text = text_of(folder.path() / "constant" / "millProperties");
    const auto begin = text.find("((", text.find("\ndragShapes ")), end = text.find("))", begin);
    std::string line = text.substr(begin, end - begin);
    std::replace_if(
        line.begin(), line.end(), [](char c) { return c == '(' || c == ')'; }, ' ');
    std::istringstream words(line);
    return std::vector<double>(std::istream_iterator<double>(words), {});
  };
  SizeClass& size = mill.mill.charge.classes.front();
  mill.mill.charge.classes.resize(1);
  EXPECT_EQ(shapes(), (std::vector<double>{1, 1, 1}));
  // Four balls of one size, three of them blunt
  SizeClass blunt = size;
  size.mass = ball_mass(mill.mill, size.diameter);
  blunt.shape = Superquadric{{size.diameter / 2, size.diameter / 2, size.diameter / 2}, 4};
  blunt.mass = 3 * size.mass;
  mill.mill.charge.classes.push_back(blunt);
  const std::vector<double> found = shapes();
  ASSERT_EQ(found.size(), 6U);
  EXPECT_NEAR(found[0], 0.25, 1e-12);
  EXPECT_EQ(found[1], 1);
  EXPECT_NEAR(found[3], 0.75, 1e-12);
  EXPECT_EQ(found[4], sphericity(*blunt.shape));
  EXPECT_EQ(found[5], found[4]);
}

TEST(MillProperties, hold_the_openings_of_a_mill_that_has_them) {
  const TemporaryFolder folder;
  MillDescription mill = describe_mill(folder.write("mill.yaml", example_mill));
  const auto properties = [&](const Openings& openings) {
    write_mill_properties(mill, openings, 0, folder.path());
    return text_of(folder.path() / "constant" / "millProperties");
  };
  EXPECT_EQ(properties({}).find("inlet"), std::string::npos);
  EXPECT_EQ(properties({}).find("grateArea"), std::string::npos);
  EXPECT_NE(properties({}).find("\ngrates no;\n"), std::string::npos);
  mill.mill.geometry = mill_with_pulp_lifters();
  Openings openings;
  openings.inlet_area = 0.0129;
  openings.grate_area = 0.022;
  openings.outlet_area = 0.013;
  const std::string text = properties(openings);
  for (const char* line :
       {"\ninletArea 0.0129;\n", "\ngrateInnerRadius 0.09;\n", "\ngrateOuterRadius 0.13;\n",
        "\ngrateArea 0.022;\n", "\ngrateOpenFraction 0.3;\n", "\nemptyZones (pulpLifters);\n",
        "\npulpLifterDepth 0.03;\n", "\noutletRadius 0.064;\n", "\noutletArea 0.013;\n"}) {
    EXPECT_NE(text.find(line), std::string::npos) << line;
  }
}

TEST(PolyMesh, has_zones_of_the_grates_and_openings_that_are_no_walls) {
  const TemporaryFolder folder;
  const Geometry mill = mill_with_pulp_lifters();
  const VolumeMesh mesh = make_mill_mesh(make_cross_section(mill, 0.012), mill, 3);
  write_poly_mesh(mesh, folder.path());
  const auto poly_mesh = folder.path() / "constant" / "polyMesh";
  const std::string cells = text_of(poly_mesh / "cellZones"), faces = text_of(poly_mesh / "faceZones");
  const std::string behind = std::to_string(mesh.cell_zones.at(0).members.size());
  EXPECT_NE(cells.find("pulpLifters\n{\n    type cellZone;\n    cellLabels List<label> " + behind + "\n("),
            std::string::npos);
  const std::string size = std::to_string(mesh.face_zones.at(0).members.size());
  EXPECT_NE(faces.find("grates\n{\n    type faceZone;\n    faceLabels List<label> " + size + "\n("),
            std::string::npos);
  EXPECT_NE(faces.find("flipMap List<bool> " + size + "{0};"), std::string::npos);
  const std::string boundary = text_of(poly_mesh / "boundary");
  EXPECT_NE(boundary.find("    inlet\n    {\n        type            patch;"), std::string::npos);
  EXPECT_NE(boundary.find("    outlet\n    {\n        type            patch;"), std::string::npos);
  EXPECT_NE(boundary.find("    pulpLifters\n    {\n        type            wall;"), std::string::npos);
}

}  // namespace
}  // namespace millfoam::meshing
