// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/mill_mesh/openings.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <map>
#include <set>
#include <sstream>

#include "meshing/mill/mill_shape.hpp"
#include "meshing/mill/opening_circles.hpp"
#include "meshing/mill_mesh/mill_mesh.hpp"
#include "meshing/mill_mesh/section_blocks.hpp"
#include "meshing/surface/pi.hpp"
#include "meshing/volume/mesh_quality.hpp"
#include "tests/meshing/test_geometry.hpp"
#include "tests/meshing/test_mill.hpp"

namespace millfoam::meshing {
namespace {

constexpr int mill_layers = 4;

/// Settings of the READMEs' tables, and the numbers of quadrilaterals that the source publishes.
struct Published {
  Geometry geometry;
  BlockCounts counts;
  int quads;
  int layers;
};

std::vector<Published> published() {
  const Geometry small = {0.12, 0.12, Ends::plain, {12, 0.008, 0.006, 0.006}};
  const Geometry large = {0.3, 0.305, Ends::plain, {20, 0.01, 0.01, 0.01}};
  return {{small, {11, 3, 5, 9}, 3948, 12},
          {small, {24, 6, 8, 19}, 17328, 12},
          {large, {5, 1, 1, 5}, 1616, 9},
          {mill_with_grates(), {3, 1, 2, 14}, 1616, 9},
          {shipped_mill(2), {3, 1, 2, 14}, 1616, 9},
          {shipped_mill(3), {3, 1, 2, 14}, 1616, 33},
          {shipped_mill(3), {3, 1, 2, 17, true}, 1616, 33}};
}

CrossSection section_of(const Published& mill) {
  return make_cross_section(mill.geometry, Resolution{0, 1, mill.counts});
}

const Patch& patch(const VolumeMesh& mesh, const std::string& name) {
  for (const Patch& patch : mesh.patches) {
    if (patch.name == name) return patch;
  }
  throw std::logic_error("no patch " + name);
}

/// Sum of a patch's area vectors, m^2.
Eigen::Vector3d area_of(const VolumeMesh& mesh, const std::string& name) {
  const MeshMeasures m = measure(mesh);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  const Patch& p = patch(mesh, name);
  for (int f = p.start; f < p.start + p.size; ++f) sum += m.face_area[static_cast<std::size_t>(f)];
  return sum;
}

TEST(CrossSection, by_counts_has_the_published_numbers_within_three_percent) {
  for (const Published& mill : published()) {
    const double quads = static_cast<double>(section_of(mill).quads.size());
    EXPECT_NEAR(quads / mill.quads, 1, 0.03) << quads;
  }
}

TEST(CrossSection, at_published_resolutions_has_the_quality_that_the_flow_needs) {
  for (const Published& mill : published()) {
    for (const double top : {1.0, 0.6}) {
      Published trapezoid = mill;
      trapezoid.geometry.lifters.top_width = top * mill.geometry.lifters.width;
      const VolumeMesh mesh = make_mill_mesh(section_of(trapezoid), trapezoid.geometry, mill.layers);
      EXPECT_NO_THROW(require_quality(quality(mesh), flow_volume(trapezoid.geometry)));
    }
  }
}

TEST(PulpLifters, of_three_layers_behind_nine_are_refused_with_their_keys) {
  const Geometry mill = shipped_mill(3);
  const Resolution resolution{0, 9, BlockCounts{3, 1, 2, 14}};
  const VolumeMesh mesh = make_mill_mesh(make_cross_section(mill, resolution), mill, 9);
  try {
    require_quality(quality(mesh), flow_volume(mill), mill.length);
    FAIL();
  } catch (const std::runtime_error& error) {
    const std::string message = error.what();
    EXPECT_NE(
        message.find("a largest volume ratio of neighbouring cells of 3.08081, above the allowed 3, at ("),
        std::string::npos)
        << message;
    EXPECT_NE(message.find(" 0.305) m: choose another pulp_lifters.layers or pulp_lifters.depth"),
              std::string::npos)
        << message;
    EXPECT_NE(message.find("(layers, last_layer)"), std::string::npos) << message;
  }
}

double smallest_cell(const CrossSection& section) {
  Geometry smooth = {0.3, 1, Ends::plain, {20, 0.01, 0.01, 0.01}};
  return quality(make_mill_mesh(section, smooth, 1)).smallest_cell;
}

TEST(CrossSection, with_halved_columns_has_larger_cells_at_the_axis_and_the_same_openings) {
  const Geometry mill = shipped_mill(3);
  const CrossSection whole = make_cross_section(mill, Resolution{0, 9, BlockCounts{3, 1, 2, 14}});
  const CrossSection halved = make_cross_section(mill, Resolution{0, 9, BlockCounts{3, 1, 2, 14, true}});
  EXPECT_EQ(halved.around(), whole.around());
  EXPECT_EQ(whole.divisions.core, 20);
  EXPECT_EQ(halved.divisions.core, 10);
  EXPECT_GT(smallest_cell(halved), 1.9 * smallest_cell(whole));
  const Openings a = find_openings(whole, mill), b = find_openings(halved, mill);
  EXPECT_NEAR(b.inlet_area / a.inlet_area, 1, 1e-12);
  EXPECT_NEAR(b.grate_area / a.grate_area, 1, 1e-12);
  EXPECT_NEAR(b.outlet_area / a.outlet_area, 1, 1e-12);
  for (std::size_t q = 0; q < halved.quads.size(); ++q) {
    EXPECT_TRUE(halved.columns[q] >= 0 || b.inlet[q]);
  }
}

TEST(CrossSection, with_halved_columns_is_good_enough_with_and_without_lifters_and_in_a_slice) {
  Geometry drum = mill_with_grates();
  drum.grates.reset();
  drum.lifters.count = 0;
  Geometry slice = shipped_mill(3);
  slice.circles_of_whole = opening_circles(slice);
  slice.ends = Ends::periodic;
  slice.inlet.reset();
  slice.grates.reset();
  slice.pulp_lifters.reset();
  const std::vector<std::pair<Geometry, BlockCounts>> mills = {{drum, {40, 0, 0, 6, true}},
                                                               {drum, {80, 0, 0, 14, true}},
                                                               {slice, {3, 1, 2, 14, true}},
                                                               {mill_with_grates(), {3, 1, 2, 14, true}}};
  for (const auto& [mill, counts] : mills) {
    const CrossSection section = make_cross_section(mill, Resolution{0, mill_layers, counts});
    EXPECT_EQ(section.divisions.core, section.around() / 8);
    const VolumeMesh mesh = make_mill_mesh(section, mill, mill_layers);
    EXPECT_NO_THROW(require_quality(quality(mesh), flow_volume(mill), mill.length));
  }
}

/// cases/mills/mill_30cm/mill.yaml with one line more.
Mill shipped_mill_with(const std::string& line) {
  std::ostringstream text;
  text << std::ifstream(std::filesystem::path(TEST_DATA_DIR).parent_path() /
                        "../../cases/mills/mill_30cm/mill.yaml")
              .rdbuf();
  const TemporaryFolder folder;
  return read_mill(folder.write("mill.yaml", with(text.str(), "  ends: plain\n", "  ends: plain\n" + line)));
}

TEST(ShippedMill, is_the_one_of_these_tests_and_good_enough) {
  const Mill mill = shipped_mill_with("");
  EXPECT_EQ(opening_circles(mill.geometry), opening_circles(shipped_mill(3)));
  const VolumeMesh mesh = make_mill_mesh(make_cross_section(mill.geometry, mill.resolution), mill.geometry,
                                         mill.resolution.layers);
  EXPECT_NO_THROW(require_quality(quality(mesh), flow_volume(mill.geometry), mill.geometry.length));
}

TEST(ShippedMill, has_slices_with_the_whole_mills_cross_section) {
  const Mill whole = shipped_mill_with(""), slice = shipped_mill_with("  slice: 0.0165\n");
  EXPECT_FALSE(slice.geometry.inlet || slice.geometry.grates || slice.geometry.pulp_lifters);
  const CrossSection section = make_cross_section(slice.geometry, slice.resolution);
  EXPECT_EQ(section.points, make_cross_section(whole.geometry, whole.resolution).points);
  const VolumeMesh mesh = make_mill_mesh(section, slice.geometry, slice.resolution.layers);
  EXPECT_NO_THROW(require_quality(quality(mesh), flow_volume(slice.geometry), slice.geometry.length));
  EXPECT_EQ(mesh.patches.size(), 4u);
  EXPECT_TRUE(mesh.cell_zones.empty() && mesh.face_zones.empty());
}

TEST(CrossSection, comes_closer_to_the_mills_area_with_every_refinement) {
  for (const double top : {0.01, 0.006}) {
    Geometry mill = mill_with_grates();
    mill.lifters.top_width = top;
    double error = 1;
    for (const double cell_size : {0.012, 0.008, 0.004, 0.002}) {
      mill.length = 1;
      const double finer = 1 - quality(make_mill_mesh(make_cross_section(mill, cell_size), mill, 1)).volume /
                                   analytic_volume(mill);
      EXPECT_GT(finer, 0);
      EXPECT_LT(finer, error);
      error = finer;
    }
    EXPECT_LT(error, 1e-4);
  }
}

TEST(CrossSection, shares_the_ring_out_to_bands_that_are_not_thinner_than_half_their_cells) {
  const CrossSection section = section_of(published()[3]);
  EXPECT_EQ(section.divisions.bands.size(), 4u);
  int ring = 0;
  for (int band : section.divisions.bands) ring += band;
  EXPECT_EQ(ring, 14);
}

TEST(Inlet, has_the_area_of_its_circle_wherever_the_grates_are) {
  for (const double cell_size : {0.012, 0.007}) {
    const Geometry mill = mill_with_grates();
    const CrossSection section = make_cross_section(mill, cell_size);
    const VolumeMesh mesh = make_mill_mesh(section, mill, mill_layers);
    EXPECT_NEAR(area_of(mesh, "inlet").z(), -0.01287, 1e-15);
    EXPECT_NEAR(find_openings(section, mill).inlet_area, 0.01287, 1e-15);
    EXPECT_NEAR(area_of(mesh, "feedEnd").z() - 0.01287, -quality(mesh).volume / mill.length, 1e-13);
  }
}

TEST(Openings, have_the_smallest_face_of_inlet_and_outlet) {
  for (Geometry mill : {mill_with_grates(), mill_with_pulp_lifters(), shipped_mill(3)}) {
    const CrossSection section = make_cross_section(mill, 0.009);
    const VolumeMesh mesh = make_mill_mesh(section, mill, mill_layers);
    const MeshMeasures m = measure(mesh);
    double smallest = std::numeric_limits<double>::infinity();
    for (const Patch& p : mesh.patches) {
      if (p.name != "inlet" && p.name != "outlet") continue;
      for (int f = p.start; f < p.start + p.size; ++f) {
        smallest = std::min(smallest, m.face_area[static_cast<std::size_t>(f)].norm());
      }
    }
    EXPECT_NEAR(find_openings(section, mill).smallest_quad / smallest, 1, 1e-9);
    mill.inlet.reset();
    mill.pulp_lifters.reset();
    EXPECT_EQ(find_openings(section, mill).smallest_quad, 0);
  }
}

TEST(Inlet, too_small_for_a_circle_is_made_of_whole_cells_about_the_axis) {
  Geometry mill = mill_with_grates();
  mill.grates.reset();
  mill.inlet->radius = 0.02;
  const CrossSection section = make_cross_section(mill, 0.003);
  const Openings openings = find_openings(section, mill);
  EXPECT_TRUE(opening_circles(mill).empty());
  EXPECT_NEAR(openings.inlet_area / asked_inlet_area(mill), 1, 0.05);
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (std::size_t q = 0; q < openings.inlet.size(); ++q) {
    if (!openings.inlet[q]) continue;
    EXPECT_EQ(section.columns[q], -1);
    for (int p : section.quads[q]) middle += section.points[static_cast<std::size_t>(p)];
  }
  EXPECT_LT(middle.norm(), 1e-12);
}

TEST(Inlet, whose_whole_cells_have_another_area_is_refused_with_the_areas) {
  Geometry mill = mill_with_grates();
  mill.grates.reset();
  mill.inlet->radius = 0.005;
  try {
    find_openings(make_cross_section(mill, 0.012), mill);
    FAIL();
  } catch (const KeyError& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.find("key 'geometry.inlet' = 0.785398 cm^2: expected an inlet of which whole cells"),
              0u)
        << message;
    EXPECT_NE(message.find(" have the area to 5 %; the nearest have "), std::string::npos) << message;
    EXPECT_NE(message.find("one of a radius of 0.035 m or more"), std::string::npos) << message;
  }
}

TEST(Circles, that_nearly_coincide_become_one) {
  Geometry mill = mill_with_pulp_lifters();
  EXPECT_EQ(opening_circles(mill), (std::vector<double>{0.064, 0.09, 0.13}));  // the inlet's is 0.064005
  const CrossSection section = make_cross_section(mill, 0.009);
  EXPECT_NEAR(find_openings(section, mill).inlet_area / asked_inlet_area(mill), 1, 0.01);
  EXPECT_NEAR(find_openings(section, mill).outlet_area, pi * 0.064 * 0.064, 1e-15);
}

TEST(Grates, that_are_whole_rings_have_the_rings_area) {
  const Geometry mill = mill_with_grates(1);
  const VolumeMesh mesh = make_mill_mesh(make_cross_section(mill, 0.009), mill, mill_layers);
  EXPECT_NEAR(area_of(mesh, "grates").z(), pi * (0.13 * 0.13 - 0.09 * 0.09), 1e-15);
}

TEST(Grates, stay_within_half_a_column_of_the_area_asked_for) {
  for (const double share : {0.3, 0.5, 0.77, 0.95}) {
    const Geometry mill = mill_with_grates(share);
    const CrossSection section = make_cross_section(mill, 0.009);
    const double ring = pi * (0.13 * 0.13 - 0.09 * 0.09);
    EXPECT_NEAR(find_openings(section, mill).grate_area, asked_grate_area(mill),
                0.5001 * ring / section.around());
  }
}

TEST(Grates, without_pulp_lifters_are_an_open_patch_and_no_zone) {
  const Geometry mill = mill_with_grates();
  const VolumeMesh mesh = make_mill_mesh(make_cross_section(mill, 0.012), mill, mill_layers);
  EXPECT_TRUE(patch(mesh, "grates").open);
  EXPECT_TRUE(mesh.cell_zones.empty() && mesh.face_zones.empty());
}

TEST(Grates, with_pulp_lifters_have_a_zone_of_their_faces) {
  const Geometry mill = mill_with_pulp_lifters();
  const CrossSection section = make_cross_section(mill, 0.012);
  const VolumeMesh mesh = make_mill_mesh(section, mill, mill_layers);
  const MeshMeasures m = measure(mesh);
  ASSERT_EQ(mesh.face_zones.size(), 1u);
  EXPECT_EQ(mesh.face_zones[0].name, "grates");
  const auto grates = find_openings(section, mill).grates;
  EXPECT_EQ(static_cast<std::ptrdiff_t>(mesh.face_zones[0].members.size()),
            std::count(grates.begin(), grates.end(), true));
  for (const int face : mesh.face_zones[0].members) {
    const auto at = [&](int cell) { return m.cell_centre[static_cast<std::size_t>(cell)].z(); };
    EXPECT_LT(at(mesh.owner[static_cast<std::size_t>(face)]), mill.length);
    EXPECT_GT(at(mesh.neighbour[static_cast<std::size_t>(face)]), mill.length);
  }
}

TEST(PulpLifters, have_a_zone_of_all_cells_behind_the_discharge_end) {
  const Geometry mill = mill_with_pulp_lifters();
  const VolumeMesh mesh = make_mill_mesh(make_cross_section(mill, 0.012), mill, mill_layers);
  const MeshMeasures m = measure(mesh);
  std::vector<int> behind;
  for (int cell = 0; cell < mesh.cells; ++cell)
    if (m.cell_centre[static_cast<std::size_t>(cell)].z() > mill.length) behind.push_back(cell);
  ASSERT_EQ(mesh.cell_zones.size(), 1u);
  EXPECT_EQ(mesh.cell_zones[0].name, "pulpLifters");
  EXPECT_EQ(mesh.cell_zones[0].members, behind);
}

TEST(Grates, with_more_sectors_than_columns_are_refused) {
  Geometry mill = mill_with_grates();
  mill.grates->sectors = 100;
  try {
    find_openings(make_cross_section(mill, 0.012), mill);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("key 'geometry.grates.sectors' = 100: expected fewer sectors"),
              std::string::npos)
        << error.what();
  }
}

/// Numbers the parts of a mesh that faces join, those of `closed` left out; returns each cell's.
std::vector<int> connected_parts(const VolumeMesh& mesh, const std::set<int>& closed) {
  std::vector<int> part(static_cast<std::size_t>(mesh.cells));
  for (std::size_t c = 0; c < part.size(); ++c) part[c] = static_cast<int>(c);
  const auto root = [&](int c) {
    while (part[static_cast<std::size_t>(c)] != c) c = part[static_cast<std::size_t>(c)];
    return c;
  };
  for (std::size_t f = 0; f < mesh.neighbour.size(); ++f) {
    if (closed.count(static_cast<int>(f)) != 0) continue;
    const int a = root(mesh.owner[f]), b = root(mesh.neighbour[f]);
    part[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
  }
  for (std::size_t c = 0; c < part.size(); ++c) part[c] = root(static_cast<int>(c));
  return part;
}

TEST(PulpLifters, are_joined_with_the_mill_through_the_grates_alone) {
  const Geometry mill = mill_with_pulp_lifters();
  const VolumeMesh mesh = make_mill_mesh(make_cross_section(mill, 0.012), mill, mill_layers);
  const auto parts = connected_parts(mesh, {});
  EXPECT_EQ(std::set<int>(parts.begin(), parts.end()).size(), 1u);
  ASSERT_EQ(mesh.face_zones.size(), 1u);
  const auto& grates = mesh.face_zones[0].members;
  const auto behind = connected_parts(mesh, {grates.begin(), grates.end()});
  EXPECT_EQ(std::set<int>(behind.begin(), behind.end()).size(), 2u);
  const MeshMeasures m = measure(mesh);
  for (std::size_t c = 0; c < behind.size(); ++c) {
    EXPECT_EQ(behind[c] == behind.front(), m.cell_centre[c].z() < mill.length);
  }
  double area = 0;
  for (int f : grates) area += m.face_area[static_cast<std::size_t>(f)].z();
  EXPECT_NEAR(area, asked_grate_area(mill), 0.01 * asked_grate_area(mill));
}

TEST(PulpLifters, are_as_many_as_sectors_each_with_a_grate_when_the_discharge_is_closed) {
  const Geometry mill = mill_with_pulp_lifters();
  const VolumeMesh mesh = make_mill_mesh(make_cross_section(mill, 0.012), mill, mill_layers);
  const MeshMeasures m = measure(mesh);
  std::set<int> closed(mesh.face_zones[0].members.begin(), mesh.face_zones[0].members.end());
  for (std::size_t f = 0; f < mesh.neighbour.size(); ++f) {
    const Eigen::Vector3d& owner = m.cell_centre[static_cast<std::size_t>(mesh.owner[f])];
    const Eigen::Vector3d& neighbour = m.cell_centre[static_cast<std::size_t>(mesh.neighbour[f])];
    const double radius = mill.pulp_lifters->discharge_radius;
    if ((owner.head<2>().norm() < radius) != (neighbour.head<2>().norm() < radius)) {
      closed.insert(static_cast<int>(f));
    }
  }
  const auto parts = connected_parts(mesh, closed);
  std::map<int, int> grates;  // of each compartment: faces of its grate
  for (int f : mesh.face_zones[0].members) {
    ++grates[parts[static_cast<std::size_t>(mesh.neighbour[static_cast<std::size_t>(f)])]];
  }
  EXPECT_EQ(grates.size(), 12u);
}

TEST(PulpLifters, have_walls_of_two_sides_that_share_no_points) {
  const Geometry mill = mill_with_pulp_lifters();
  const VolumeMesh mesh = make_mill_mesh(make_cross_section(mill, 0.012), mill, mill_layers);
  std::set<std::set<int>> faces;
  for (const Quad& face : mesh.faces) EXPECT_TRUE(faces.insert({face.begin(), face.end()}).second);
  const double section = quality(mesh).volume / 0.335;
  EXPECT_NEAR(area_of(mesh, "dischargeEnd").norm(), 0, 1e-15);  // its two sides
  EXPECT_NEAR(area_of(mesh, "outlet").z(), pi * 0.064 * 0.064, 1e-15);
  EXPECT_NEAR(area_of(mesh, "pulpLifters").z(), section - pi * 0.064 * 0.064, 1e-13);
  EXPECT_NEAR(area_of(mesh, "pulpLifters").head<2>().norm(), 0, 1e-15);
  std::vector<std::string> names;
  for (const Patch& patch : mesh.patches) names.push_back(patch.name);
  EXPECT_EQ(names, (std::vector<std::string>{"shell", "lifters", "feedEnd", "dischargeEnd", "inlet", "outlet",
                                             "pulpLifters"}));
}

TEST(PulpLifters, leave_cells_with_three_neighbours_at_least) {
  for (const double cell_size : {0.006, 0.009, 0.012}) {
    const Geometry mill = mill_with_pulp_lifters();
    const VolumeMesh mesh = make_mill_mesh(make_cross_section(mill, cell_size), mill, mill_layers);
    std::vector<int> neighbours(static_cast<std::size_t>(mesh.cells), 0);
    for (std::size_t f = 0; f < mesh.neighbour.size(); ++f) {
      ++neighbours[static_cast<std::size_t>(mesh.owner[f])];
      ++neighbours[static_cast<std::size_t>(mesh.neighbour[f])];
    }
    EXPECT_GE(*std::min_element(neighbours.begin(), neighbours.end()), 3);
  }
}

}  // namespace
}  // namespace millfoam::meshing
