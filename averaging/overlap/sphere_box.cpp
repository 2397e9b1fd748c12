// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/overlap/sphere_box.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "meshing/surface/pi.hpp"

namespace millfoam::averaging {

namespace {

constexpr double ball = 4 * pi / 3;

double slab(double a) {
  return ball * (a * (3 - a * a) / 2);  // exactly the ball at 1
}

/// J for a, b >= 0, whose slabs are given.
double column(double a, double b, double slab_a, double slab_b) {
  const double w2 = 1 - a * a - b * b;
  if (w2 <= 0) return slab_a + slab_b - ball;
  const double w = std::sqrt(w2);
  return 8.0 / 3 *
         (a * b * w + a * (3 - a * a) / 2 * std::atan2(b, w) + b * (3 - b * b) / 2 * std::atan2(a, w) -
          std::atan2(a * b, w));
}

}  // namespace

void SphereBoxes::cut(const std::array<std::vector<double>, 3>& planes, double radius) {
  assert(radius > 0);
  for (std::size_t axis = 0; axis < 3; ++axis) cut_axis(axis, planes[axis], 1 / radius);
  fill_pairs(axes_[0], axes_[1], xy_);
  fill_pairs(axes_[0], axes_[2], xz_);
  fill_pairs(axes_[1], axes_[2], yz_);
  for (std::vector<double>& corners : corners_) corners.resize(xy_.size());
  volumes_.resize(boxes(0) * boxes(1) * boxes(2));
  fill_corners(0, corners_[1]);
  for (std::size_t k = 0; k < boxes(2); ++k) {
    corners_[0].swap(corners_[1]);
    fill_corners(k + 1, corners_[1]);
    fill_layer(k, radius * radius * radius / 8);
  }
}

void SphereBoxes::cut_axis(std::size_t axis, const std::vector<double>& planes, double scale) {
  std::vector<Plane>& cuts = axes_[axis];
  std::vector<double>& near2 = near2_[axis];
  cuts.resize(planes.size() + 2);
  near2.resize(planes.size() + 1);
  cuts.front() = {-1, 1, -ball};
  cuts.back() = {1, 1, ball};
  for (std::size_t n = 0; n < planes.size(); ++n) {
    const double place = std::clamp(planes[n] * scale, -1.0, 1.0);
    assert(place >= cuts[n].place);
    cuts[n + 1] = {place, std::abs(place), slab(place)};
  }
  for (std::size_t n = 0; n < near2.size(); ++n) {
    const double nearest = std::max({cuts[n].place, -cuts[n + 1].place, 0.0});
    near2[n] = nearest * nearest;
  }
}

void SphereBoxes::fill_pairs(const std::vector<Plane>& first, const std::vector<Plane>& second,
                             std::vector<double>& pairs) {
  const std::size_t n = first.size(), m = second.size();
  pairs.resize(n * m);
  for (std::size_t i = 0; i < n; ++i) {
    pairs[i] = -first[i].slab;
    pairs[(m - 1) * n + i] = first[i].slab;
  }
  for (std::size_t j = 1; j + 1 < m; ++j) {
    const Plane& b = second[j];
    pairs[j * n] = -b.slab;
    pairs[j * n + n - 1] = b.slab;
    for (std::size_t i = 1; i + 1 < n; ++i) {
      const Plane& a = first[i];
      pairs[j * n + i] =
          std::copysign(column(a.size, b.size, std::abs(a.slab), std::abs(b.slab)), a.place * b.place);
    }
  }
}

void SphereBoxes::fill_corners(std::size_t k, std::vector<double>& corners) const {
  const std::size_t nx = axes_[0].size(), ny = axes_[1].size();
  if (k == 0 || k == boxes(2)) {
    for (std::size_t n = 0; n < xy_.size(); ++n) corners[n] = k == 0 ? -xy_[n] : xy_[n];
    return;
  }
  const Plane& c = axes_[2][k];
  for (std::size_t i = 0; i < nx; ++i) {
    corners[i] = -xz_[k * nx + i];
    corners[(ny - 1) * nx + i] = xz_[k * nx + i];
  }
  for (std::size_t j = 1; j + 1 < ny; ++j) {
    const Plane& b = axes_[1][j];
    corners[j * nx] = -yz_[k * ny + j];
    corners[j * nx + nx - 1] = yz_[k * ny + j];
    for (std::size_t i = 1; i + 1 < nx; ++i) {
      const Plane& a = axes_[0][i];
      const double product = a.place * b.place * c.place;
      if (a.size * a.size + b.size * b.size + c.size * c.size < 1) {
        corners[j * nx + i] = 8 * product;
        continue;
      }
      const double pairs = std::abs(xy_[j * nx + i]) + std::abs(xz_[k * nx + i]) + std::abs(yz_[k * ny + j]);
      const double slabs = std::abs(a.slab) + std::abs(b.slab) + std::abs(c.slab);
      corners[j * nx + i] = std::copysign(ball - slabs + pairs, product);
    }
  }
}

void SphereBoxes::fill_layer(std::size_t k, double scale) {
  const std::size_t nx = axes_[0].size();
  const double* below = corners_[0].data();
  const double* above = corners_[1].data();
  double* volume = volumes_.data() + k * boxes(1) * boxes(0);
  for (std::size_t j = 0; j < boxes(1); ++j) {
    const double near2 = near2_[1][j] + near2_[2][k];
    for (std::size_t i = 0; i < boxes(0); ++i, ++volume) {
      const auto row = [&](std::size_t n) { return (above[n + 1] - above[n]) - (below[n + 1] - below[n]); };
      const double part = row((j + 1) * nx + i) - row(j * nx + i);
      *volume = near2_[0][i] + near2 < 1 && part > 0 ? part * scale : 0.0;
    }
  }
}

double sphere_box_volume(const std::array<double, 3>& lower, const std::array<double, 3>& upper,
                         double radius) {
  SphereBoxes boxes;
  boxes.cut({{{lower[0], upper[0]}, {lower[1], upper[1]}, {lower[2], upper[2]}}}, radius);
  return boxes.volumes()[13];  // the middle one of 3 x 3 x 3
}

}  // namespace millfoam::averaging
