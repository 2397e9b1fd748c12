// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/baffles.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace millfoam::meshing {
namespace {

/// Corners of cells, (point, cell), in groups that are joined through inner faces.
class CornerGroups {
 public:
  explicit CornerGroups(const VolumeMesh& mesh) {
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
      for (int p : mesh.faces[f]) {
        corners_.emplace_back(p, mesh.owner[f]);
        if (f < mesh.neighbour.size()) corners_.emplace_back(p, mesh.neighbour[f]);
      }
    }
    std::sort(corners_.begin(), corners_.end());
    corners_.erase(std::unique(corners_.begin(), corners_.end()), corners_.end());
    parent_.resize(corners_.size());
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
    for (std::size_t f = 0; f < mesh.neighbour.size(); ++f) {
      for (int p : mesh.faces[f]) join(find(p, mesh.owner[f]), find(p, mesh.neighbour[f]));
    }
  }

  std::size_t size() const { return corners_.size(); }
  int point(std::size_t corner) const { return corners_[corner].first; }
  std::size_t find(int point, int cell) const {
    const auto at = std::lower_bound(corners_.begin(), corners_.end(), std::pair{point, cell});
    return static_cast<std::size_t>(at - corners_.begin());
  }
  /// The group's first corner.
  std::size_t first(std::size_t corner) {
    while (parent_[corner] != corner) corner = parent_[corner] = parent_[parent_[corner]];
    return corner;
  }

 private:
  void join(std::size_t a, std::size_t b) {
    a = first(a);
    b = first(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

  std::vector<std::pair<int, int>> corners_;
  std::vector<std::size_t> parent_;
};

}  // namespace

void separate_points_at_baffles(VolumeMesh& mesh) {
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

}  // namespace millfoam::meshing
