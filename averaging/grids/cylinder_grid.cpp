// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/grids/cylinder_grid.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "averaging/grids/cylindrical.hpp"
#include "meshing/surface/pi.hpp"

namespace millfoam::averaging {

namespace {

[[noreturn]] void refuse_range(const char* what, const std::array<double, 2>& range, const char* expected) {
  std::ostringstream message;
  message << "cylinder: " << what << " go from " << range[0] << " to " << range[1] << " m; expected "
          << expected;
  throw std::invalid_argument(message.str());
}

bool rising(const std::array<double, 2>& range) {
  return std::isfinite(range[0]) && std::isfinite(range[1]) && range[1] > range[0];
}

void check(const std::array<double, 2>& radii, const std::array<double, 2>& ends, const VoxelIndex& shape) {
  if (!rising(radii) || radii[0] < 0) {
    refuse_range("the radii", radii, "finite numbers, the first 0 or more and the second above it");
  }
  if (!rising(ends)) refuse_range("the ends", ends, "finite numbers, the second above the first");
  for (std::size_t a = 0; a < 3; ++a) {
    if (shape[a] >= 1) continue;
    constexpr std::array<const char*, 3> names{"r", "theta", "z"};
    std::ostringstream message;
    message << "cylinder: shape along " << names[a] << " is " << shape[a] << "; expected at least 1 voxel";
    throw std::invalid_argument(message.str());
  }
}

void check(const CylinderFrame& frame) {
  if (!frame.angular_velocity) return;
  if (!frame.cylindrical) {
    throw std::invalid_argument(
        "cylinder: it turns, and its velocities are along x, y and z; expected cylindrical ones");
  }
  if (std::isfinite(*frame.angular_velocity)) return;
  throw std::invalid_argument("cylinder: its angular velocity is " + std::to_string(*frame.angular_velocity) +
                              "; expected a finite number, rad/s");
}

/// Number of the step that holds a place between 0 and the last step's end; rounding may put one at the end
/// into the step after the last.
int step(double place, double spacing, int steps) {
  return std::min(static_cast<int>(place / spacing), steps - 1);
}

}  // namespace

CylinderGrid::CylinderGrid(const std::array<double, 2>& radii, const std::array<double, 2>& ends,
                           const VoxelIndex& shape, bool periodic_z, const CylinderFrame& frame)
    : radii_(radii), ends_(ends), shape_(shape), periodic_z_(periodic_z), frame_(frame) {
  check(radii, ends, shape);
  check(frame);
  spacing_ = {(radii[1] - radii[0]) / shape[0], 2 * pi / shape[1], (ends[1] - ends[0]) / shape[2]};
}

std::size_t CylinderGrid::size() const {
  return static_cast<std::size_t>(shape_[0]) * static_cast<std::size_t>(shape_[1]) *
         static_cast<std::size_t>(shape_[2]);
}

double CylinderGrid::voxel_volume(const VoxelIndex& voxel) const {
  const double middle = radii_[0] + (voxel[0] + 0.5) * spacing_[0];
  return middle * spacing_[0] * spacing_[1] * spacing_[2];
}

std::size_t CylinderGrid::offset(const VoxelIndex& voxel) const {
  const auto [i, j, k] = voxel;
  const auto n = static_cast<std::size_t>(shape_[0]), m = static_cast<std::size_t>(shape_[1]);
  return (static_cast<std::size_t>(k) * m + static_cast<std::size_t>(j)) * n + static_cast<std::size_t>(i);
}

Vector3 CylinderGrid::centre(const VoxelIndex& voxel) const {
  const double radius = radii_[0] + (voxel[0] + 0.5) * spacing_[0];
  const double theta = (voxel[1] + 0.5) * spacing_[1];
  return {radius * std::cos(theta), radius * std::sin(theta), ends_[0] + (voxel[2] + 0.5) * spacing_[2]};
}

Vector3 CylinderGrid::in_own_frame(const Vector3& point, double time) const {
  return frame_.angular_velocity ? turned(point, -*frame_.angular_velocity * time) : point;
}

Vector3 CylinderGrid::wrapped(const Vector3& point) const {
  if (!periodic_z_ || (point[2] >= ends_[0] && point[2] < ends_[1])) return point;
  const double period = ends_[1] - ends_[0];
  const double z = point[2] - period * std::floor((point[2] - ends_[0]) / period);
  // Rounding can put the image of a point just below the lower end onto the upper one, which is its image.
  return {point[0], point[1], z >= ends_[0] && z < ends_[1] ? z : ends_[0]};
}

std::optional<VoxelIndex> CylinderGrid::locate(const Vector3& point) const {
  const Vector3 image = wrapped(point);
  const double radius = std::hypot(image[0], image[1]);
  if (!(radius >= radii_[0] && radius < radii_[1] && image[2] >= ends_[0] && image[2] < ends_[1])) {
    return std::nullopt;
  }
  const double angle = std::atan2(image[1], image[0]);
  return VoxelIndex{step(radius - radii_[0], spacing_[0], shape_[0]),
                    step(angle < 0 ? angle + 2 * pi : angle, spacing_[1], shape_[1]),
                    step(image[2] - ends_[0], spacing_[2], shape_[2])};
}

}  // namespace millfoam::averaging
