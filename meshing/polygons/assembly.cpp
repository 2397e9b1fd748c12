// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/polygons/assembly.hpp"

#include <algorithm>
#include <cmath>
#include <queue>
#include <tuple>

#include "meshing/faces/union_find.hpp"
#include "meshing/files/text_numbers.hpp"
#include "meshing/polygons/face_pairs.hpp"
#include "meshing/polygons/polygon_check.hpp"
#include "meshing/surface/welding.hpp"
#include "meshing/volume/baffles.hpp"

namespace millfoam::meshing {
namespace {

constexpr double default_tolerance = 1e-9;  // of the bounding box's diagonal

/// Corners of cells on the two sides of a baffle get points of their own.
void separate(const FacePairs& pairs, Assembly& assembly) {
  for (int other : pairs.other) assembly.baffles += other >= 0 ? 1 : 0;
  if (assembly.baffles == 0) return;
  const std::size_t before = assembly.mesh.points.size();
  separate_points_at_baffles(assembly.mesh);
  assembly.points_separated = static_cast<int>(assembly.mesh.points.size() - before);
}

WeldedSet welded_set(const PolygonSet& set, double tolerance, Assembly& assembly) {
  const surface::Welding welding =
      surface::weld(set.points, tolerance > 0 ? tolerance : default_tolerance * surface::extent(set.points));
  assembly.points_joined = static_cast<int>(welding.joined());
  WeldedSet welded{set, welding.points, {}};
  for (const Polygon& polygon : set.polygons) {
    Face face;
    for (int p : polygon.points) face.push_back(welding.kept[index(p)]);
    welded.faces.push_back(std::move(face));
  }
  return welded;
}

/// The cell on each side of each face.
struct Sides {
  std::vector<int> cell;
  std::vector<int> open_cell;  ///< the same, but no cell behind a baffle: what cells are joined through
  std::vector<double> volume;  ///< of each cell, m^3
};

Sides find_sides(const WeldedSet& welded, const surface::EdgeTable& edges, Problems& problems) {
  const Shells shells = find_shells(welded.points, welded.faces, edges);
  check_crossings(welded, edges, shells.overlaps, problems);
  problems.stop();
  const ShellCells cells = find_cells(welded.points, welded.faces, shells);
  Sides sides{{}, {}, cells.volume};
  if (!cells.flat.empty()) {
    check_dangling(welded, shells.of_side, problems);
    for (int shell : cells.flat) {
      const auto side = std::find(shells.of_side.begin(), shells.of_side.end(), shell);
      const int face = static_cast<int>(side - shells.of_side.begin()) / 2;
      problems.add("flat shell", place(welded.set, face) + ": the faces connected to this one, around " +
                                     described(middle(welded.points, welded.faces[index(face)])) +
                                     ", enclose no volume");
    }
    problems.stop();
  }
  for (int shell : shells.of_side) sides.cell.push_back(cells.of_shell[index(shell)]);
  return sides;
}

/// Pairs of faces must have a cell on both sides.
void check_pairs(const WeldedSet& whole, const FacePairs& pairs, const std::vector<PairGroups>& groups,
                 Sides& sides, Problems& problems) {
  sides.open_cell = sides.cell;
  for (std::size_t f = 0; f < pairs.faces.size(); ++f) {
    if (pairs.other[f] < 0) continue;
    const int front = sides.cell[2 * f + in_front], back = sides.cell[2 * f + behind];
    if (front < 0 || back < 0 || front == back || !groups[f].known)
      add_doubled(whole, pairs.other[f], pairs.one[f], problems);
    sides.open_cell[2 * f + behind] = -1;
  }
}

/// The cells' numbers in the order in which neighbours reach each other from the first cell of each body, so
/// that neighbours have near numbers for any order of the polygons. Counts the bodies.
std::vector<int> numbers_by_neighbourhood(const Sides& sides, int& bodies) {
  std::vector<std::vector<int>> neighbours(sides.volume.size());
  for (std::size_t s = 0; s < sides.open_cell.size(); s += 2) {
    const int a = sides.open_cell[s], b = sides.open_cell[s + 1];
    if (a < 0 || b < 0) continue;
    neighbours[index(a)].push_back(b);
    neighbours[index(b)].push_back(a);
  }
  std::vector<int> number(neighbours.size(), -1);
  int next = 0;
  for (std::size_t first = 0; first < number.size(); ++first) {
    if (number[first] >= 0) continue;
    ++bodies;
    std::queue<int> reached({static_cast<int>(first)});
    number[first] = next++;
    for (; !reached.empty(); reached.pop()) {
      for (int cell : neighbours[index(reached.front())]) {
        if (number[index(cell)] >= 0) continue;
        number[index(cell)] = next++;
        reached.push(cell);
      }
    }
  }
  return number;
}

/// One face on its way into the mesh, oriented out of its owner.
struct Placed {
  int group;  ///< -1 between two cells
  int owner;
  int neighbour;  ///< -1 at the boundary
  int polygon;
  bool reversed;
};

std::vector<Placed> placed_faces(const WeldedSet& welded, const Sides& sides, const FacePairs& pairs,
                                 const std::vector<PairGroups>& groups, const std::vector<int>& number) {
  std::vector<Placed> faces;
  for (std::size_t f = 0; f < welded.faces.size(); ++f) {
    const auto numbered = [&](int cell) { return cell < 0 ? -1 : number[index(cell)]; };
    const int front = numbered(sides.cell[2 * f + in_front]), back = numbered(sides.cell[2 * f + behind]);
    if (pairs.other[f] >= 0) {
      faces.push_back({groups[f].behind, back, -1, static_cast<int>(f), false});
      faces.push_back({groups[f].in_front, front, -1, static_cast<int>(f), true});
      continue;
    }
    const bool inner = front >= 0 && back >= 0;
    const bool reversed = inner ? front < back : back < 0;
    faces.push_back({inner ? -1 : welded.set.polygons[f].group, reversed ? front : back,
                     reversed ? back : front, static_cast<int>(f), reversed});
  }
  std::sort(faces.begin(), faces.end(), [](const Placed& a, const Placed& b) {
    return std::tie(a.group, a.owner, a.neighbour, a.polygon) <
           std::tie(b.group, b.owner, b.neighbour, b.polygon);
  });
  return faces;
}

/// Points that faces use, in their order; the faces take their new numbers.
void keep_used_points(const Points& points, Assembly& assembly) {
  std::vector<int> number(points.size(), -1);
  for (const Face& face : assembly.mesh.faces) {
    for (int p : face) number[index(p)] = 0;
  }
  for (std::size_t p = 0; p < points.size(); ++p) {
    if (number[p] < 0) continue;
    number[p] = static_cast<int>(assembly.mesh.points.size());
    assembly.mesh.points.push_back(points[p]);
  }
  for (Face& face : assembly.mesh.faces) {
    for (int& p : face) p = number[index(p)];
  }
  assembly.points_unused = static_cast<int>(points.size() - assembly.mesh.points.size());
}

void build_mesh(const WeldedSet& welded, const std::vector<Placed>& faces, Assembly& assembly) {
  PolyMesh& mesh = assembly.mesh;
  for (const std::string& name : welded.set.groups) assembly.patches.push_back({name, 0, 0, 0});
  for (const Placed& placed : faces) {
    Face face = welded.faces[index(placed.polygon)];
    if (placed.reversed) std::reverse(face.begin() + 1, face.end());
    const int group = placed.group >= 0 ? placed.group : welded.set.polygons[index(placed.polygon)].group;
    PatchMeasure& measure = assembly.patches[index(group)];
    mesh.owner.push_back(placed.owner);
    if (placed.neighbour >= 0) {
      mesh.neighbour.push_back(placed.neighbour);
      ++measure.between_cells;
    } else {
      if (measure.faces++ == 0)
        mesh.patches.push_back({measure.name, static_cast<int>(mesh.faces.size()), 0, "",
                                welded.set.open.count(measure.name) > 0});
      ++mesh.patches.back().size;
      measure.area += area_vector(welded.points, face).norm();
    }
    mesh.faces.push_back(std::move(face));
  }
  keep_used_points(welded.points, assembly);
}

}  // namespace

Assembly assemble(const PolygonSet& set, double tolerance) {
  Assembly assembly;
  Problems problems;
  const WeldedSet whole = welded_set(set, tolerance, assembly);
  check_groups(set, problems);
  const FacePairs pairs = find_pairs(whole, check_faces(whole, problems), problems);
  problems.stop();
  const WeldedSet welded{pairs.set, whole.points, pairs.faces};
  const surface::EdgeTable edges = surface::find_edges(welded.faces);
  check_closed(welded, edges, problems);
  problems.stop();
  Sides sides = find_sides(welded, edges, problems);
  const std::vector<PairGroups> groups = groups_of_sides(set, pairs, sides.cell);
  check_pairs(whole, pairs, groups, sides, problems);
  check_dangling(welded, sides.cell, problems);
  problems.stop();
  check_manifold(welded, edges, sides.cell, problems);
  check_internal(welded, sides.cell, problems);
  problems.stop();
  Problems warnings;
  warn_of_rare_boundary(welded, sides.open_cell, warnings);
  warn_of_shared_faces(welded, sides.open_cell, warnings);
  warn_of_merged_cells(welded, sides.open_cell, warnings);
  assembly.warnings = warnings.sentences();

  const std::vector<int> number = numbers_by_neighbourhood(sides, assembly.bodies);
  build_mesh(welded, placed_faces(welded, sides, pairs, groups, number), assembly);
  assembly.mesh.cells = static_cast<int>(sides.volume.size());
  separate(pairs, assembly);
  for (double volume : sides.volume) assembly.volume += volume;
  const auto [smallest, largest] = std::minmax_element(sides.volume.begin(), sides.volume.end());
  assembly.smallest_cell = *smallest;
  assembly.largest_cell = *largest;
  return assembly;
}

}  // namespace millfoam::meshing
