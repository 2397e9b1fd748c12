// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/mill_mesh.hpp"

#include <algorithm>
#include <cassert>
#include <map>
#include <tuple>
#include <utility>

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

/// Draws a cross-section along z.
class Extrusion {
 public:
  Extrusion(const CrossSection& section, double length, int layers)
      : section_(section), edges_(find_edges(section)), layers_(layers) {
    mesh_.cells = quads() * layers;
    for (int level = 0; level <= layers; ++level) {
      const double z = level == layers ? length : length * level / layers;
      for (const auto& point : section.points) mesh_.points.emplace_back(point.x(), point.y(), z);
    }
  }

  VolumeMesh run(Ends ends) && {
    add_inner_faces();
    add_wall("shell", CrossSection::Part::shell);
    add_wall("lifters", CrossSection::Part::lifters);
    const bool periodic = ends == Ends::periodic;
    add_end("feedEnd", 0, periodic ? "dischargeEnd" : "");
    add_end("dischargeEnd", layers_, periodic ? "feedEnd" : "");
    return std::move(mesh_);
  }

 private:
  int quads() const { return static_cast<int>(section_.quads.size()); }
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

  void add_inner_faces() {
    for (int layer = 0; layer < layers_; ++layer) {
      auto edge = edges_.inner.begin();
      const int first = layer * quads();
      for (int quad = 0; quad < quads(); ++quad) {
        for (; edge != edges_.inner.end() && edge->owner == quad; ++edge) {
          add(side(layer, edge->from, edge->to), first + quad);
          mesh_.neighbour.push_back(first + edge->neighbour);
        }
        if (layer + 1 < layers_) {
          add(across(layer + 1, quad), first + quad);
          mesh_.neighbour.push_back(first + quads() + quad);
        }
      }
    }
  }

  void begin_patch(const std::string& name, const std::string& neighbour) {
    mesh_.patches.push_back({name, static_cast<int>(mesh_.faces.size()), 0, neighbour});
  }
  void end_patch() {
    mesh_.patches.back().size = static_cast<int>(mesh_.faces.size()) - mesh_.patches.back().start;
  }

  void add_wall(const std::string& name, CrossSection::Part part) {
    begin_patch(name, "");
    for (int layer = 0; layer < layers_; ++layer) {
      for (std::size_t e = 0; e < section_.walls.size(); ++e) {
        const auto& wall = section_.walls[e];
        if (wall.part != part) continue;
        add(side(layer, wall.points[0], wall.points[1]), layer * quads() + edges_.wall_owner[e]);
      }
    }
    end_patch();
  }

  void add_end(const std::string& name, int level, const std::string& neighbour) {
    begin_patch(name, neighbour);
    for (int quad = 0; quad < quads(); ++quad) {
      Quad face = across(level, quad);
      // Reversed, but with the same first point: OpenFOAM joins periodic faces by it.
      if (level == 0) std::reverse(face.begin() + 1, face.end());
      add(face, std::max(0, level - 1) * quads() + quad);
    }
    end_patch();
  }

  const CrossSection& section_;
  SectionEdges edges_;
  int layers_;
  VolumeMesh mesh_;
};

}  // namespace

VolumeMesh make_mill_mesh(const CrossSection& section, const Geometry& geometry, int layers) {
  return Extrusion(section, geometry.length, layers).run(geometry.ends);
}

}  // namespace millfoam::meshing
