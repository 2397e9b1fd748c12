// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/walls/wall_surface.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <fstream>
#include <map>
#include <sstream>

#include "meshing/mill_mesh/mill_mesh.hpp"
#include "meshing/mill_mesh/section_blocks.hpp"
#include "meshing/results/mesh_results.hpp"
#include "meshing/volume/mesh_quality.hpp"
#include "meshing/walls/surface_check.hpp"
#include "meshing/walls/wall_files.hpp"
#include "tests/meshing/test_geometry.hpp"
#include "tests/meshing/test_mill.hpp"

namespace millfoam::meshing {
namespace {

using Eigen::Vector3d;

WallSurface walls_of(const TestMill& mill) {
  return make_wall_surface(make_cross_section(mill.geometry, mill.cell_size), mill.geometry.length);
}

/// Triangles of an STL file, corners as written.
struct Triangle {
  std::array<std::string, 3> corners;
  std::array<Vector3d, 3> points;
  Vector3d normal;
};

std::vector<Triangle> read_stl(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::vector<Triangle> triangles;
  std::string line;
  std::size_t corner = 0;
  while (std::getline(stream, line)) {
    std::istringstream words(line);
    std::string first, second;
    words >> first;
    if (first == "facet") {
      triangles.emplace_back();
      words >> second >> triangles.back().normal.x() >> triangles.back().normal.y() >>
          triangles.back().normal.z();
      corner = 0;
    } else if (first == "vertex") {
      Vector3d& point = triangles.back().points.at(corner);
      words >> point.x() >> point.y() >> point.z();
      triangles.back().corners.at(corner++) = line;
    }
  }
  return triangles;
}

std::vector<Triangle> read_all(const std::vector<std::filesystem::path>& files) {
  std::vector<Triangle> all;
  for (const auto& file : files) {
    for (const Triangle& triangle : read_stl(file)) all.push_back(triangle);
  }
  return all;
}

TEST(Walls, close_in_the_files_edge_by_edge_with_equal_digits) {
  const TemporaryFolder folder;
  for (const TestMill& mill : all_mills()) {
    std::map<std::pair<std::string, std::string>, int> balance;
    for (const Triangle& t : read_all(write_walls(walls_of(mill), Ends::plain, folder.path()))) {
      for (std::size_t i = 0; i < 3; ++i) {
        const std::string& a = t.corners[i];
        const std::string& b = t.corners[(i + 1) % 3];
        ASSERT_NE(a, b);
        const int count = ++balance[{a, b}];
        ASSERT_EQ(count, 1);
      }
    }
    EXPECT_FALSE(balance.empty());
    for (const auto& [edge, count] : balance) EXPECT_EQ(balance.count({edge.second, edge.first}), 1u);
  }
}

TEST(Walls, enclose_with_outward_normals_the_volume_of_the_flows_mesh) {
  const TemporaryFolder folder;
  for (const TestMill& mill : all_mills()) {
    double volume = 0;
    for (const Triangle& t : read_all(write_walls(walls_of(mill), Ends::plain, folder.path()))) {
      const Vector3d area = (t.points[1] - t.points[0]).cross(t.points[2] - t.points[0]) / 2;
      volume += area.dot(t.points[0]) / 3;
      EXPECT_LT((area.normalized() - t.normal).norm(), 1e-12);
    }
    const CrossSection section = make_cross_section(mill.geometry, mill.cell_size);
    EXPECT_NEAR(volume / quality(make_mill_mesh(section, mill.geometry, 2)).volume, 1, 1e-12);
  }
}

TEST(Walls, of_every_mill_are_watertight_to_cgal) {
  for (const TestMill& mill : all_mills()) EXPECT_NO_THROW(require_watertight(walls_of(mill)));
}

TEST(Walls, have_the_enclosed_volume_that_closed_forms_give) {
  const TestMill mill = test_mill(0.12, 12, 0.008, 0.006, 0.003);
  EXPECT_NEAR(require_watertight(walls_of(mill)), faceted_section(mill.geometry, 8) * mill.geometry.length,
              1e-15);
}

TEST(Walls, have_no_needles) {
  for (const TestMill& mill : ordinary_mills()) {
    const WallSurface surface = walls_of(mill);
    for (const WallPart& part : surface.parts) {
      for (const auto& triangle : part.triangles) {
        for (std::size_t i = 0; i < 3; ++i) {
          const auto at = [&](std::size_t k) {
            return surface.points[static_cast<std::size_t>(triangle[(i + k) % 3])];
          };
          const double cosine = (at(1) - at(0)).normalized().dot((at(2) - at(0)).normalized());
          EXPECT_GT(std::acos(cosine), 5 * std::acos(-1.0) / 180);
        }
      }
    }
  }
}

std::string refusal(const WallSurface& surface) {
  try {
    require_watertight(surface);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "accepted";
}

TEST(RequireWatertight, finds_a_hole_crossing_triangles_and_inward_normals) {
  const WallSurface good = walls_of(ordinary_mills()[3]);
  EXPECT_EQ(refusal(good), "accepted");

  WallSurface hole = good;
  hole.parts[1].triangles.pop_back();
  EXPECT_NE(refusal(hole).find("do not close"), std::string::npos);

  WallSurface inward = good;
  for (auto& part : inward.parts) {
    for (auto& triangle : part.triangles) std::swap(triangle[1], triangle[2]);
  }
  EXPECT_NE(refusal(inward).find("normals do not point out"), std::string::npos);

  WallSurface crossing = good;
  crossing.points[0] = -crossing.points[0];
  EXPECT_NE(refusal(crossing).find("triangles cross"), std::string::npos);
}

TEST(Walls, of_a_periodic_slice_or_a_smooth_drum_leave_no_file_of_an_earlier_mill) {
  const TemporaryFolder folder;
  const auto has = [&](const char* name) { return std::filesystem::exists(folder.path() / name); };
  const WallSurface surface = walls_of(ordinary_mills()[3]);
  EXPECT_EQ(write_walls(surface, Ends::plain, folder.path()).size(), 4u);
  EXPECT_TRUE(has("feedEnd.stl") && has("dischargeEnd.stl") && has("lifters.stl") && has("shell.stl"));
  EXPECT_EQ(write_walls(surface, Ends::periodic, folder.path()).size(), 2u);
  EXPECT_FALSE(has("feedEnd.stl") || has("dischargeEnd.stl"));
  write_walls(walls_of(test_mill(0.12, 0, 0, 0, 0.006)), Ends::plain, folder.path());
  EXPECT_FALSE(has("lifters.stl"));
  EXPECT_TRUE(has("feedEnd.stl"));
}

TEST(WallFiles, of_unknown_origin_are_not_replaced) {
  const TemporaryFolder folder;
  const WallSurface surface = walls_of(ordinary_mills()[3]);
  const auto complaint = [&](Ends ends) {
    try {
      require_known_walls(surface, ends, folder.path());
    } catch (const std::runtime_error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(complaint(Ends::plain), "");
  write_walls(surface, Ends::plain, folder.path());
  std::filesystem::remove(folder.path() / "walls.json");
  EXPECT_EQ(complaint(Ends::plain), "") << "the same surface";
  EXPECT_EQ(complaint(Ends::periodic)
                .find((folder.path() / "feedEnd.stl").string() + ": millMesh has not written this file"),
            0u)
      << "it would be removed";
  folder.write("shell.stl", "solid cad\nendsolid cad\n");
  EXPECT_NE(complaint(Ends::plain).find("shell.stl: millMesh has not written this file"), std::string::npos);
  EXPECT_NE(complaint(Ends::plain).find("--walls"), std::string::npos);
  folder.write("walls.json", "{}");
  EXPECT_EQ(complaint(Ends::plain), "");
}

TEST(WallFiles, that_are_not_those_of_walls_json_are_refused) {
  const TemporaryFolder folder;
  const MillDescription description = describe_mill(folder.write("mill.yaml", example_mill));
  const Mill& mill = description.mill;
  const WallSurface surface =
      make_wall_surface(make_cross_section(mill.geometry, mill.resolution), mill.geometry.length);
  const std::filesystem::path walls = folder.path() / "walls";
  const auto complaint_of = [&](const Mill& one) {
    try {
      require_walls_of(walls, one);
      require_written_walls(walls);
    } catch (const std::runtime_error& error) {
      const std::string message = error.what();
      return message.substr(message.find("walls.json"));
    }
    return std::string();
  };
  const auto complaint = [&] { return complaint_of(mill); };
  EXPECT_EQ(complaint(), "") << "walls without walls.json belong to any mill";
  write_walls(surface, mill.geometry.ends, walls);
  EXPECT_EQ(complaint(),
            "walls.json: the walls are not complete, as after an interrupted millMesh: run millMesh again");
  write_wall_results(description, surface, 1.0, walls);
  EXPECT_EQ(complaint(), "");
  std::filesystem::copy_file(walls / "shell.stl", walls / "lifters.stl",
                             std::filesystem::copy_options::overwrite_existing);
  EXPECT_EQ(complaint(),
            "walls.json: lifters.stl is not the wall that was written with this file: run millMesh again");
  std::filesystem::remove(walls / "lifters.stl");
  EXPECT_NE(complaint(), "");
  const MillDescription other = describe_mill(folder.path() / "mill.yaml", {"geometry.length=0.03"});
  EXPECT_NE(complaint_of(other.mill).find("the walls are of another mill"), std::string::npos);
}

}  // namespace
}  // namespace millfoam::meshing
