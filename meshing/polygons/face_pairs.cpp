// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/polygons/face_pairs.hpp"

#include <algorithm>

namespace millfoam::meshing {
namespace {

bool can_be_sides(const PolygonSet& set, const std::vector<int>& same) {
  if (same.size() != 2) return false;
  std::vector<std::vector<int>> points;
  for (int f : same) {
    const Polygon& polygon = set.polygons[index(f)];
    if (set.groups[index(polygon.group)] == internal_group) return false;
    points.push_back(polygon.points);
    std::sort(points.back().begin(), points.back().end());
  }
  return points[0] != points[1];
}

/// How many of a polygon's points the other faces of a cell have too.
int shared_points(const Polygon& polygon, const std::set<int>& of_cell) {
  int shared = 0;
  for (int p : polygon.points) shared += of_cell.count(p) > 0 ? 1 : 0;
  return shared;
}

}  // namespace

FacePairs find_pairs(const WeldedSet& whole, const std::set<int>& refused, Problems& problems) {
  FacePairs pairs;
  std::vector<int> other(whole.faces.size(), -1);
  std::vector<bool> is_second(whole.faces.size(), false);
  for (const std::vector<int>& same : faces_of_equal_points(whole.faces, refused)) {
    if (!can_be_sides(whole.set, same)) {
      for (std::size_t i = 1; i < same.size(); ++i) add_doubled(whole, same[i], same[i - 1], problems);
      continue;
    }
    other[index(same[0])] = same[1];
    is_second[index(same[1])] = true;
  }
  pairs.set.source = whole.set.source;
  pairs.set.groups = whole.set.groups;
  pairs.set.open = whole.set.open;
  pairs.set.files = whole.set.files;
  for (std::size_t f = 0; f < whole.faces.size(); ++f) {
    if (is_second[f]) continue;
    Polygon polygon = whole.set.polygons[f];
    if (polygon.number == 0) polygon.number = static_cast<int>(f) + 1;
    pairs.set.polygons.push_back(std::move(polygon));
    pairs.faces.push_back(whole.faces[f]);
    pairs.one.push_back(static_cast<int>(f));
    pairs.other.push_back(other[f]);
  }
  return pairs;
}

std::vector<PairGroups> groups_of_sides(const PolygonSet& whole, const FacePairs& pairs,
                                        const std::vector<int>& cell_of_side) {
  const int cells = 1 + *std::max_element(cell_of_side.begin(), cell_of_side.end());
  std::vector<std::set<int>> points_of(index(std::max(cells, 0)));  // of cells next to pairs
  std::vector<bool> beside(points_of.size(), false);
  const auto for_each_cell = [&](std::size_t f, const auto& visit) {
    for (std::size_t s : {2 * f + in_front, 2 * f + behind}) {
      if (cell_of_side[s] >= 0) visit(index(cell_of_side[s]));
    }
  };
  for (std::size_t f = 0; f < pairs.faces.size(); ++f) {
    if (pairs.other[f] >= 0) for_each_cell(f, [&](std::size_t cell) { beside[cell] = true; });
  }
  for (std::size_t f = 0; f < pairs.faces.size(); ++f) {
    if (pairs.other[f] >= 0) continue;
    const std::vector<int>& points = pairs.set.polygons[f].points;
    for_each_cell(f, [&](std::size_t cell) {
      if (beside[cell]) points_of[cell].insert(points.begin(), points.end());
    });
  }
  std::vector<PairGroups> groups(pairs.faces.size());
  for (std::size_t f = 0; f < pairs.faces.size(); ++f) {
    const int front = cell_of_side[2 * f + in_front], back = cell_of_side[2 * f + behind];
    if (pairs.other[f] < 0 || front < 0 || back < 0) continue;
    const Polygon& one = whole.polygons[index(pairs.one[f])];
    const Polygon& other = whole.polygons[index(pairs.other[f])];
    const auto& of_front = points_of[index(front)];
    const auto& of_back = points_of[index(back)];
    const int straight = shared_points(one, of_front) + shared_points(other, of_back);
    const int crossed = shared_points(one, of_back) + shared_points(other, of_front);
    groups[f] = {straight > crossed ? one.group : other.group, straight > crossed ? other.group : one.group,
                 straight != crossed || one.group == other.group};
  }
  return groups;
}

}  // namespace millfoam::meshing
