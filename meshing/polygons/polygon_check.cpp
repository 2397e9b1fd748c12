// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/polygons/polygon_check.hpp"

#include <algorithm>
#include <set>

#include "meshing/faces/face_crossings.hpp"
#include "meshing/faces/t_junctions.hpp"
#include "meshing/faces/union_find.hpp"
#include "meshing/files/text_numbers.hpp"

namespace millfoam::meshing {
namespace {

using Eigen::Vector3d;

constexpr std::size_t sentences_of_a_kind = 10;
/// A face has no area below this share of its longest diagonal squared.
constexpr double no_area = 1e-12;

std::string place(const WeldedSet& welded, int face) {
  return place(welded.set, face);
}

std::string around(const WeldedSet& welded, int face) {
  return "around " + described(middle(welded.points, welded.faces[index(face)]));
}

std::string described_edge(const WeldedSet& welded, const surface::FaceSide& edge) {
  return "from " + described(welded.points[index(edge.low)]) + " to " +
         described(welded.points[index(edge.high)]);
}

/// Whether a polygon is a face; if not, the problems say why.
bool check_face(const WeldedSet& welded, int f, Problems& problems) {
  const Polygon& polygon = welded.set.polygons[index(f)];
  const Face& face = welded.faces[index(f)];
  if (polygon.points.size() < 3) {
    problems.add("too few points", place(welded, f) + ": a face of " + std::to_string(polygon.points.size()) +
                                       " points" + (face.empty() ? "" : ' ' + around(welded, f)) +
                                       ": expected three or more");
    return false;
  }
  Face sorted = face;
  std::sort(sorted.begin(), sorted.end());
  const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
  if (twice != sorted.end()) {
    problems.add("repeated point", place(welded, f) + ": the face has the point " +
                                       described(welded.points[index(*twice)]) +
                                       " twice, or two points within the welding tolerance");
    return false;
  }
  double width = 0;
  for (int p : face)
    width = std::max(width, (welded.points[index(p)] - welded.points[index(face[0])]).norm());
  if (area_vector(welded.points, face).norm() <= no_area * width * width) {
    problems.add("no area", place(welded, f) + ": the face " + around(welded, f) + " has no area");
    return false;
  }
  if (crosses_itself(welded.points, face)) {
    problems.add("crossing sides", place(welded, f) + ": sides of the face " + around(welded, f) +
                                       " cross each other: are its points in order?");
    return false;
  }
  return true;
}

/// Edges with one face that are connected by their ends.
std::vector<std::vector<std::size_t>> free_chains(const WeldedSet& welded, const surface::EdgeTable& edges,
                                                  const std::set<std::size_t>& explained) {
  UnionFind points(welded.points.size());
  std::vector<std::size_t> open;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    if (edges.faces(e) > 1 || explained.count(e) > 0) continue;
    open.push_back(e);
    points.join(index(edges.first(e).low), index(edges.first(e).high));
  }
  std::map<std::size_t, std::vector<std::size_t>> chains;
  for (std::size_t e : open) chains[points.find(index(edges.first(e).low))].push_back(e);
  std::vector<std::vector<std::size_t>> list;
  list.reserve(chains.size());
  for (auto& chain : chains) list.push_back(std::move(chain.second));
  return list;
}

/// Whether a chain of free edges goes around a hole: it has no ends and is of several faces. Otherwise it is
/// the rim of a face that hangs free.
bool is_hole(const surface::EdgeTable& edges, const std::vector<std::size_t>& chain) {
  std::map<int, int> edges_at;
  std::set<int> faces;
  for (std::size_t e : chain) {
    ++edges_at[edges.first(e).low];
    ++edges_at[edges.first(e).high];
    faces.insert(edges.first(e).face);
  }
  const bool has_end =
      std::any_of(edges_at.begin(), edges_at.end(), [](const auto& entry) { return entry.second == 1; });
  return !has_end && faces.size() > 1;
}

void add_chain(const WeldedSet& welded, const surface::EdgeTable& edges,
               const std::vector<std::size_t>& chain, Problems& problems) {
  const bool hole = is_hole(edges, chain);
  const surface::FaceSide& first = edges.first(chain.front());
  Vector3d centre = Vector3d::Zero();
  for (std::size_t e : chain) {
    centre += welded.points[index(edges.first(e).low)] + welded.points[index(edges.first(e).high)];
  }
  centre /= 2 * static_cast<double>(chain.size());
  const std::string rim = "the edge " + described_edge(welded, first) + " has no other face, one of " +
                          std::to_string(chain.size()) + " such edges around " + described(centre);
  problems.add(hole ? "hole" : "dangling face",
               place(welded, first.face) + ": " +
                   (hole ? "a hole: " : "a dangling face, or a neighbouring face is missing: ") + rim);
}

/// T-junctions into the problems; returns the edges with one face that they explain.
std::set<std::size_t> add_t_junctions(const WeldedSet& welded, const surface::EdgeTable& edges,
                                      Problems& problems) {
  std::set<std::size_t> explained;
  std::set<int> on_edges;
  for (const TJunction& junction : find_t_junctions(welded.points, edges)) {
    const surface::FaceSide& edge = edges.first(junction.edge);
    problems.add("T-junction", place(welded, edge.face) + ": a T-junction: the edge " +
                                   described_edge(welded, edge) + " has the point " +
                                   described(welded.points[index(junction.point)]) +
                                   " on it, which this face must have too");
    explained.insert(junction.edge);
    on_edges.insert(junction.point);
  }
  for (std::size_t e = 0; e < edges.size() && !on_edges.empty(); ++e) {
    if (on_edges.count(edges.first(e).low) + on_edges.count(edges.first(e).high) > 0) explained.insert(e);
  }
  return explained;
}

}  // namespace

void Problems::add(const std::string& kind, const std::string& sentence) {
  if (count_[kind]++ == 0) kinds_.push_back(kind);
  if (count_[kind] <= sentences_of_a_kind) sentences_of_[kind].push_back(sentence);
}

std::vector<std::string> Problems::sentences() const {
  std::vector<std::string> all;
  for (const std::string& kind : kinds_) {
    const auto& some = sentences_of_.at(kind);
    all.insert(all.end(), some.begin(), some.end());
    if (count_.at(kind) > some.size())
      all.push_back("and " + std::to_string(count_.at(kind) - some.size()) + " more: " + kind);
  }
  return all;
}

void Problems::stop() const {
  std::string text;
  for (const std::string& sentence : sentences()) text += (text.empty() ? "" : "\n") + sentence;
  if (!text.empty()) throw PolygonError(text);
}

void check_groups(const PolygonSet& set, Problems& problems) {
  for (std::size_t group = 0; group < set.groups.size(); ++group) {
    const std::string& name = set.groups[group];
    const auto is_letter = [](char c) {
      return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
    };
    const auto may_follow = [&](char c) {
      return is_letter(c) || (c >= '0' && c <= '9') || c == '.' || c == '-';
    };
    if (!name.empty() && is_letter(name.front()) && std::all_of(name.begin(), name.end(), may_follow))
      continue;
    const auto first = std::find_if(set.polygons.begin(), set.polygons.end(), [&](const Polygon& polygon) {
      return polygon.group == static_cast<int>(group);
    });
    problems.add("group name",
                 (first == set.polygons.end() ? set.source
                                              : place(set, static_cast<int>(first - set.polygons.begin()))) +
                     ": the group '" + name +
                     "' cannot name a patch of OpenFOAM: expected a letter or '_', then letters, "
                     "digits, '_', '-' or '.'");
  }
}

std::set<int> check_faces(const WeldedSet& welded, Problems& problems) {
  std::set<int> refused;
  for (int f = 0; f < static_cast<int>(welded.faces.size()); ++f) {
    if (!check_face(welded, f, problems)) refused.insert(f);
  }
  return refused;
}

void add_doubled(const WeldedSet& welded, int face, int other, Problems& problems) {
  problems.add("doubled face", place(welded, face) + ": a doubled face: the same points as " +
                                   place(welded, other) + ", " + around(welded, face));
}

void check_doubled(const WeldedSet& welded, Problems& problems) {
  for (const std::vector<int>& same : faces_of_equal_points(welded.faces, {})) {
    for (std::size_t i = 1; i < same.size(); ++i) add_doubled(welded, same[i], same[i - 1], problems);
  }
}

std::vector<std::vector<int>> faces_of_equal_points(const std::vector<Face>& faces,
                                                    const std::set<int>& passed_over) {
  std::vector<std::pair<Face, int>> sorted;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (passed_over.count(static_cast<int>(f)) > 0) continue;
    sorted.emplace_back(faces[f], static_cast<int>(f));
    std::sort(sorted.back().first.begin(), sorted.back().first.end());
  }
  std::sort(sorted.begin(), sorted.end());
  std::vector<std::vector<int>> groups;
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    if (sorted[i].first != sorted[i - 1].first) continue;
    if (groups.empty() || groups.back().back() != sorted[i - 1].second)
      groups.push_back({sorted[i - 1].second});
    groups.back().push_back(sorted[i].second);
  }
  return groups;
}

void check_closed(const WeldedSet& welded, const surface::EdgeTable& edges, Problems& problems) {
  const std::set<std::size_t> explained = add_t_junctions(welded, edges, problems);
  for (const auto& chain : free_chains(welded, edges, explained)) add_chain(welded, edges, chain, problems);
}

void check_crossings(const WeldedSet& welded, const surface::EdgeTable& edges,
                     const std::vector<Overlap>& overlaps, Problems& problems) {
  for (const Overlap& overlap : overlaps) {
    problems.add("overlapping faces", place(welded, overlap.faces[0]) + ": the face overlaps with " +
                                          place(welded, overlap.faces[1]) + " at the edge " +
                                          described_edge(welded, edges.first(overlap.edge)));
  }
  for (const Crossing& crossing : find_crossings(welded.points, welded.faces)) {
    problems.add("crossing faces", place(welded, crossing.faces[0]) + ": the face crosses or touches " +
                                       place(welded, crossing.faces[1]) + " near " +
                                       described(crossing.where));
  }
}

void check_dangling(const WeldedSet& welded, const std::vector<int>& cell_of_side, Problems& problems) {
  for (std::size_t f = 0; f < welded.faces.size(); ++f) {
    if (cell_of_side[2 * f + in_front] != cell_of_side[2 * f + behind]) continue;
    const int face = static_cast<int>(f);
    problems.add("dangling face", place(welded, face) + ": a dangling face: both sides of the face " +
                                      around(welded, face) + " are " +
                                      (cell_of_side[2 * f] < 0 ? "outside" : "in the same cell"));
  }
}

void check_manifold(const WeldedSet& welded, const surface::EdgeTable& edges,
                    const std::vector<int>& cell_of_side, Problems& problems) {
  for (std::size_t e = 0; e < edges.size(); ++e) {
    if (edges.faces(e) < 3) continue;
    std::vector<int> cells;
    for (const auto& space : spaces_about(welded.points, welded.faces, edges, e))
      cells.push_back(cell_of_side[space[0]]);
    std::sort(cells.begin(), cells.end());
    const auto twice = std::adjacent_find(cells.begin(), cells.end());
    if (twice == cells.end()) continue;
    problems.add("non-manifold edge", place(welded, edges.first(e).face) + ": a non-manifold edge " +
                                          described_edge(welded, edges.first(e)) + ": around it " +
                                          (*twice < 0 ? "the outside" : "the same cell") +
                                          " appears more than once, because " +
                                          std::to_string(edges.faces(e)) + " faces meet there");
  }
}

void check_internal(const WeldedSet& welded, const std::vector<int>& cell_of_side, Problems& problems) {
  for (std::size_t f = 0; f < welded.faces.size(); ++f) {
    const std::string& group = welded.set.groups[index(welded.set.polygons[f].group)];
    const bool at_boundary = cell_of_side[2 * f + in_front] < 0 || cell_of_side[2 * f + behind] < 0;
    if (group != internal_group || !at_boundary) continue;
    const int face = static_cast<int>(f);
    problems.add("internal face at the boundary",
                 place(welded, face) + ": the face " + around(welded, face) +
                     " of the group 'internal' has a cell on one side only: a neighbouring face is missing");
  }
}

void warn_of_rare_boundary(const WeldedSet& welded, const std::vector<int>& cell_of_side,
                           Problems& warnings) {
  const auto at_boundary = [&](std::size_t f) {
    return cell_of_side[2 * f + in_front] < 0 || cell_of_side[2 * f + behind] < 0;
  };
  std::vector<std::size_t> boundary(welded.set.groups.size(), 0), inner(welded.set.groups.size(), 0);
  for (std::size_t f = 0; f < welded.faces.size(); ++f)
    ++(at_boundary(f) ? boundary : inner)[index(welded.set.polygons[f].group)];
  const auto groups_with_boundary =
      std::count_if(boundary.begin(), boundary.end(), [](std::size_t faces) { return faces > 0; });
  for (std::size_t f = 0; f < welded.faces.size() && groups_with_boundary > 1; ++f) {
    const std::size_t group = index(welded.set.polygons[f].group);
    if (!at_boundary(f) || boundary[group] >= inner[group]) continue;
    const int face = static_cast<int>(f);
    warnings.add("faces of such groups at the boundary",
                 place(welded, face) + ": the face " + around(welded, face) + " of the group '" +
                     welded.set.groups[group] + "' is at the boundary, and " + std::to_string(inner[group]) +
                     " of that group lie between two cells: is a face of the outer wall missing?");
  }
}

void warn_of_shared_faces(const WeldedSet& welded, const std::vector<int>& cell_of_side, Problems& warnings) {
  std::map<std::pair<int, int>, std::vector<int>> between;
  for (std::size_t f = 0; f < welded.faces.size(); ++f) {
    const auto cells = std::minmax(cell_of_side[2 * f + in_front], cell_of_side[2 * f + behind]);
    if (cells.first >= 0) between[cells].push_back(static_cast<int>(f));
  }
  for (const auto& entry : between) {
    const std::vector<int>& faces = entry.second;
    if (faces.size() < 2) continue;
    warnings.add("two cells with several faces between them",
                 place(welded, faces[1]) + ": the face " + around(welded, faces[1]) +
                     " lies between the same two cells as " + place(welded, faces[0]) + ", one of " +
                     std::to_string(faces.size()) + " such faces: is a face between them missing?");
  }
}

void warn_of_merged_cells(const WeldedSet& welded, const std::vector<int>& cell_of_side, Problems& warnings) {
  std::map<int, std::vector<int>> faces_of;
  for (std::size_t side = 0; side < cell_of_side.size(); ++side) {
    if (cell_of_side[side] >= 0) faces_of[cell_of_side[side]].push_back(static_cast<int>(side / 2));
  }
  std::map<std::size_t, std::size_t> cells_with;
  for (const auto& entry : faces_of) ++cells_with[entry.second.size()];
  const auto usual = std::max_element(cells_with.begin(), cells_with.end(),
                                      [](const auto& a, const auto& b) { return a.second < b.second; });
  if (usual == cells_with.end() || 100 * usual->second < 99 * faces_of.size()) return;
  for (const auto& entry : faces_of) {
    const std::vector<int>& faces = entry.second;
    if (faces.size() <= usual->first) continue;
    warnings.add("cells with more faces than the others",
                 place(welded, faces[0]) + ": the cell behind the face " + around(welded, faces[0]) +
                     " has " + std::to_string(faces.size()) + " faces, and nearly all others have " +
                     std::to_string(usual->first) + ": is one between two cells missing?");
  }
}

}  // namespace millfoam::meshing
