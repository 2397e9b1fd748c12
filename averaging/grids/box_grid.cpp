// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/grids/box_grid.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace millfoam::averaging {

namespace {

void check_axis(char axis, double lower, double upper, int shape) {
  std::ostringstream message;
  if (!std::isfinite(lower) || !std::isfinite(upper) || !(upper > lower)) {
    message << "box: along " << axis << " it goes from " << lower << " to " << upper
            << " m; expected finite numbers, the second above the first";
  } else if (shape < 1) {
    message << "box: shape along " << axis << " is " << shape << "; expected at least 1 voxel";
  }
  if (!message.str().empty()) throw std::invalid_argument(message.str());
}

}  // namespace

BoxGrid::BoxGrid(const Vector3& lower, const Vector3& upper, const VoxelIndex& shape,
                 const std::array<bool, 3>& periodic)
    : lower_(lower), upper_(upper), shape_(shape), periodic_(periodic) {
  for (std::size_t a = 0; a < 3; ++a) {
    check_axis("xyz"[a], lower[a], upper[a], shape[a]);
    spacing_[a] = (upper[a] - lower[a]) / shape[a];
  }
}

std::size_t BoxGrid::size() const {
  return static_cast<std::size_t>(shape_[0]) * static_cast<std::size_t>(shape_[1]) *
         static_cast<std::size_t>(shape_[2]);
}

double BoxGrid::voxel_volume() const {
  return spacing_[0] * spacing_[1] * spacing_[2];
}

std::size_t BoxGrid::offset(const VoxelIndex& voxel) const {
  for (std::size_t a = 0; a < 3; ++a) assert(voxel[a] >= 0 && voxel[a] < shape_[a]);
  const auto nx = static_cast<std::size_t>(shape_[0]);
  const auto ny = static_cast<std::size_t>(shape_[1]);
  const auto [i, j, k] = voxel;
  return (static_cast<std::size_t>(k) * ny + static_cast<std::size_t>(j)) * nx + static_cast<std::size_t>(i);
}

Vector3 BoxGrid::centre(const VoxelIndex& voxel) const {
  Vector3 point{};
  for (std::size_t a = 0; a < 3; ++a) point[a] = lower_[a] + (voxel[a] + 0.5) * spacing_[a];
  return point;
}

Vector3 BoxGrid::wrapped(const Vector3& point) const {
  Vector3 image = point;
  for (std::size_t a = 0; a < 3; ++a) {
    if (!periodic_[a] || (point[a] >= lower_[a] && point[a] < upper_[a])) continue;
    const double period = upper_[a] - lower_[a];
    image[a] = point[a] - period * std::floor((point[a] - lower_[a]) / period);
    // Rounding can put the image of a point just below `lower` onto `upper`, which is the image of `lower`.
    if (image[a] < lower_[a] || image[a] >= upper_[a]) image[a] = lower_[a];
  }
  return image;
}

std::optional<VoxelIndex> BoxGrid::locate(const Vector3& point) const {
  const Vector3 image = wrapped(point);
  VoxelIndex voxel{};
  for (std::size_t a = 0; a < 3; ++a) {
    if (!(image[a] >= lower_[a] && image[a] < upper_[a])) return std::nullopt;
    // A point just below `upper` may round up to the voxel after the last.
    voxel[a] = std::min(static_cast<int>((image[a] - lower_[a]) / spacing_[a]), shape_[a] - 1);
  }
  return voxel;
}

}  // namespace millfoam::averaging
