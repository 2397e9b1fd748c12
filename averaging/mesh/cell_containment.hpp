// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <vector>

#include "averaging/mesh/mesh_geometry.hpp"

namespace millfoam::averaging {

/// Whether points and boxes are in cells.
///
/// For each face of a cell, with n the mean normal out of the cell, two planes are kept: n . x = low through
/// the face's innermost point and n . x = high through the outermost point of the cell. What is beyond one
/// `high` is outside; what is below every `low` sees all faces from inside and is inside, by the winding
/// number, of convex and other cells alike. For a convex cell with flat faces low = high. The planes are kept
/// in single precision, with what that may cost added to the margin between them.
///
/// Where the planes leave it unclear, it is settled by the facets. The ray from the centroid of a cell that
/// is star-shaped about it leaves the cell once; if that is through a face whose plane left it unclear, the
/// facet that the ray goes through decides. For other cells, and for points on a facet, the sum of the
/// facets' solid angles does: 4 pi inside and 0 outside.
class CellContainment {
 public:
  /// Whether a cell contains a point or a whole box.
  enum class Answer { outside, inside, unclear };

  /// A point, or the middle of a box, from the mesh's middle in m, in the planes' precision.
  struct LocalPoint {
    float x,  ///< m
        y,    ///< m
        z;    ///< m
  };

  /// Of cells whose planes lie in memory in the order of their numbers.
  explicit CellContainment(const MeshGeometry& geometry);

  /// Of cells whose planes lie in memory in a given order of all their numbers.
  CellContainment(const MeshGeometry& geometry, std::vector<int> order);

  /// Follows a geometry that has moved.
  void update(const MeshGeometry& geometry);

  /// A point of the mesh's frame, m, for the tests.
  LocalPoint local(const Eigen::Vector3d& point) const {
    const Eigen::Vector3f p = (point - origin_).cast<float>();
    return {p.x(), p.y(), p.z()};
  }

  /// Of a point, by the planes alone.
  Answer test(int cell, const LocalPoint& point) const {
    const Range range = ranges_[static_cast<std::size_t>(cell)];
    Eigen::Array4f below = Eigen::Array4f::Constant(-1);
    for (int b = range.begin; b < range.end; ++b) {
      const Planes& planes = planes_[static_cast<std::size_t>(b)];
      const Eigen::Array4f height = planes.nx * point.x + planes.ny * point.y + planes.nz * point.z;
      if ((height - planes.high).maxCoeff() > 0) return Answer::outside;
      below = below.max(height - planes.low);
    }
    return below.maxCoeff() < 0 ? Answer::inside : Answer::unclear;
  }

  /// Of a whole box about a point: outside and inside are certain.
  /// @param cell    number of the cell
  /// @param middle  of the box
  /// @param half    half its edges, m
  Answer test_box(int cell, const LocalPoint& middle, const Eigen::Vector3f& half) const;

  /// The lowest of the cells, given in rising order, that holds the point, or -1.
  int first_holding(const MeshGeometry& geometry, const Eigen::Vector3d& point,
                    const std::vector<int>& cells) const;

 private:
  /// Four faces.
  struct Planes {
    Eigen::Array4f nx = Eigen::Array4f::Zero();
    Eigen::Array4f ny = Eigen::Array4f::Zero();
    Eigen::Array4f nz = Eigen::Array4f::Zero();
    Eigen::Array4f low = Eigen::Array4f::Constant(std::numeric_limits<float>::max());
    Eigen::Array4f high = Eigen::Array4f::Constant(std::numeric_limits<float>::max());
  };

  /// Where a cell's planes are.
  struct Range {
    int begin = 0;
    int end = 0;
  };

  /// A face's mean normal out of its owner and how far its points reach along it, from the origin.
  struct Slab {
    Eigen::Vector3d normal;
    double low;
    double high;
  };

  void measure_face(const MeshGeometry& geometry, std::size_t face);
  void add_cell(const MeshGeometry& geometry, int cell);
  bool is_star(const MeshGeometry& geometry, int cell) const;
  Answer test_star_shaped(const MeshGeometry& geometry, const Eigen::Vector3d& point, int cell) const;
  Answer test_face(const MeshGeometry& geometry, const Eigen::Vector3d& point, int cell, int face) const;
  double winding(const MeshGeometry& geometry, const Eigen::Vector3d& point, int cell) const;

  Eigen::Vector3d origin_;
  double slack_ = 0;         ///< by which single precision may be wrong, m
  double flat_ = 0;          ///< by which a point may be off a facet and still lie on it, m
  std::vector<Slab> slabs_;  ///< [faces]
  std::vector<char> star_;   ///< [cells] whether star-shaped about the centroid
  std::vector<int> order_;
  std::vector<Range> ranges_;  ///< [cells]
  std::vector<Planes> planes_;
};

}  // namespace millfoam::averaging
