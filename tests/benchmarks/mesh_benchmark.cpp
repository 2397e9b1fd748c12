// SPDX-License-Identifier: GPL-3.0-or-later
// Finding points in meshes and depositing balls in their cells, each compared with another method. The
// meshes are drums of hexahedra that have turned; the argument n makes about 10 n^3 cells: 5, 11, 22 and 46
// give 10^3, 10^4, 10^5 and 10^6. One item is a point or a ball; times are the thread's own.
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <random>
#include <vector>

#include "averaging/deposition/exact_mesh_deposition.hpp"
#include "averaging/deposition/sampled_mesh_deposition.hpp"
#include "averaging/mesh/cell_locator.hpp"
#include "averaging/mesh/cell_tree.hpp"
#include "tests/averaging/mesh_support.hpp"

namespace millfoam::averaging {
namespace {

using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

constexpr double radius = 0.06, length = 0.024;

TestMesh mill(int n) {
  return drum_mesh(radius, length, n, n, 2 * n);
}

/// The mill after a small change, in which faces are warped.
MeshPoints deformed(const TestMesh& mesh, int n) {
  return warped(mesh, 0.02 * length / n, 3).points;
}

int size_of(const benchmark::State& state) {
  return static_cast<int>(state.range(0));
}

/// 10^6 points anywhere in the drum.
Points random_points() {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> part(-1, 1);
  Points points;
  while (points.size() < 1000000) {
    const Vector3d point(radius * part(random), radius * part(random), length / 2 * (1 + part(random)));
    if (point.head<2>().norm() < 0.98 * radius) points.push_back(point);
  }
  return points;
}

/// Random points in the order of Morton's curve, along which neighbours are near in space.
Points coherent_points() {
  Points points = random_points();
  const auto place = [](const Vector3d& point) {
    std::uint64_t code = 0;
    for (int bit = 0; bit < 10; ++bit) {
      for (int axis = 0; axis < 3; ++axis) {
        const auto along = static_cast<std::uint64_t>((point[axis] + radius) / (2 * radius) * 1023);
        code |= ((along >> bit) & 1U) << (3 * bit + axis);
      }
    }
    return code;
  };
  std::sort(points.begin(), points.end(),
            [&](const Vector3d& a, const Vector3d& b) { return place(a) < place(b); });
  return points;
}

/// Finds each point with the cell of the last as hint, after carrying it into the frame of the turned mesh.
template <typename Locate>
std::size_t find_all(const Points& points, Locate&& locate) {
  Eigen::Isometry3d into_mesh = Eigen::Isometry3d::Identity();
  into_mesh.rotate(Eigen::AngleAxisd(0.7, Vector3d::UnitZ()));
  std::size_t found = 0;
  int hint = -1;
  for (const Vector3d& point : points) {
    const int cell = locate(into_mesh * point, hint);
    if (cell < 0) continue;
    hint = cell;
    ++found;
  }
  return found;
}

void count(benchmark::State& state, std::size_t items, std::size_t cells) {
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(items));
  state.counters["cells"] = static_cast<double>(cells);
}

void locate_with(benchmark::State& state, const Points& points) {
  const TestMesh mesh = mill(size_of(state));
  const CellLocator locator(std::make_shared<const MeshGeometry>(mesh.topology, mesh.points));
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        find_all(points, [&](const Vector3d& point, int hint) { return locator.locate(point, hint); }));
  }
  count(state, points.size(), mesh.topology.cells);
}

void rigid_coherent_points(benchmark::State& state) {
  locate_with(state, coherent_points());
}
void rigid_random_points(benchmark::State& state) {
  locate_with(state, random_points());
}
BENCHMARK(rigid_coherent_points)->Arg(5)->Arg(11)->Arg(22)->Arg(46)->Unit(benchmark::kMillisecond);
BENCHMARK(rigid_random_points)->Arg(5)->Arg(11)->Arg(22)->Arg(46)->Unit(benchmark::kMillisecond);

/// The plain way: all cells, by their boxes and planes.
void baseline_every_cell(benchmark::State& state) {
  const TestMesh mesh = mill(size_of(state));
  const MeshGeometry geometry(mesh.topology, mesh.points);
  const CellContainment containment(geometry);
  Points points = coherent_points();
  points.resize(1000);
  const auto locate = [&](const Vector3d& point, int) {
    for (int cell = 0; cell < static_cast<int>(geometry.cells()); ++cell) {
      if (!geometry.boxes()[static_cast<std::size_t>(cell)].contains(point)) continue;
      if (containment.test(cell, containment.local(point)) == CellContainment::Answer::inside) return cell;
    }
    return -1;
  };
  for (auto _ : state) benchmark::DoNotOptimize(find_all(points, locate));
  count(state, points.size(), mesh.topology.cells);
}
BENCHMARK(baseline_every_cell)->Arg(5)->Arg(11)->Arg(22)->Unit(benchmark::kMillisecond);

/// A record of a deforming mesh: new points, geometry, tree, 10^6 points.
void deforming_record(benchmark::State& state, const Points& points) {
  const TestMesh mesh = mill(size_of(state));
  const std::array<MeshPoints, 2> places{mesh.points, deformed(mesh, size_of(state))};
  MeshGeometry geometry(mesh.topology, mesh.points);
  CellTree tree(geometry);
  std::size_t record = 0;
  for (auto _ : state) {
    geometry.move(places[++record % 2]);
    tree.update();
    benchmark::DoNotOptimize(
        find_all(points, [&](const Vector3d& point, int hint) { return tree.locate(point, hint); }));
  }
  count(state, points.size(), mesh.topology.cells);
}
void deforming_coherent_points(benchmark::State& state) {
  deforming_record(state, coherent_points());
}
void deforming_random_points(benchmark::State& state) {
  deforming_record(state, random_points());
}
BENCHMARK(deforming_coherent_points)->Arg(5)->Arg(11)->Arg(17)->Arg(46)->Unit(benchmark::kMillisecond);
BENCHMARK(deforming_random_points)->Arg(5)->Arg(11)->Arg(17)->Arg(46)->Unit(benchmark::kMillisecond);

using Kernel = CGAL::Simple_cartesian<double>;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using CgalTree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

/// The facets' triangles in CGAL's tree: the facet that a ray meets first gives the cell by the side that the
/// ray comes from.
struct CgalLocator {
  Triangles triangles;
  std::vector<const Facet*> facets;
  CgalTree tree;

  explicit CgalLocator(const MeshGeometry& geometry) {
    const auto corner = [&](const Facet& facet, int i) {
      const Vector3d& p =
          geometry.points()[static_cast<std::size_t>(facet.corners[static_cast<std::size_t>(i)])];
      return Kernel::Point_3(p.x(), p.y(), p.z());
    };
    for (const Facet& facet : geometry.facets()) {
      for (int i = 2; i < facet.corner_count; ++i) {
        triangles.emplace_back(corner(facet, 0), corner(facet, i - 1), corner(facet, i));
        facets.push_back(&facet);
      }
    }
    tree.insert(triangles.cbegin(), triangles.cend());
    tree.build();
  }

  int locate(const Vector3d& point) const {
    const Kernel::Ray_3 ray(Kernel::Point_3(point.x(), point.y(), point.z()), Kernel::Vector_3(0.1, 0.2, 1));
    const auto hit = tree.first_intersected_primitive(ray);
    if (!hit) return -1;
    const Facet& facet = *facets[static_cast<std::size_t>(*hit - triangles.cbegin())];
    return facet.normal.dot(point) < facet.offset ? facet.owner : facet.neighbour;
  }
};

void baseline_cgal_deforming(benchmark::State& state) {
  const TestMesh mesh = mill(size_of(state));
  const MeshGeometry geometry(mesh.topology, deformed(mesh, size_of(state)));
  Points points = coherent_points();
  points.resize(50000);
  const CgalLocator locator(geometry);
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        find_all(points, [&](const Vector3d& point, int) { return locator.locate(point); }));
  }
  count(state, points.size(), mesh.topology.cells);
}
BENCHMARK(baseline_cgal_deforming)->Arg(5)->Arg(11)->Arg(17)->Unit(benchmark::kMillisecond);

void build_tree(benchmark::State& state) {
  const TestMesh mesh = mill(size_of(state));
  const MeshGeometry geometry(mesh.topology, deformed(mesh, size_of(state)));
  for (auto _ : state) benchmark::DoNotOptimize(CellTree(geometry).builds());
}
void baseline_cgal_build_tree(benchmark::State& state) {
  const TestMesh mesh = mill(size_of(state));
  const MeshGeometry geometry(mesh.topology, deformed(mesh, size_of(state)));
  for (auto _ : state) benchmark::DoNotOptimize(CgalLocator(geometry).tree.size());
}
BENCHMARK(build_tree)->Arg(17)->Unit(benchmark::kMillisecond);
BENCHMARK(baseline_cgal_build_tree)->Arg(17)->Unit(benchmark::kMillisecond);

/// Balls in a turned mesh of about 2600 cells; the argument is 100 d/dx.
template <typename Method>
void deposit(benchmark::State& state, double warp) {
  const int n = 12;
  const TestMesh mesh = warped(drum_mesh(radius, length, n, n / 2, 6), warp * length / 6);
  Method deposition(std::make_unique<RigidMesh>(prepare(mesh.topology, mesh.points),
                                                parse_motion({"rotation speed 3"}), 0.0));
  deposition.begin_record(0.37);
  const double cell = std::cbrt(pi * radius * radius * length / static_cast<double>(mesh.topology.cells));
  const double of_ball = static_cast<double>(state.range(0)) / 200 * cell;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> part(-1, 1);
  std::vector<Particle> balls;
  while (balls.size() < 2000) {
    const Vector3 centre{radius * part(random), radius * part(random),
                         length / 2 + (length / 2 - of_ball) * part(random)};
    if (std::hypot(centre[0], centre[1]) < 0.95 * radius - of_ball) balls.push_back({1, centre, {}, of_ball});
  }
  std::vector<Deposit> deposits;
  double met = 0;
  for (auto _ : state) {
    met = 0;
    for (const Particle& ball : balls) {
      deposition.deposit(ball, deposits);
      met += static_cast<double>(deposits.size());
    }
  }
  count(state, balls.size(), mesh.topology.cells);
  state.counters["cells_per_ball"] = met / static_cast<double>(balls.size());
}
void exact_flat_cells(benchmark::State& state) {
  deposit<ExactMeshDeposition>(state, 0);
}
void exact_warped_cells(benchmark::State& state) {
  deposit<ExactMeshDeposition>(state, 0.05);
}
void sampling_flat_cells(benchmark::State& state) {
  deposit<SampledMeshDeposition>(state, 0);
}
BENCHMARK(exact_flat_cells)->Arg(25)->Arg(50)->Arg(100)->Arg(200)->Arg(400)->Unit(benchmark::kMillisecond);
BENCHMARK(exact_warped_cells)->Arg(25)->Arg(50)->Arg(100)->Arg(200)->Unit(benchmark::kMillisecond);
BENCHMARK(sampling_flat_cells)->Arg(50)->Arg(100)->Arg(200)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace millfoam::averaging
