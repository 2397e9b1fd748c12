// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace millfoam::averaging {

/// Exact volumes of the boxes into which planes across the axes cut a sphere.
///
/// With s_a = sgn(a - x), s_b and s_c of the planes y = b and z = c, and the unit ball about the origin, the
/// box between two planes per axis has the volume
///
///     1/8 of the mixed difference over its corners of I(a, b, c) = integral of s_a s_b s_c over the ball.
///
/// I is odd in each argument, and by reflection it is, for a, b, c >= 0, the volume of the ball in |x| < a,
/// |y| < b, |z| < c, which has a closed form. A plane that leaves the ball on one side counts as one at 1;
/// then, with V = 4 pi/3,
///
///     K(a)       = I(a, 1, 1) = 2 pi (a - a^3/3)
///     J(a, b)    = I(a, b, 1) = 8/3 (a b w + a (3 - a^2)/2 atan(b/w) + b (3 - b^2)/2 atan(a/w) - atan(a
///     b/w))
///                               with w = sqrt(1 - a^2 - b^2), when the edge meets the ball,
///                             = K(a) + K(b) - V otherwise: nothing of the ball lies beyond both planes
///     I(a, b, c) = 8 a b c when the corner lies in the ball,
///                = V - K(a) - K(b) - K(c) + J(a, b) + J(b, c) + J(c, a) otherwise, for the same reason.
///
/// So one corner costs no transcendental function and one edge three. The volumes' error is a few roundings
/// of the sphere's volume, and they add up to it. Results hold until the next cut; an object serves one
/// thread.
class SphereBoxes {
 public:
  /// Cuts a sphere.
  /// @param planes  along x, y, z: their coordinates relative to the centre, rising, m; they need not all
  /// meet
  ///                the sphere
  /// @param radius  m, positive
  void cut(const std::array<std::vector<double>, 3>& planes, double radius);

  /// Number of boxes along an axis: one more than planes, the first and the last being open.
  std::size_t boxes(std::size_t axis) const { return axes_[axis].size() - 1; }

  /// Volumes of the sphere in the boxes, [z][y][x], m^3, none negative; exactly 0 where box and sphere do not
  /// meet.
  const std::vector<double>& volumes() const { return volumes_; }

 private:
  /// A plane in units of the radius.
  struct Plane {
    double place;  ///< from -1 to 1
    double size;   ///< of the place
    double slab;   ///< K
  };

  static void fill_pairs(const std::vector<Plane>& first, const std::vector<Plane>& second,
                         std::vector<double>& pairs);
  void cut_axis(std::size_t axis, const std::vector<double>& planes, double scale);
  void fill_corners(std::size_t k, std::vector<double>& corners) const;
  void fill_layer(std::size_t k, double scale);

  std::array<std::vector<Plane>, 3> axes_;
  std::array<std::vector<double>, 3> near2_;    ///< [box] squared distance from the centre along the axis
  std::vector<double> xy_, xz_, yz_;            ///< [second][first] J of two planes
  std::array<std::vector<double>, 2> corners_;  ///< [y][x] I on the planes below and above a layer of boxes
  std::vector<double> volumes_;
};

/// Volume, m^3, of a sphere about the origin in a box whose corners, m, are given relative to its centre.
double sphere_box_volume(const std::array<double, 3>& lower, const std::array<double, 3>& upper,
                         double radius);

}  // namespace millfoam::averaging
