// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

namespace millfoam::meshing {

/// A polygon in space: point indices around it. One that is not flat is measured as the fan of triangles
/// about the mean of its points, as OpenFOAM does.
using Face = std::vector<int>;

/// Coordinates of points, m.
using Points = std::vector<Eigen::Vector3d>;

/// The number of a point, a face or a cell, which is not negative, as an index.
inline std::size_t index(int number) {
  return static_cast<std::size_t>(number);
}

/// The mean of a face's points, m.
Eigen::Vector3d middle(const Points& points, const Face& face);

/// The area of a face along its normal, right-handed about its points, m^2.
Eigen::Vector3d area_vector(const Points& points, const Face& face);

/// Signed volume of the pyramid between a face and an apex, m^3; positive where the normal points away from
/// the apex. Over a closed surface the sum is what it encloses.
double pyramid_volume(const Points& points, const Face& face, const Eigen::Vector3d& apex);

/// Signed solid angle under which a face is seen, sr; positive from the side that its normal points away
/// from. Over a closed surface the sum is 4 pi from inside and 0 from outside. A. Van Oosterom and
/// J. Strackee, IEEE Trans. Biomed. Eng. 30 (1983) 125.
double solid_angle(const Points& points, const Face& face, const Eigen::Vector3d& from);

/// Whether two sides of a face, seen along its normal, cross.
bool crosses_itself(const Points& points, const Face& face);

/// Triangles that fill a face within its sides, concave or not; fewer than usual where it has no area or
/// crosses itself.
std::vector<std::array<int, 3>> triangles_of(const Points& points, const Face& face);

}  // namespace millfoam::meshing
