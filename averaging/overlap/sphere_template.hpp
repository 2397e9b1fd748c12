// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

namespace millfoam::averaging {

/// The points of an n x n x n lattice that lie in the unit sphere; each represents 1/N of a sphere's volume,
/// N being their number. The lattice's coordinates along each axis are (2 i + 1)/n - 1, i = 0 ... n-1.
///
/// Deposited in voxels, a sphere's volume is kept exactly; its places are known to the lattice's spacing.
/// The share below a plane across an axis is wrong by up to half of the points of the layer that the plane
/// meets, 3/(4n) of the sphere's volume in the limit of large n, with no bias over positions:
///
///     n                                        6      8     12     16     24
///     N                                      136    280    912   2176   7208
///     largest error of the share, %         12.4    9.3    6.2    4.9    3.1
///     root mean square over positions, %     5.3    4.0    2.6    2.0    1.3
///
/// Source: Malahe 2012 (template spheres for averaging DEM onto a grid).
class SphereTemplate {
 public:
  /// @param points_per_diameter  n. Throws std::invalid_argument unless it is between 2 and 200.
  explicit SphereTemplate(int points_per_diameter = 12);

  int points_per_diameter() const { return n_; }  ///< n
  int size() const { return size_; }              ///< N

  /// Coordinate of layer i of the lattice, in radii from the sphere's centre.
  double coordinate(int i) const { return (2.0 * i + 1) / n_ - 1; }

  /// Whether the lattice's point (i, j, k) belongs to the template.
  bool contains(int i, int j, int k) const;

  /// Layers [begin, end) of the lattice along one axis.
  struct Layers {
    int begin;  ///< the first, from 0
    int end;    ///< the one after the last, at most n
  };

  /// Number of the template's points in a block of the lattice, without visiting them.
  int count(const Layers& x, const Layers& y, const Layers& z) const;

 private:
  std::size_t corner(int i, int j, int k) const;

  int n_;
  int size_ = 0;
  std::vector<int> below_;  ///< [(n+1)^3] points with each lattice number less than the corner's
};

}  // namespace millfoam::averaging
