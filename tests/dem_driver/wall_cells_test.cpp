// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/wall_cells.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>

#include "dem_driver/wall_forces_file.hpp"
#include "small_mill.hpp"

namespace millfoam::dem_driver {
namespace {

using tests::TemporaryFolder;

/// A square of 30 mm in the plane z = 0.1 m, of two triangles.
class WallCellsTest : public ::testing::Test {
 protected:
  WallCellsTest() {
    std::ofstream(temporary_.path() / "plate.stl") << "solid plate\nfacet normal 0 0 1\nouter loop\nvertex 0 "
                                                      "0 0.1\nvertex 0.03 0 0.1\nvertex 0 0.03 0.1\n"
                                                      "endloop\nendfacet\nfacet normal 0 0 1\nouter "
                                                      "loop\nvertex 0.03 0.03 0.1\nvertex 0 0.03 0.1\nvertex "
                                                      "0.03 0 0.1\nendloop\nendfacet\nendsolid plate\n";
  }
  TemporaryFolder temporary_;
};

TEST_F(WallCellsTest, NoEdgeIsLongerThanWishedAndTheAreaIsThatOfTheWall) {
  const WallCells cells(temporary_.path(), {"plate"}, 0.01);
  ASSERT_EQ(cells.size(), 50U);  // the longest edge is 42 mm: 5 parts
  double area = 0;
  for (const Triangle& cell : cells.corners()) {
    EXPECT_NEAR(area_of(cell), 9e-4 / 50, 1e-12);
    area += area_of(cell);
  }
  EXPECT_NEAR(area, 9e-4, 1e-12);
}

TEST_F(WallCellsTest, TheMiddleOfEachCellIsInIt) {
  const WallCells cells(temporary_.path(), {"plate", "plate"}, 0.007);
  const auto corners = cells.corners();
  ASSERT_EQ(corners.size(), cells.size());
  const auto parts = cells.part_of_cells();
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    std::array<double, 3> middle{};
    for (const auto& corner : corners[cell])
      for (std::size_t k = 0; k < 3; ++k) middle[k] += corner[k] / 3;
    const auto part = static_cast<std::size_t>(parts[cell]);
    const std::size_t triangle = cell % (cells.size() / 2) < cells.size() / 4 ? 0 : 1;
    EXPECT_EQ(cells.cell_of(part, triangle, middle), cell);
    middle[2] += 1e-4;  // a contact point is not exactly on the triangle
    EXPECT_EQ(cells.cell_of(part, triangle, middle), cell);
  }
}

TEST_F(WallCellsTest, APointBesideTheTriangleIsInOneOfItsCells) {
  const WallCells cells(temporary_.path(), {"plate"}, 0.01);
  for (const double x : {-0.01, 0.0, 0.015, 0.03, 0.05})
    for (const double y : {-0.01, 0.0, 0.015, 0.03, 0.05}) {
      EXPECT_LT(cells.cell_of(0, 0, {x, y, 0.1}), 25U);
      EXPECT_GE(cells.cell_of(0, 1, {x, y, 0.1}), 25U);
      EXPECT_LT(cells.cell_of(0, 1, {x, y, 0.1}), 50U);
    }
}

TEST_F(WallCellsTest, TheFileHasTheMeansOfTheCells) {
  const WallCells cells(temporary_.path(), {"plate"}, 1);
  WallSums sums(cells.size());
  ContactForce contact;
  contact.normal = {0, 0, 1};
  contact.push = 4;
  contact.force = {3, 0, 4};
  for (int step = 0; step < 5; ++step) sums.add(1, contact, 0.2, {1e-3, 2e-3, 0});
  EXPECT_EQ(sums.of(0).contacts, 0);
  EXPECT_EQ(sums.of(1).contacts, 5);
  EXPECT_NEAR(sums.of(1).shear, 15, 1e-12);
  EXPECT_NEAR(sums.of(1).force[2], -20, 1e-12);
  EXPECT_NEAR(sums.of(1).moment, 1, 1e-12);
  std::ostringstream out;
  write_wall_forces(out, cells, sums, 10, 20, 0.1);
  const auto field = [&](const std::string& name) {
    const std::string text = out.str();
    std::istringstream in(
        text.substr(text.find("format=\"ascii\">", text.find("Name=\"" + name + '"')) + 15));
    double first = 0, second = 0;
    in >> first >> second;
    EXPECT_EQ(first, 0) << name;
    return second;
  };
  const double area = 4.5e-4;
  EXPECT_NEAR(field("normal_force_N"), 2, 1e-7);
  EXPECT_NEAR(field("tangential_force_N"), 1.5, 1e-7);
  EXPECT_NEAR(field("contacts"), 0.5, 1e-7);
  EXPECT_NEAR(field("normal_stress_Pa") * area, 2, 1e-6);
  EXPECT_NEAR(field("sliding_power_W_m2") * area, 0.01, 1e-8);
  EXPECT_NEAR(field("impact_power_W_m2") * area, 0.005, 1e-8);
}

}  // namespace
}  // namespace millfoam::dem_driver
