// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <vector>

#include "averaging/mesh/poly_mesh.hpp"

namespace millfoam::averaging {

/// A flat and convex piece of a face, a triangle or a quadrangle. Both cells of the face have the same
/// facets, so that between them nothing is counted twice or lost, however warped the face is.
struct Facet {
  std::array<int, 4>
      corners{};         ///< in `MeshGeometry::points`; by the right-hand rule they point out of `owner`
  int corner_count = 3;  ///< 3 or 4
  int owner = 0;         ///< the cell out of which the normal points
  int neighbour = -1;    ///< -1 on the boundary

  Eigen::Vector3d normal;  ///< unit vector, out of the owner
  double offset = 0;       ///< the facet's plane is normal . x = offset, m

  /// The cell on the other side.
  int other(int cell) const { return cell == owner ? neighbour : owner; }
};

/// The shape of a mesh's cells when its points are at given places.
///
/// A face of three points, or a convex one of four that is flat to round-off, is one facet. Of others, one
/// of four points that is flat to a millionth of its size is cut along the diagonal through the one of its
/// points that has the lowest number, and any other face is cut into a fan of triangles about the mean of its
/// points. Of a quadrangle such a fan encloses the same volume as the bilinear surface through its points.
class MeshGeometry {
 public:
  /// `topology` must have passed `check`. Throws std::invalid_argument, naming the cell, when its faces do
  /// not enclose it or its volume is not positive.
  MeshGeometry(MeshTopology topology, const MeshPoints& points);

  /// The same mesh with its points at other places. Throws as the constructor.
  void move(const MeshPoints& points);

  const MeshTopology& topology() const { return topology_; }  ///< as it was given
  std::size_t cells() const { return topology_.cells; }       ///< their number

  const MeshPoints& points() const { return points_; }          ///< of the mesh, then the middles of fans, m
  const std::vector<Facet>& facets() const { return facets_; }  ///< face by face
  const std::vector<double>& volumes() const { return volumes_; }           ///< [cells], m^3
  const std::vector<Eigen::Vector3d>& centres() const { return centres_; }  ///< [cells], centroids, m
  const std::vector<Eigen::AlignedBox3d>& boxes() const { return boxes_; }  ///< [cells], m
  const Eigen::AlignedBox3d& box() const { return box_; }                   ///< of the mesh, m

  /// Facets of face f: [first_facet(f), first_facet(f + 1)).
  int first_facet(std::size_t face) const { return face_facets_[face]; }

  /// Numbers of a cell's faces: [0] the first and [1] the one after the last, in rising order.
  std::array<const int*, 2> faces_of(int cell) const { return range(cell_faces_, cell); }

  /// Numbers of a cell's facets, in the same form.
  std::array<const int*, 2> facets_of(int cell) const { return range(cell_facets_, cell); }

 private:
  /// For each cell a list, one behind the other.
  struct Lists {
    std::vector<int> begin;
    std::vector<int> items;
  };
  static std::array<const int*, 2> range(const Lists& lists, int cell) {
    const auto c = static_cast<std::size_t>(cell);
    return {lists.items.data() + lists.begin[c], lists.items.data() + lists.begin[c + 1]};
  }

  void cut_faces();
  void cut_face(std::size_t face, double flat);
  void add_facet(std::size_t face, const std::array<int, 4>& corners, int count);
  void measure_cells();
  void measure_cell(int cell);
  template <typename OwnerOf, typename OtherOf>
  Lists list_by_cell(std::size_t count, OwnerOf&& owner_of, OtherOf&& other_of) const;

  MeshTopology topology_;
  MeshPoints points_;
  std::vector<Facet> facets_;
  std::vector<int> face_facets_;
  Lists cell_faces_;
  Lists cell_facets_;
  std::vector<double> volumes_;
  std::vector<Eigen::Vector3d> centres_;
  std::vector<Eigen::AlignedBox3d> boxes_;
  Eigen::AlignedBox3d box_;
};

}  // namespace millfoam::averaging
