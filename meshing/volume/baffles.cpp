// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/volume/baffles.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "meshing/faces/union_find.hpp"

namespace millfoam::meshing {
namespace {

/// Corners of cells, (point, cell), in groups that are joined through inner faces.
class CornerGroups {
 public:
  template <typename Mesh>
  explicit CornerGroups(const Mesh& mesh) : corners_(corners(mesh)), groups_(corners_.size()) {
    for (std::size_t f = 0; f < mesh.neighbour.size(); ++f) {
      for (int p : mesh.faces[f]) groups_.join(find(p, mesh.owner[f]), find(p, mesh.neighbour[f]));
    }
  }

  std::size_t size() const { return corners_.size(); }
  int point(std::size_t corner) const { return corners_[corner].first; }
  std::size_t find(int point, int cell) const {
    const auto at = std::lower_bound(corners_.begin(), corners_.end(), std::pair{point, cell});
    return static_cast<std::size_t>(at - corners_.begin());
  }
  /// The group's first corner.
  std::size_t first(std::size_t corner) { return groups_.find(corner); }

 private:
  template <typename Mesh>
  static std::vector<std::pair<int, int>> corners(const Mesh& mesh) {
    std::vector<std::pair<int, int>> corners;
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
      for (int p : mesh.faces[f]) {
        corners.emplace_back(p, mesh.owner[f]);
        if (f < mesh.neighbour.size()) corners.emplace_back(p, mesh.neighbour[f]);
      }
    }
    std::sort(corners.begin(), corners.end());
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    return corners;
  }

  std::vector<std::pair<int, int>> corners_;
  UnionFind groups_;
};

template <typename Mesh>
void separate_points(Mesh& mesh) {
  CornerGroups groups(mesh);
  std::vector<int> point_of(groups.size());
  for (std::size_t c = 0; c < groups.size(); ++c) {
    const int point = groups.point(c);
    if (groups.first(c) != c) {
      point_of[c] = point_of[groups.first(c)];
    } else if (c == 0 || groups.point(c - 1) != point) {
      point_of[c] = point;
    } else {
      point_of[c] = static_cast<int>(mesh.points.size());
      mesh.points.push_back(Eigen::Vector3d(mesh.points[static_cast<std::size_t>(point)]));
    }
  }
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    for (int& p : mesh.faces[f]) p = point_of[groups.find(p, mesh.owner[f])];
  }
}

}  // namespace

void separate_points_at_baffles(VolumeMesh& mesh) {
  separate_points(mesh);
}

void separate_points_at_baffles(PolyMesh& mesh) {
  separate_points(mesh);
}

}  // namespace millfoam::meshing
