// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/volume/mesh_quality.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>

namespace millfoam::meshing {
namespace {

/// Two cells from x = -1 to 0 to 1 with unit square sections, whose points are shifted by y = shift(x).
VolumeMesh two_cells(const std::function<double(double)>& shift) {
  VolumeMesh mesh;
  for (int i = 0; i < 3; ++i) {
    const double x = i - 1;
    for (const auto& [y, z] : {std::pair{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}}) {
      mesh.points.emplace_back(x, y + shift(x), z);
    }
  }
  const auto across = [](int i) { return Quad{4 * i, 4 * i + 1, 4 * i + 2, 4 * i + 3}; };
  mesh.faces.push_back(across(1));
  mesh.owner.push_back(0);
  mesh.neighbour.push_back(1);
  mesh.faces.push_back({0, 3, 2, 1});
  mesh.owner.push_back(0);
  mesh.faces.push_back(across(2));
  mesh.owner.push_back(1);
  for (int cell = 0; cell < 2; ++cell) {
    for (int side = 0; side < 4; ++side) {
      const int a = 4 * cell + side, b = 4 * cell + (side + 1) % 4;
      mesh.faces.push_back({a, b, b + 4, a + 4});
      mesh.owner.push_back(cell);
    }
  }
  mesh.cells = 2;
  return mesh;
}

TEST(MeshQuality, of_two_cubes_is_perfect) {
  const MeshQuality q = quality(two_cells([](double) { return 0.0; }));
  EXPECT_NEAR(q.volume, 2, 1e-15);
  EXPECT_NEAR(q.smallest_cell, 1, 1e-15);
  EXPECT_NEAR(q.max_non_orthogonality, 0, 1e-6);
  EXPECT_NEAR(q.max_skewness, 0, 1e-15);
  EXPECT_NEAR(q.smallest_edge, 1, 1e-15);
}

TEST(MeshQuality, of_sheared_cells_has_the_shear_angle_and_its_tangent) {
  const double angle = 0.4;
  const MeshQuality q = quality(two_cells([&](double x) { return x * std::tan(angle); }));
  EXPECT_NEAR(q.volume, 2, 1e-14);
  EXPECT_NEAR(q.max_non_orthogonality, angle * 180 / std::acos(-1.0), 1e-10);
  EXPECT_NEAR(q.max_skewness, std::tan(angle), 1e-14);  // of the end faces
  EXPECT_NEAR(q.largest_edge, 1 / std::cos(angle), 1e-14);
}

TEST(MeshQuality, counts_how_far_the_centres_line_misses_an_inner_face) {
  // A chevron: centres at y = s/2, the face's at 0, half its width 0.5, and at the boundary s/2 over 0.5 too.
  const double s = 0.3;
  const MeshQuality q = quality(two_cells([&](double x) { return s * std::abs(x); }));
  EXPECT_NEAR(q.max_non_orthogonality, 0, 1e-6);
  EXPECT_NEAR(q.max_skewness, s, 1e-14);
}

TEST(MeshQuality, compares_the_volumes_of_neighbours) {
  VolumeMesh mesh = two_cells([](double) { return 0.0; });
  for (Eigen::Vector3d& point : mesh.points) {
    if (point.x() > 0.5) point.x() = 2.5;
  }
  EXPECT_NEAR(quality(mesh).max_volume_ratio, 2.5, 1e-14);
}

TEST(ChamberVolume, leaves_out_what_is_behind_the_mills_length) {
  VolumeMesh mesh = two_cells([](double) { return 0.0; });
  for (auto& point : mesh.points)
    point = {point.y(), point.z(), 2 * point.x()};  // along z, from -2 to 0 to 2
  EXPECT_NEAR(chamber_volume(mesh, 0), 2, 1e-15);
  EXPECT_NEAR(chamber_volume(mesh, 1.5), 4, 1e-15);
}

TEST(MeshQuality, says_where_the_worst_is) {
  VolumeMesh mesh = two_cells([](double x) { return x > 0 ? 0.4 * x : 0; });
  for (Eigen::Vector3d& point : mesh.points) {
    if (point.x() > 0.5) point.x() = 2.5;
    point += Eigen::Vector3d(1, 2, 3);
  }
  const MeshQuality q = quality(mesh);
  const Eigen::Vector3d between(1, 2, 3);
  EXPECT_LT((q.max_volume_ratio_at - between).norm(), 1e-14);
  EXPECT_LT((q.max_non_orthogonality_at - between).norm(), 1e-14);
  EXPECT_LT((q.max_skewness_at - Eigen::Vector3d(3.5, 2.4, 3)).norm(), 1e-14);
  EXPECT_LT((q.smallest_cell_at - Eigen::Vector3d(0.5, 2, 3)).norm(), 1e-14);
}

std::string refusal(const MeshQuality& quality, double volume, double length = 100) {
  try {
    require_quality(quality, volume, length);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "accepted";
}

TEST(RequireQuality, names_what_is_above_its_limit) {
  MeshQuality q = quality(two_cells([](double) { return 0.0; }));
  EXPECT_EQ(refusal(q, 2), "accepted");
  EXPECT_NE(refusal(q, 2.02).find("relative error in volume of 0.00990099, above the allowed 0.005"),
            std::string::npos);
  q.max_volume_ratio = 3.5;
  q.max_volume_ratio_at = {1, 0.5, 3};
  EXPECT_EQ(
      refusal(q, 2),
      "the mesh has a largest volume ratio of neighbouring cells of 3.5, above the allowed 3, at (1 0.5 3) "
      "m: "
      "choose another resolution, lifters that are less high or less wide, or openings whose circles are "
      "further from each other and from the lifters");
  EXPECT_NE(refusal(q, 2, 3).find("at (1 0.5 3) m: choose another pulp_lifters.layers or pulp_lifters.depth"),
            std::string::npos);
  q.max_skewness = 1.6;
  q.max_skewness_at = {0, 0, 1};
  EXPECT_NE(refusal(q, 2).find("largest skewness of 1.6, above the allowed 1, at (0 0 1) m"),
            std::string::npos);
  q.max_non_orthogonality = 51;
  q.max_non_orthogonality_at = {0, 2, 0};
  EXPECT_NE(refusal(q, 2).find(
                "largest non-orthogonality of 51 degrees, above the allowed 45 degrees, at (0 2 0) m"),
            std::string::npos);
  q.smallest_cell = -1;
  q.smallest_cell_at = {3, 0, 0};
  EXPECT_NE(refusal(q, 2).find("a cell turned inside out, of -1 m^3, at (3 0 0) m"), std::string::npos);
}

}  // namespace
}  // namespace millfoam::meshing
