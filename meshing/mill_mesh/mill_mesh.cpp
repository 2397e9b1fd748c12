// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/mill_mesh/mill_mesh.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

#include "meshing/files/text_numbers.hpp"
#include "meshing/mill/mill_error.hpp"
#include "meshing/mill/mill_geometry.hpp"
#include "meshing/mill_mesh/openings.hpp"
#include "meshing/volume/baffles.hpp"

namespace millfoam::meshing {
namespace {

/// A side shared by two quadrilaterals of the cross-section; the owner, which has the smaller index, lies to
/// the left.
struct InnerEdge {
  int owner;
  int neighbour;
  int from;
  int to;
};

/// The sides between two quadrilaterals sorted by owner and neighbour, and the owner of each wall edge.
struct SectionEdges {
  std::vector<InnerEdge> inner;
  std::vector<int> wall_owner;
};

SectionEdges find_edges(const CrossSection& section) {
  std::map<std::pair<int, int>, int> left_of;  // quadrilateral to the left of the way between two points
  for (std::size_t q = 0; q < section.quads.size(); ++q) {
    for (std::size_t i = 0; i < 4; ++i) {
      left_of[{section.quads[q][i], section.quads[q][(i + 1) % 4]}] = static_cast<int>(q);
    }
  }
  SectionEdges edges;
  for (const auto& [ends, owner] : left_of) {
    const auto other = left_of.find({ends.second, ends.first});
    if (other != left_of.end() && owner < other->second) {
      edges.inner.push_back({owner, other->second, ends.first, ends.second});
    }
  }
  std::sort(edges.inner.begin(), edges.inner.end(), [](const InnerEdge& a, const InnerEdge& b) {
    return std::tie(a.owner, a.neighbour) < std::tie(b.owner, b.neighbour);
  });
  for (const auto& wall : section.walls)
    edges.wall_owner.push_back(left_of.at({wall.points[0], wall.points[1]}));
  assert(2 * edges.inner.size() + section.walls.size() == left_of.size());
  return edges;
}

/// Growth, 1 or more, from a term to the next of a geometric series of `terms` terms that begins with 1 and
/// has this sum, to rounding.
double growth_of(double sum, int terms) {
  double least = 1;
  double most =
      terms > 1 ? std::max(1.0, std::pow(sum, 1.0 / (terms - 1))) : 1;  // the last term is below the sum
  for (double growth = (least + most) / 2; growth > least && growth < most; growth = (least + most) / 2) {
    double series = 0;
    for (int term = 0; term < terms; ++term) series = series * growth + 1;
    (series < sum ? least : most) = growth;
  }
  return least;
}

/// Extrudes a cross-section along z: through the mill and, where there are any, through the pulp lifters.
class Extrusion {
 public:
  Extrusion(const CrossSection& section, const Geometry& geometry, int layers, double last_layer)
      : section_(section),
        geometry_(geometry),
        openings_(find_openings(section, geometry)),
        edges_(find_edges(section)),
        layers_(layers),
        all_layers_(layers + (geometry.pulp_lifters ? geometry.pulp_lifters->layers : 0)),
        ends_(layer_ends(geometry.length, layers, last_layer)) {
    mesh_.cells = quads() * all_layers_;
    for (int level = 0; level <= all_layers_; ++level) {
      for (const auto& point : section.points) mesh_.points.emplace_back(point.x(), point.y(), height(level));
    }
  }

  VolumeMesh run() && {
    add_zones();
    add_inner_faces();
    add_patch("shell", [&] { add_sides(CrossSection::Part::shell, 0, layers_); });
    add_patch("lifters", [&] { add_sides(CrossSection::Part::lifters, 0, layers_); });
    add_patch("feedEnd", [&] { add_end(0, [&](std::size_t q) { return !openings_.inlet[q]; }); });
    add_patch("dischargeEnd", [&] { add_discharge_end(); });
    if (geometry_.ends == Ends::periodic) {
      mesh_.patches[2].neighbour = "dischargeEnd";
      mesh_.patches[3].neighbour = "feedEnd";
    }
    if (geometry_.inlet) {
      add_patch("inlet", [&] { add_end(0, [&](std::size_t q) { return openings_.inlet[q]; }); });
      mesh_.patches.back().open = true;
    }
    if (geometry_.pulp_lifters) {
      const auto outside = [&](std::size_t q) { return openings_.compartment[q] >= 0; };
      add_patch("outlet", [&] { add_end(all_layers_, [&](std::size_t q) { return !outside(q); }); });
      mesh_.patches.back().open = true;
      add_patch("pulpLifters", [&] {
        add_sides(CrossSection::Part::shell, layers_, all_layers_);
        add_sides(CrossSection::Part::lifters, layers_, all_layers_);
        add_radial_walls();
        add_end(all_layers_, outside);
      });
      separate_points_at_baffles(mesh_);
    } else if (geometry_.grates) {
      add_patch("grates", [&] { add_end(layers_, [&](std::size_t q) { return openings_.grates[q]; }); });
      mesh_.patches.back().open = true;
    }
    return std::move(mesh_);
  }

 private:
  int quads() const { return static_cast<int>(section_.quads.size()); }
  double height(int level) const {
    if (level <= layers_) return ends_[static_cast<std::size_t>(level)];
    return geometry_.length + geometry_.pulp_lifters->depth * (level - layers_) / (all_layers_ - layers_);
  }
  int point(int level, int p) const { return level * static_cast<int>(section_.points.size()) + p; }

  /// The face over the way from `from` to `to`, whose normal points to the right of it.
  Quad side(int layer, int from, int to) const {
    return {point(layer, from), point(layer, to), point(layer + 1, to), point(layer + 1, from)};
  }

  /// The face over a quadrilateral, whose normal points to +z.
  Quad across(int level, int quad) const {
    Quad face{};
    for (std::size_t i = 0; i < 4; ++i)
      face[i] = point(level, section_.quads[static_cast<std::size_t>(quad)][i]);
    return face;
  }

  void add(const Quad& face, int owner) {
    mesh_.faces.push_back(face);
    mesh_.owner.push_back(owner);
  }

  /// Whether a radial wall of the pulp lifters lies between two quadrilaterals.
  bool separated(const InnerEdge& edge) const {
    const int a = openings_.compartment[static_cast<std::size_t>(edge.owner)];
    const int b = openings_.compartment[static_cast<std::size_t>(edge.neighbour)];
    return a >= 0 && b >= 0 && a != b;
  }

  /// Whether the cells on both sides of a level are joined over a quadrilateral.
  bool joined(int level, int quad) const {
    return level < all_layers_ && (level != layers_ || openings_.grates[static_cast<std::size_t>(quad)]);
  }

  /// With pulp lifters, the faces of the grates, and all cells behind them, which balls do not reach.
  void add_zones() {
    if (!geometry_.pulp_lifters) return;
    mesh_.face_zones.push_back({"grates", {}});
    mesh_.cell_zones.push_back(
        {pulp_lifters_zone, std::vector<int>(static_cast<std::size_t>(quads() * (all_layers_ - layers_)))});
    auto& behind = mesh_.cell_zones.back().members;
    std::iota(behind.begin(), behind.end(), quads() * layers_);
  }

  void add_inner_faces() {
    for (int layer = 0; layer < all_layers_; ++layer) {
      auto edge = edges_.inner.begin();
      const int first = layer * quads();
      for (int quad = 0; quad < quads(); ++quad) {
        for (; edge != edges_.inner.end() && edge->owner == quad; ++edge) {
          if (layer >= layers_ && separated(*edge)) continue;
          add(side(layer, edge->from, edge->to), first + quad);
          mesh_.neighbour.push_back(first + edge->neighbour);
        }
        if (!joined(layer + 1, quad)) continue;
        if (layer + 1 == layers_) {
          mesh_.face_zones.back().members.push_back(static_cast<int>(mesh_.faces.size()));
        }
        add(across(layer + 1, quad), first + quad);
        mesh_.neighbour.push_back(first + quads() + quad);
      }
    }
  }

  template <typename AddFaces>
  void add_patch(const std::string& name, const AddFaces& add_faces) {
    const int start = static_cast<int>(mesh_.faces.size());
    add_faces();
    mesh_.patches.push_back({name, start, static_cast<int>(mesh_.faces.size()) - start, ""});
  }

  void add_sides(CrossSection::Part part, int first_layer, int end_layer) {
    for (int layer = first_layer; layer < end_layer; ++layer) {
      for (std::size_t e = 0; e < section_.walls.size(); ++e) {
        const auto& wall = section_.walls[e];
        if (wall.part != part) continue;
        add(side(layer, wall.points[0], wall.points[1]), layer * quads() + edges_.wall_owner[e]);
      }
    }
  }

  void add_radial_walls() {
    for (int layer = layers_; layer < all_layers_; ++layer) {
      for (const InnerEdge& edge : edges_.inner) {
        if (!separated(edge)) continue;
        add(side(layer, edge.from, edge.to), layer * quads() + edge.owner);
        add(side(layer, edge.to, edge.from), layer * quads() + edge.neighbour);
      }
    }
  }

  /// The quadrilaterals that `chosen` takes, at a level, with cells in front of it (normal +z) or behind.
  template <typename Chosen>
  void add_level(int level, bool in_front, const Chosen& chosen) {
    for (int quad = 0; quad < quads(); ++quad) {
      if (!chosen(static_cast<std::size_t>(quad))) continue;
      Quad face = across(level, quad);
      // Reversed, but with the same first point: OpenFOAM joins periodic faces by it.
      if (!in_front) std::reverse(face.begin() + 1, face.end());
      add(face, (in_front ? level - 1 : level) * quads() + quad);
    }
  }

  template <typename Chosen>
  void add_end(int level, const Chosen& chosen) {
    add_level(level, level > 0, chosen);
  }

  /// The part of the discharge end that is not a grate; it has two sides where pulp lifters lie behind it.
  void add_discharge_end() {
    const auto is_wall = [&](std::size_t q) { return !openings_.grates[q]; };
    add_level(layers_, true, is_wall);
    if (geometry_.pulp_lifters) add_level(layers_, false, is_wall);
  }

  const CrossSection& section_;
  const Geometry& geometry_;
  Openings openings_;
  SectionEdges edges_;
  int layers_;      ///< of the mill
  int all_layers_;  ///< with those of the pulp lifters
  std::vector<double> ends_;
  VolumeMesh mesh_;
};

}  // namespace

std::vector<double> layer_ends(double length, int layers, double last) {
  std::vector<double> ends;
  if (last <= 0) {
    for (int level = 0; level < layers; ++level) ends.push_back(length * level / layers);
    ends.push_back(length);
    return ends;
  }
  const double growth = growth_of(length / last, layers);
  double thickness = last;
  ends.push_back(length);
  for (int layer = 1; layer < layers; ++layer, thickness *= growth) ends.push_back(ends.back() - thickness);
  ends.push_back(0);
  std::reverse(ends.begin(), ends.end());
  return ends;
}

VolumeMesh make_mill_mesh(const CrossSection& section, const Geometry& geometry, int layers,
                          double last_layer) {
  // Narrow lifters and circles of openings need more cells than resolution.cell_size alone
  const int all_layers = layers + (geometry.pulp_lifters ? geometry.pulp_lifters->layers : 0);
  const double cells = static_cast<double>(section.quads.size()) * all_layers;
  if (cells > most_cells)
    throw KeyError("resolution.layers", std::to_string(layers),
                   "at most 1e8 cells in the mill, not " + shown(cells) + ": its cross-section has " +
                       std::to_string(section.quads.size()));
  return Extrusion(section, geometry, layers, last_layer).run();
}

}  // namespace millfoam::meshing
