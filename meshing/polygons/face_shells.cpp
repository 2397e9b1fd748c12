// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/polygons/face_shells.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "meshing/faces/union_find.hpp"
#include "meshing/surface/pi.hpp"

namespace millfoam::meshing {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

/// Faces nearer in angle than this have no order about their edge.
constexpr double same_direction = 1e-6;  // rad
/// A shell is flat below this volume over the power 3/2 of its area.
constexpr double flat_shell = 1e-12;

const Vector3d& at(const Points& points, int p) {
  return points[static_cast<std::size_t>(p)];
}

struct Leaf {
  double angle;
  const surface::FaceSide* side;
};

/// The faces at an edge by their angle about it, right-handed from the lower to the higher point.
std::vector<Leaf> sorted_about(const Points& points, const std::vector<Face>& faces,
                               const surface::EdgeTable& edges, std::size_t edge) {
  const Vector3d axis = (at(points, edges.first(edge).high) - at(points, edges.first(edge).low)).normalized();
  const Vector3d u = axis.unitOrthogonal();
  const Vector3d v = axis.cross(u);
  std::vector<Leaf> leaves;
  for (std::size_t i = edges.begin[edge]; i < edges.begin[edge + 1]; ++i) {
    const surface::FaceSide& side = edges.sides[i];
    const Vector3d area = area_vector(points, faces[static_cast<std::size_t>(side.face)]);
    const Vector3d direction = (side.forward ? 1 : -1) * area.cross(axis);
    leaves.push_back({std::atan2(direction.dot(v), direction.dot(u)), &side});
  }
  std::sort(leaves.begin(), leaves.end(), [](const Leaf& a, const Leaf& b) { return a.angle < b.angle; });
  return leaves;
}

/// The side of a face that looks forward, or back, in rotation about its edge.
std::size_t looking(const surface::FaceSide& side, bool on) {
  return 2 * static_cast<std::size_t>(side.face) + (side.forward == on ? in_front : behind);
}

/// Sides of each shell.
std::vector<std::vector<std::size_t>> members(const Shells& shells) {
  std::vector<std::vector<std::size_t>> sides(shells.volume.size());
  for (std::size_t s = 0; s < shells.of_side.size(); ++s)
    sides[static_cast<std::size_t>(shells.of_side[s])].push_back(s);
  return sides;
}

void measure(const Points& points, const std::vector<Face>& faces, Shells& shells) {
  const auto sides = members(shells);
  for (std::size_t shell = 0; shell < sides.size(); ++shell) {
    const Vector3d apex = at(points, faces[sides[shell].front() / 2].front());
    for (std::size_t side : sides[shell]) {
      // A shell's normals point out of what it bounds: against the face's where the shell is in front of it.
      const double sign = side % 2 == in_front ? -1 : 1;
      shells.volume[shell] += sign * pyramid_volume(points, faces[side / 2], apex);
      shells.area[shell] += area_vector(points, faces[side / 2]).norm();
    }
  }
}

/// The shells of cells, prepared to find the one that contains a point.
class Containers {
 public:
  Containers(const Points& points, const std::vector<Face>& faces, const Shells& shells)
      : points_(points), faces_(faces), shells_(shells), sides_(members(shells)) {
    for (const auto& sides : sides_) {
      boxes_.emplace_back();
      for (std::size_t side : sides) {
        for (int p : faces_[side / 2]) boxes_.back().extend(at(points_, p));
      }
    }
  }

  /// The smallest shell of positive volume that contains a shell, or -1.
  int containing(int shell) const {
    const Face& face = faces_[sides_[static_cast<std::size_t>(shell)].front() / 2];
    const auto [a, b, c] = triangles_of(points_, face).front();
    const Vector3d point = (at(points_, a) + at(points_, b) + at(points_, c)) / 3;
    int best = -1;
    for (int other = 0; other < shells_.count(); ++other) {
      const auto i = static_cast<std::size_t>(other);
      const bool smaller = best < 0 || shells_.volume[i] < shells_.volume[static_cast<std::size_t>(best)];
      if (shells_.volume[i] <= -shells_.volume[static_cast<std::size_t>(shell)]) continue;
      if (smaller && boxes_[i].contains(point) && contains(i, point)) best = other;
    }
    return best;
  }

 private:
  bool contains(std::size_t shell, const Vector3d& point) const {
    double angle = 0;
    for (std::size_t side : sides_[shell])
      angle += (side % 2 == in_front ? -1 : 1) * solid_angle(points_, faces_[side / 2], point);
    return angle > 2 * pi;
  }

  const Points& points_;
  const std::vector<Face>& faces_;
  const Shells& shells_;
  std::vector<std::vector<std::size_t>> sides_;
  std::vector<AlignedBox3d> boxes_;
};

}  // namespace

std::vector<std::array<std::size_t, 2>> spaces_about(const Points& points, const std::vector<Face>& faces,
                                                     const surface::EdgeTable& edges, std::size_t edge,
                                                     std::vector<Overlap>* overlaps) {
  const std::vector<Leaf> leaves = sorted_about(points, faces, edges, edge);
  std::vector<std::array<std::size_t, 2>> spaces;
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    const bool last = i + 1 == leaves.size();
    const Leaf& one = leaves[i];
    const Leaf& next = leaves[last ? 0 : i + 1];
    spaces.push_back({looking(*one.side, true), looking(*next.side, false)});
    const double angle = next.angle - one.angle + (last ? 2 * pi : 0);
    if (overlaps != nullptr && leaves.size() > 1 && angle < same_direction)
      overlaps->push_back({{one.side->face, next.side->face}, edge});
  }
  return spaces;
}

Shells find_shells(const Points& points, const std::vector<Face>& faces, const surface::EdgeTable& edges) {
  Shells shells;
  UnionFind sides(2 * faces.size());
  for (std::size_t e = 0; e < edges.size(); ++e) {
    for (const auto& [one, other] : spaces_about(points, faces, edges, e, &shells.overlaps))
      sides.join(one, other);
  }
  const auto [of_side, count] = sides.numbered();
  shells.of_side = of_side;
  shells.volume.assign(static_cast<std::size_t>(count), 0);
  shells.area = shells.volume;
  measure(points, faces, shells);
  return shells;
}

ShellCells find_cells(const Points& points, const std::vector<Face>& faces, const Shells& shells) {
  ShellCells cells;
  cells.of_shell.assign(shells.volume.size(), outside);
  for (std::size_t i = 0; i < shells.volume.size(); ++i) {
    if (std::abs(shells.volume[i]) <= flat_shell * std::pow(shells.area[i], 1.5)) {
      cells.flat.push_back(static_cast<int>(i));
    } else if (shells.volume[i] > 0) {
      cells.of_shell[i] = static_cast<int>(cells.volume.size());
      cells.volume.push_back(shells.volume[i]);
    }
  }
  if (!cells.flat.empty()) return cells;
  const Containers containers(points, faces, shells);
  for (int i = 0; i < shells.count(); ++i) {
    const double volume = shells.volume[static_cast<std::size_t>(i)];
    if (volume > 0) continue;
    const int around = containers.containing(i);
    if (around < 0) continue;
    const int cell = cells.of_shell[static_cast<std::size_t>(around)];
    cells.of_shell[static_cast<std::size_t>(i)] = cell;
    cells.volume[static_cast<std::size_t>(cell)] += volume;
  }
  return cells;
}

}  // namespace millfoam::meshing
