// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

namespace millfoam::averaging {

/// Closed-form areas of discs about one centre in the cells of a polar grid, between circles about the origin
/// and rays from it.
///
/// By Green's theorem the area in a cell is half the sum over the pieces of its outline of the integral of
/// (x dy - y dx), taken about the disc's centre, at the distance D from the origin on the ray phi = 0:
///
///     the disc's own edge, angle psi about its centre    rho^2 dpsi
///     a ray at phi, length s outwards                    -D sin(phi) ds
///     a circle of radius r                               r (r - D) dphi + D r (dphi - d sin(phi))
///
/// Neighbours run along a common piece in opposite senses, so the areas add up to the disc's. The two last
/// ones are small where D and r are large compared with rho, which keeps small discs far from the origin
/// exact.
/// An object serves one thread.
class DiscCells {
 public:
  /// Places the centre; the cells' pieces that discs of up to `reach` do not meet may be left out.
  /// @param distance  D, m
  /// @param circles   radii, rising, positive, m
  /// @param rays      phi, rising, in (-pi, pi]; all rays of the grid where reach > D
  void place(double distance, const std::vector<double>& circles, const std::vector<double>& rays);

  std::size_t rings() const { return circles_.size() + 1; }  ///< within the first circle ... beyond the last
  std::size_t sectors() const { return rays_.size() + 1; }   ///< the first and the last meet at phi = pi

  /// Areas of the disc of radius `rho` in the cells, [ring][sector], m^2; overwritten.
  void areas(double rho, std::vector<double>& result);

 private:
  struct Circle {
    double radius;
    double beyond;  ///< radius - D
  };
  struct Ray {
    double angle;   ///< phi
    double offset;  ///< D sin(phi): distance from the centre
    double foot;    ///< of the perpendicular from the centre: distance from the origin less D
    bool ahead;     ///< whether that foot lies on the ray
  };
  /// Where the disc's edge enters another ring or sector, anticlockwise.
  struct Crossing {
    double angle;  ///< psi
    int ring;      ///< step of the ring's number
    int sector;    ///< step of the sector's
  };

  void add_circles(double rho, std::vector<double>& result);
  void add_circle(std::size_t n, double reach, std::vector<double>& result) const;
  void add_rays(double rho, std::vector<double>& result);
  void add_edge(double rho, std::vector<double>& result);

  double distance_ = 0;
  std::vector<Circle> circles_;
  std::vector<Ray> rays_;
  std::size_t ahead_ = 0;  ///< sector of phi = 0
  std::vector<Crossing> crossings_;
};

}  // namespace millfoam::averaging
