// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/walls/surface_bodies.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <queue>

#include "meshing/surface/pi.hpp"

namespace millfoam::meshing {
namespace {

using Eigen::Vector3d;

/// A face on the other side of an edge, and whether both go the same way along it, which they must not.
struct Neighbour {
  int face;
  bool disagrees;
};

std::vector<std::vector<Neighbour>> find_neighbours(const surface::EdgeTable& edges, std::size_t faces) {
  std::vector<std::vector<Neighbour>> neighbours(faces);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    if (edges.faces(e) != 2) continue;
    const surface::FaceSide& one = edges.sides[edges.begin[e]];
    const surface::FaceSide& other = edges.sides[edges.begin[e] + 1];
    const bool disagrees = one.forward == other.forward;
    neighbours[index(one.face)].push_back({other.face, disagrees});
    neighbours[index(other.face)].push_back({one.face, disagrees});
  }
  return neighbours;
}

/// Whether each face must be turned to agree with the first of its body; -1 where not yet reached.
using Turned = std::vector<int>;

Body reached_from(int first, const std::vector<std::vector<Neighbour>>& neighbours, Turned& turned) {
  Body body;
  std::queue<int> front({first});
  turned[index(first)] = 0;
  for (; !front.empty(); front.pop()) {
    const int face = front.front();
    body.faces.push_back(face);
    for (const Neighbour& next : neighbours[index(face)]) {
      const int turn = turned[index(face)] ^ (next.disagrees ? 1 : 0);
      int& of_next = turned[index(next.face)];
      if (of_next >= 0) {
        body.two_sided = body.two_sided && of_next == turn;
        continue;
      }
      of_next = turn;
      front.push(next.face);
    }
  }
  return body;
}

/// Turns the fewer of a body's faces.
void orient(const Body& body, Turned& turned, std::vector<Face>& faces, std::vector<int>& against) {
  std::size_t count = 0;
  for (int face : body.faces) count += turned[index(face)] == 1 ? 1 : 0;
  const int those = 2 * count > body.faces.size() ? 0 : 1;
  for (int face : body.faces) {
    if (turned[index(face)] != those) continue;
    std::reverse(faces[index(face)].begin(), faces[index(face)].end());
    against.push_back(face);
  }
}

double seen_from(const Points& points, const std::vector<Face>& faces, const Body& body,
                 const Vector3d& from) {
  double angle = 0;
  for (int face : body.faces) angle += solid_angle(points, faces[index(face)], from);
  return angle;
}

void count_containers(const Points& points, const std::vector<Face>& faces, std::vector<Body>& bodies) {
  std::vector<Eigen::AlignedBox3d> boxes(bodies.size());
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    for (int face : bodies[b].faces) {
      for (int p : faces[index(face)]) boxes[b].extend(points[index(p)]);
    }
  }
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const Vector3d point = middle(points, faces[index(bodies[b].faces.front())]);
    for (std::size_t other = 0; other < bodies.size(); ++other) {
      if (other == b || !bodies[other].closed || !boxes[other].contains(point)) continue;
      if (std::abs(seen_from(points, faces, bodies[other], point)) > 2 * pi) ++bodies[b].inside_of;
    }
  }
}

}  // namespace

Bodies find_bodies(const Points& points, const surface::EdgeTable& edges, std::vector<Face>& faces) {
  Bodies found;
  const auto neighbours = find_neighbours(edges, faces.size());
  Turned turned(faces.size(), -1);
  std::vector<std::size_t> body_of(faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (turned[f] >= 0) continue;
    found.bodies.push_back(reached_from(static_cast<int>(f), neighbours, turned));
    for (int face : found.bodies.back().faces) body_of[index(face)] = found.bodies.size() - 1;
    if (found.bodies.back().two_sided) orient(found.bodies.back(), turned, faces, found.against_neighbours);
  }
  for (std::size_t e = 0; e < edges.size(); ++e) {
    for (std::size_t s = edges.begin[e]; s < edges.begin[e + 1] && edges.faces(e) != 2; ++s)
      found.bodies[body_of[index(edges.sides[s].face)]].closed = false;
  }
  for (Body& body : found.bodies) {
    const Vector3d& apex = points[index(faces[index(body.faces.front())].front())];
    for (int face : body.faces) body.volume += pyramid_volume(points, faces[index(face)], apex);
  }
  count_containers(points, faces, found.bodies);
  return found;
}

}  // namespace millfoam::meshing
