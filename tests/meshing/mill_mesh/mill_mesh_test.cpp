// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/mill_mesh/mill_mesh.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <set>
#include <utility>

#include "meshing/mill/mill_shape.hpp"
#include "meshing/mill_mesh/section_blocks.hpp"
#include "meshing/volume/mesh_quality.hpp"
#include "tests/meshing/test_geometry.hpp"

namespace millfoam::meshing {
namespace {

constexpr int layers = 3;

VolumeMesh mesh_of(const TestMill& mill) {
  return make_mill_mesh(make_cross_section(mill.geometry, mill.cell_size), mill.geometry, layers);
}

std::string described(const TestMill& mill) {
  return "diameter " + std::to_string(mill.geometry.diameter) + ", " +
         std::to_string(mill.geometry.lifters.count) + " lifters " +
         std::to_string(mill.geometry.lifters.height) + " x " + std::to_string(mill.geometry.lifters.width) +
         ", cells " + std::to_string(mill.cell_size);
}

double patch_area(const VolumeMesh& mesh, const MeshMeasures& measures, const std::string& name) {
  double area = 0;
  for (const Patch& patch : mesh.patches) {
    if (patch.name != name) continue;
    for (int f = patch.start; f < patch.start + patch.size; ++f) {
      area += measures.face_area[static_cast<std::size_t>(f)].norm();
    }
  }
  return area;
}

TEST(MillMesh, is_good_enough_for_the_flow_in_every_mill) {
  for (const TestMill& mill : all_mills()) {
    SCOPED_TRACE(described(mill));
    EXPECT_NO_THROW(require_quality(quality(mesh_of(mill)), analytic_volume(mill.geometry)));
  }
}

TEST(MillMesh, has_no_slivers_in_ordinary_mills) {
  for (const TestMill& mill : ordinary_mills()) {
    SCOPED_TRACE(described(mill));
    TestMill slice = mill;
    slice.geometry.length = layers * mill.cell_size;
    const MeshQuality q = quality(mesh_of(slice));
    EXPECT_LT(q.largest_edge / q.smallest_edge, 3);
    EXPECT_LT(q.max_non_orthogonality, 30);
  }
}

TEST(LayerEnds, are_equally_apart_without_a_last_layer) {
  EXPECT_EQ(layer_ends(0.305, 1, 0), (std::vector<double>{0, 0.305}));
  EXPECT_EQ(layer_ends(0.3, 3, 0), (std::vector<double>{0, 0.3 / 3, 0.3 * 2 / 3, 0.3}));
}

TEST(LayerEnds, are_apart_as_terms_of_a_geometric_series_that_ends_with_the_last_layer) {
  // 4 + 2 + 1
  const std::vector<double> doubled = layer_ends(0.7, 3, 0.1);
  ASSERT_EQ(doubled.size(), 4);
  EXPECT_EQ(doubled[0], 0);
  EXPECT_NEAR(doubled[1], 0.4, 1e-15);
  EXPECT_NEAR(doubled[2], 0.6, 1e-15);
  EXPECT_EQ(doubled[3], 0.7);
  for (const auto& [count, last] : {std::pair(2, 0.15), {9, 0.01}, {33, 0.002}, {400, 0.0003}}) {
    SCOPED_TRACE(count);
    const std::vector<double> ends = layer_ends(0.305, count, last);
    ASSERT_EQ(ends.size(), static_cast<std::size_t>(count) + 1);
    EXPECT_EQ(ends.front(), 0);
    EXPECT_EQ(ends.back(), 0.305);
    const auto thickness = [&](std::size_t layer) { return ends[layer + 1] - ends[layer]; };
    EXPECT_NEAR(thickness(ends.size() - 2), last, 1e-15);
    const double growth = thickness(0) / thickness(1);
    EXPECT_GT(growth, 1);
    for (std::size_t layer = 0; layer + 2 < ends.size(); ++layer)
      EXPECT_NEAR(thickness(layer) / thickness(layer + 1), growth, 1e-10);
  }
}

TEST(LayerEnds, are_equally_apart_where_the_last_layer_is_as_thick_as_equal_ones) {
  const std::vector<double> ends = layer_ends(0.3, 3, 0.1);
  for (std::size_t end = 0; end < 4; ++end) EXPECT_NEAR(ends[end], 0.1 * static_cast<double>(end), 1e-15);
}

TEST(MillMesh, has_thinner_layers_at_the_discharge_end_but_the_same_volume) {
  const TestMill mill = ordinary_mills()[1];
  const VolumeMesh equal = mesh_of(mill);
  const double last = mill.geometry.length / layers / 2;
  const VolumeMesh graded =
      make_mill_mesh(make_cross_section(mill.geometry, mill.cell_size), mill.geometry, layers, last);
  EXPECT_EQ(graded.faces, equal.faces);
  EXPECT_NEAR(quality(graded).volume / quality(equal).volume, 1, 1e-12);
  const std::vector<double> ends = layer_ends(mill.geometry.length, layers, last);
  const std::size_t section = graded.points.size() / (layers + 1);
  for (std::size_t point = 0; point < graded.points.size(); ++point)
    ASSERT_EQ(graded.points[point].z(), ends[point / section]);
}

TEST(MillMesh, has_closed_cells_of_positive_volume) {
  for (const TestMill& mill : all_mills()) {
    SCOPED_TRACE(described(mill));
    const VolumeMesh mesh = mesh_of(mill);
    const MeshMeasures m = measure(mesh);
    std::vector<Eigen::Vector3d> sum(static_cast<std::size_t>(mesh.cells), Eigen::Vector3d::Zero());
    std::vector<int> faces(static_cast<std::size_t>(mesh.cells), 0);
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
      sum[static_cast<std::size_t>(mesh.owner[f])] += m.face_area[f];
      ++faces[static_cast<std::size_t>(mesh.owner[f])];
      if (f >= mesh.neighbour.size()) continue;
      sum[static_cast<std::size_t>(mesh.neighbour[f])] -= m.face_area[f];
      ++faces[static_cast<std::size_t>(mesh.neighbour[f])];
    }
    for (std::size_t c = 0; c < sum.size(); ++c) {
      EXPECT_LT(sum[c].norm(), 1e-17);
      EXPECT_GT(m.cell_volume[c], 0);
      EXPECT_EQ(faces[c], 6);
    }
  }
}

TEST(MillMesh, has_the_euler_characteristic_of_a_ball) {
  for (const TestMill& mill : all_mills()) {
    SCOPED_TRACE(described(mill));
    const VolumeMesh mesh = mesh_of(mill);
    std::set<std::pair<int, int>> edges;
    for (const Quad& face : mesh.faces) {
      for (std::size_t i = 0; i < 4; ++i) edges.insert(std::minmax(face[i], face[(i + 1) % 4]));
    }
    const auto count = [](const auto& list) { return static_cast<long>(list.size()); };
    EXPECT_EQ(count(mesh.points) - count(edges) + count(mesh.faces) - mesh.cells, 1);
  }
}

TEST(MillMesh, orders_inner_faces_by_owner_then_neighbour_and_patches_after_them) {
  const VolumeMesh mesh = mesh_of(ordinary_mills()[1]);
  for (std::size_t f = 0; f < mesh.neighbour.size(); ++f) {
    ASSERT_LT(mesh.owner[f], mesh.neighbour[f]);
    if (f > 0) {
      ASSERT_LT(std::make_pair(mesh.owner[f - 1], mesh.neighbour[f - 1]),
                std::make_pair(mesh.owner[f], mesh.neighbour[f]));
    }
  }
  int next = static_cast<int>(mesh.neighbour.size());
  std::vector<std::string> names;
  for (const Patch& patch : mesh.patches) {
    EXPECT_EQ(patch.start, next);
    next += patch.size;
    names.push_back(patch.name);
  }
  EXPECT_EQ(next, static_cast<int>(mesh.faces.size()));
  EXPECT_EQ(names, (std::vector<std::string>{"shell", "lifters", "feedEnd", "dischargeEnd"}));
}

TEST(MillMesh, of_a_smooth_drum_has_a_regular_polygons_volume) {
  const TestMill drum = test_mill(0.12, 0, 0, 0, 0.003);
  const VolumeMesh mesh = mesh_of(drum);
  const int sides = mesh.patches[0].size / layers;
  EXPECT_NEAR(quality(mesh).volume,
              sides * 0.06 * 0.06 / 2 * std::sin(2 * std::acos(-1.0) / sides) * drum.geometry.length, 1e-17);
  EXPECT_EQ(mesh.patches[1].name, "lifters");
  EXPECT_EQ(mesh.patches[1].size, 0);
}

TEST(MillMesh, has_the_areas_and_the_volume_of_a_mill_with_a_faceted_shell) {
  for (const TestMill& mill : unusual_mills()) {
    SCOPED_TRACE(described(mill));
    const VolumeMesh mesh = mesh_of(mill);
    const MeshMeasures m = measure(mesh);
    const Geometry& g = mill.geometry;
    const double r = g.radius(), width = g.lifters.width, top = g.lifters.top_width;
    const double side =
        std::hypot(std::sqrt(r * r - width * width / 4) - r + g.lifters.height, (width - top) / 2);
    const int gap = mesh.patches[0].size / layers / g.lifters.count;
    const double facet = (2 * std::acos(-1.0) / g.lifters.count - 2 * std::asin(width / 2 / r)) / gap;
    EXPECT_NEAR(patch_area(mesh, m, "shell"), g.lifters.count * gap * 2 * r * std::sin(facet / 2) * g.length,
                1e-14);
    EXPECT_NEAR(patch_area(mesh, m, "lifters"), g.lifters.count * (2 * side + top) * g.length, 1e-14);
    const double section = faceted_section(g, gap);
    EXPECT_NEAR(patch_area(mesh, m, "feedEnd"), section, 1e-14);
    EXPECT_NEAR(patch_area(mesh, m, "dischargeEnd"), section, 1e-14);
    EXPECT_NEAR(quality(mesh).volume, section * g.length, 1e-15);
  }
}

TEST(MillMesh, centres_lifter_1_on_the_x_axis_and_keeps_out_of_it) {
  const TestMill mill = ordinary_mills()[1];
  bool on_top = false;
  for (const auto& point : mesh_of(mill).points) {
    EXPECT_FALSE(point.x() > 0.052 + 1e-12 && std::abs(point.y()) < 0.003 - 1e-12);
    on_top = on_top || (std::abs(point.x() - 0.052) < 1e-12 && std::abs(point.y()) < 0.0029);
  }
  EXPECT_TRUE(on_top);
}

TEST(MillMesh, of_a_periodic_slice_matches_its_ends_face_by_face) {
  TestMill mill = ordinary_mills()[1];
  mill.geometry.ends = Ends::periodic;
  const VolumeMesh mesh = mesh_of(mill);
  const MeshMeasures m = measure(mesh);
  const Patch& feed = mesh.patches[2];
  const Patch& discharge = mesh.patches[3];
  EXPECT_EQ(feed.neighbour, "dischargeEnd");
  EXPECT_EQ(discharge.neighbour, "feedEnd");
  ASSERT_EQ(feed.size, discharge.size);
  const Eigen::Vector3d length(0, 0, mill.geometry.length);
  for (int i = 0; i < feed.size; ++i) {
    const auto f = static_cast<std::size_t>(feed.start + i);
    const auto d = static_cast<std::size_t>(discharge.start + i);
    EXPECT_LT((m.face_centre[f] + length - m.face_centre[d]).norm(), 1e-15);
    EXPECT_LT((m.face_area[f] + m.face_area[d]).norm(), 1e-17);
    EXPECT_LT(m.face_area[f].z(), 0);
    EXPECT_EQ(mesh.points[static_cast<std::size_t>(mesh.faces[f][0])] + length,
              mesh.points[static_cast<std::size_t>(mesh.faces[d][0])]);
  }
}

TEST(MillMesh, turned_by_a_right_angle_carries_x_to_y) {
  const VolumeMesh mesh = mesh_of(ordinary_mills()[3]);
  const VolumeMesh later = turned(mesh, std::acos(0.0));
  ASSERT_EQ(later.points.size(), mesh.points.size());
  for (std::size_t p = 0; p < mesh.points.size(); ++p) {
    const Eigen::Vector3d& at = mesh.points[p];
    EXPECT_LT((later.points[p] - Eigen::Vector3d(-at.y(), at.x(), at.z())).norm(), 1e-16);
  }
  EXPECT_EQ(later.faces, mesh.faces);
}

}  // namespace
}  // namespace millfoam::meshing
