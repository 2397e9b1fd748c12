// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/walls/cad_surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "meshing/faces/face_crossings.hpp"
#include "meshing/files/text_numbers.hpp"
#include "meshing/polygons/polygon_check.hpp"
#include "meshing/polygons/stl_polygons.hpp"
#include "meshing/surface/mill_size.hpp"
#include "meshing/surface/welding.hpp"
#include "meshing/walls/surface_bodies.hpp"
#include "meshing/walls/surface_check.hpp"

namespace millfoam::meshing {
namespace {

using Eigen::Vector3d;

constexpr std::array<const char*, 4> wall_parts{"shell", "lifters", "feedEnd", "dischargeEnd"};
constexpr double default_tolerance = 1e-6;  // of the bounding box's diagonal; STL's floats have 7 digits
constexpr double widest_tolerance = 1e-3;   // of the diagonal: corners so near may be meant to be apart
constexpr double smallest_mill = 0.01;      // m
constexpr double off_frame = 0.01;          // of the bounding box's width or length
constexpr double no_area = 1e-9;            // height over longest side

template <typename... Parts>
std::string sentence(const Parts&... parts) {
  std::ostringstream text;
  text.precision(6);
  (text << ... << parts);
  return text.str();
}

/// A number of things, as in `1 corner` or `2 corners`.
std::string counted(std::size_t number, const std::string& thing, const std::string& things) {
  return std::to_string(number) + ' ' + (number == 1 ? thing : things);
}

PolygonSet read_parts(const std::vector<PartFile>& parts, double scale, Ends ends) {
  if (!(scale > 0 && std::isfinite(scale)))
    throw std::runtime_error(sentence("scale ", scale, ": expected a factor above 0"));
  PolygonSet set;
  for (const PartFile& part : parts) {
    if (std::find(wall_parts.begin(), wall_parts.end(), part.part) == wall_parts.end())
      throw std::runtime_error("part '" + part.part + "': expected shell, lifters, feedEnd or dischargeEnd");
    if (std::find(set.groups.begin(), set.groups.end(), part.part) != set.groups.end())
      throw std::runtime_error("part '" + part.part + "' is given twice");
    if (ends == Ends::periodic && (part.part == "feedEnd" || part.part == "dischargeEnd"))
      throw std::runtime_error("part '" + part.part +
                               "': a slice with periodic ends has shell and lifters only");
    add_stl(part.file, part.part, scale, set);
    set.files.push_back(part.file.string());
  }
  return set;
}

void check_frame(const PolygonSet& set, CadReport& report) {
  report.low = report.high = set.points.front();
  for (const Vector3d& point : set.points) {
    report.low = report.low.cwiseMin(point);
    report.high = report.high.cwiseMax(point);
  }
  const Vector3d size = report.high - report.low, centre = (report.high + report.low) / 2;
  const double largest = size.maxCoeff();
  if (largest > surface::largest_mill) {
    report.problems.push_back(sentence("the bounding box is ", largest, " m long, above ",
                                       surface::largest_mill,
                                       " m: is this in millimetres? Then give --scale 0.001"));
  } else if (largest < smallest_mill) {
    report.warnings.push_back(
        sentence("the bounding box is only ", largest, " m long: is its unit the metre?"));
  }
  const double off_axis = centre.head<2>().norm();
  if (off_axis > off_frame * std::max(size.x(), size.y()))
    report.warnings.push_back(sentence("the bounding box's middle is x = ", centre.x(), ", y = ", centre.y(),
                                       " m: expected the mill's axis at x = y = 0"));
  if (std::abs(report.low.z()) > off_frame * size.z())
    report.warnings.push_back(
        sentence("the bounding box begins at z = ", report.low.z(), " m: expected the feed end at z = 0"));
}

/// The welded triangles; those with two equal corners are left out.
struct Welded {
  PolygonSet set;  ///< polygons that are kept
  Points points;
  std::vector<Face> faces;
};

Welded weld_corners(const PolygonSet& set, double nearest, CadReport& report) {
  const surface::Welding welding = surface::weld(set.points, nearest);
  if (welding.moved > 0)
    report.repairs.push_back(sentence(
        counted(static_cast<std::size_t>(welding.moved), "corner", "corners"), " nearer than ", nearest,
        " m to another ", welding.moved == 1 ? "was" : "were", " joined to it, the farthest over ",
        welding.largest_distance, " m at ", described(welding.farthest)));
  Welded welded{set, welding.points, {}};
  welded.set.polygons.clear();
  std::size_t dropped = 0;
  std::string first;
  for (std::size_t t = 0; t < set.polygons.size(); ++t) {
    Face face;
    for (int p : set.polygons[t].points) face.push_back(welding.kept[index(p)]);
    if (face[0] == face[1] || face[1] == face[2] || face[2] == face[0]) {
      if (dropped++ == 0)
        first = place(set, static_cast<int>(t)) + " at " + described(welding.points[index(face[0])]);
      continue;
    }
    welded.faces.push_back(std::move(face));
    welded.set.polygons.push_back(set.polygons[t]);
  }
  if (dropped > 0)
    report.repairs.push_back(sentence(counted(dropped, "triangle", "triangles"), " with two equal corners ",
                                      dropped == 1 ? "was" : "were", " left out, the first ", first));
  return welded;
}

void check_edges(const WeldedSet& welded, const surface::EdgeTable& edges, Problems& problems) {
  check_doubled(welded, problems);
  check_closed(welded, edges, problems);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    if (edges.faces(e) <= 2) continue;
    const surface::FaceSide& edge = edges.first(e);
    problems.add(
        "edge with more than two triangles",
        sentence(place(welded.set, edge.face), ": the edge from ", described(welded.points[index(edge.low)]),
                 " to ", described(welded.points[index(edge.high)]), " has ", edges.faces(e),
                 " triangles: expected two"));
  }
}

/// A face over each closed rim at the two ends of a periodic slice: where all edges with one triangle that
/// lie in the plane of an end, to `tolerance`, meet in pairs.
std::vector<Face> rim_covers(const Welded& welded, const CadReport& report, double tolerance) {
  const surface::EdgeTable edges = surface::find_edges(welded.faces);
  std::vector<Face> covers;
  for (const double level : {report.low.z(), report.high.z()}) {
    const auto in_plane = [&](int p) { return std::abs(welded.points[index(p)].z() - level) <= tolerance; };
    std::map<int, std::vector<int>> next;
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const surface::FaceSide& edge = edges.first(e);
      if (edges.faces(e) != 1 || !in_plane(edge.low) || !in_plane(edge.high)) continue;
      next[edge.low].push_back(edge.high);
      next[edge.high].push_back(edge.low);
    }
    while (!next.empty()) {
      Face cover;
      bool closed = true;
      for (int from = -1, at = next.begin()->first; next.count(at) > 0;) {
        const std::vector<int> ways = next.at(at);
        closed = closed && ways.size() == 2;
        cover.push_back(at);
        next.erase(at);
        const int to = ways.front() == from ? ways.back() : ways.front();
        from = std::exchange(at, to);
      }
      if (closed && cover.size() > 2) covers.push_back(std::move(cover));
    }
  }
  return covers;
}

void check_areas(const WeldedSet& welded, Problems& problems) {
  for (std::size_t t = 0; t < welded.faces.size(); ++t) {
    const auto at = [&](std::size_t i) { return welded.points[index(welded.faces[t][i])]; };
    if (flatness(at(0), at(1), at(2)) >= no_area) continue;
    problems.add("triangle without area",
                 sentence(place(welded.set, static_cast<int>(t)), ": the triangle around ",
                          described(middle(welded.points, welded.faces[t])), " has no area"));
  }
}

/// Bodies are cut at edges with more than two triangles, so that their number there means nothing.
bool has_branching_edge(const surface::EdgeTable& edges) {
  for (std::size_t e = 0; e < edges.size(); ++e) {
    if (edges.faces(e) > 2) return true;
  }
  return false;
}

/// The place of a triangle, for messages.
std::string at(const Welded& welded, int face) {
  return sentence(place(welded.set, face), ", around ",
                  described(middle(welded.points, welded.faces[index(face)])));
}

/// The bodies of the triangles; `edges` are theirs and the covers'. Triangles that face against their
/// neighbours are turned.
Bodies orient_triangles(Welded& welded, const std::vector<Face>& covers, const surface::EdgeTable& edges) {
  std::vector<Face> faces = welded.faces;
  faces.insert(faces.end(), covers.begin(), covers.end());
  Bodies found = find_bodies(welded.points, edges, faces);
  const auto is_cover = [&](int face) { return index(face) >= welded.faces.size(); };
  const auto drop_covers = [&](std::vector<int>& list) {
    list.erase(std::remove_if(list.begin(), list.end(), is_cover), list.end());
  };
  drop_covers(found.against_neighbours);
  for (Body& body : found.bodies) drop_covers(body.faces);
  faces.resize(welded.faces.size());
  welded.faces = std::move(faces);
  return found;
}

/// Turns closed bodies that face the wrong way, and adds up the volume. Returns how many were turned.
int turn_bodies(Welded& welded, const std::vector<Body>& bodies, Problems& problems, CadReport& report) {
  int turned = 0;
  for (const Body& body : bodies) {
    if (!body.two_sided)
      problems.add("one side only", sentence("the surface that contains ", at(welded, body.faces.front()),
                                             ", is one-sided: its triangles cannot all face outwards"));
    if (!body.two_sided || !body.closed) continue;
    const bool wrong = (body.inside_of % 2 == 0) != (body.volume > 0);
    report.volume += (body.inside_of % 2 == 0 ? 1 : -1) * std::abs(body.volume);
    if (!wrong) continue;
    ++turned;
    for (int face : body.faces)
      std::reverse(welded.faces[index(face)].begin(), welded.faces[index(face)].end());
  }
  return turned;
}

/// Of several bodies, what each of the first ten consists of.
std::string listed(const Welded& welded, const std::vector<Body>& bodies) {
  std::string list;
  for (std::size_t b = 0; b < std::min<std::size_t>(bodies.size(), 10); ++b) {
    const Body& body = bodies[b];
    list += sentence(b == 0 ? "" : "; ", counted(body.faces.size(), "triangle", "triangles"), " with ",
                     at(welded, body.faces.front()), body.inside_of > 0 ? ", inside another" : "");
  }
  return list;
}

/// Turns triangles and whole bodies, and reports on all of them. `edges` are those of the triangles and the
/// covers of rims.
void orient_bodies(Welded& welded, const std::vector<Face>& covers, const surface::EdgeTable& edges,
                   Problems& problems, CadReport& report) {
  const Bodies found = orient_triangles(welded, covers, edges);
  if (!found.against_neighbours.empty())
    report.repairs.push_back(
        sentence(counted(found.against_neighbours.size(), "triangle that faced against its neighbours was",
                         "triangles that faced against their neighbours were"),
                 " turned, the first ", at(welded, found.against_neighbours.front())));
  const int turned = turn_bodies(welded, found.bodies, problems, report);
  if (turned > 0 && found.bodies.size() == 1)
    report.repairs.push_back("the whole surface faced into the mill's interior and was turned");
  if (turned > 0 && found.bodies.size() > 1)
    report.repairs.push_back(sentence(turned, " of ", found.bodies.size(),
                                      " bodies faced into the mill's interior and ",
                                      turned == 1 ? "was" : "were", " turned"));
  if (found.bodies.size() <= 1 || has_branching_edge(edges)) return;
  report.warnings.push_back(
      sentence(found.bodies.size(), " bodies that are not connected: ", listed(welded, found.bodies)));
}

/// Warns of a wide tolerance, and reports parts that it removed as a whole.
void check_tolerance(const PolygonSet& set, const Welded& welded, double nearest, CadReport& report,
                     Problems& problems) {
  const double diagonal = surface::extent(set.points);
  if (nearest > widest_tolerance * diagonal)
    report.warnings.push_back(sentence("corners nearer than ", nearest, " m were joined, which is ",
                                       100 * nearest / diagonal,
                                       " % of the surface's diagonal: is --tolerance in m?"));
  const auto triangles_of = [](const PolygonSet& polygons, std::size_t group) {
    return std::count_if(polygons.polygons.begin(), polygons.polygons.end(), [group](const auto& polygon) {
      return static_cast<std::size_t>(polygon.group) == group;
    });
  };
  for (std::size_t group = 0; group < set.groups.size(); ++group) {
    const auto before = triangles_of(set, group);
    if (before == 0 || triangles_of(welded.set, group) > 0) continue;
    problems.add("part without triangles", sentence(set.groups[group], ": none of its ", before,
                                                    " triangles is left, because corners nearer ", "than ",
                                                    nearest, " m are one: expected a smaller --tolerance"));
  }
}

WallSurface to_walls(const Welded& welded) {
  WallSurface surface{welded.points, {}};
  for (const char* name : wall_parts) {
    surface.parts.push_back({name, {}});
    for (std::size_t t = 0; t < welded.faces.size(); ++t) {
      if (welded.set.groups[index(welded.set.polygons[t].group)] != name) continue;
      const Face& face = welded.faces[t];
      surface.parts.back().triangles.push_back({face[0], face[1], face[2]});
    }
  }
  return surface;
}

void check_crossings(const Welded& welded, Problems& problems) {
  for (const Crossing& crossing : crossing_triangles(welded.points, welded.faces)) {
    problems.add("crossing triangles",
                 sentence(place(welded.set, crossing.faces[0]), ": the triangle crosses ",
                          place(welded.set, crossing.faces[1]), " near ", described(crossing.where)));
  }
}

void check_needles(CadReport& report) {
  const Needles needles = find_needles(report.surface);
  if (needles.count == 0) return;
  report.warnings.push_back(
      sentence(counted(static_cast<std::size_t>(needles.count), "needle triangle", "needle triangles"),
               ", with a height below ", needle_ratio, " of the longest side; the worst has ",
               needles.smallest_ratio, " at ", described(needles.where)));
}

}  // namespace

CadReport examine(const std::vector<PartFile>& parts, double scale, double tolerance, Ends ends) {
  const PolygonSet set = read_parts(parts, scale, ends);
  if (set.polygons.empty()) throw std::runtime_error("no part was given: expected PART=FILE.stl");
  CadReport report;
  check_frame(set, report);
  const double nearest = tolerance > 0 ? tolerance : default_tolerance * surface::extent(set.points);
  Welded welded = weld_corners(set, nearest, report);
  const std::vector<Face> covers =
      ends == Ends::periodic ? rim_covers(welded, report, nearest) : std::vector<Face>();
  std::vector<Face> all = welded.faces;
  all.insert(all.end(), covers.begin(), covers.end());
  const surface::EdgeTable edges = surface::find_edges(all);
  Problems problems;
  const WeldedSet view{welded.set, welded.points, welded.faces};
  check_tolerance(set, welded, nearest, report, problems);
  check_edges(view, edges, problems);
  check_areas(view, problems);
  orient_bodies(welded, covers, edges, problems, report);
  check_crossings(welded, problems);
  report.triangles = static_cast<int>(welded.faces.size());
  report.surface = to_walls(welded);
  check_needles(report);
  for (const std::string& problem : problems.sentences()) report.problems.push_back(problem);
  return report;
}

}  // namespace millfoam::meshing
