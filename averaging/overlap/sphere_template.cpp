// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/overlap/sphere_template.hpp"

#include <stdexcept>
#include <string>

namespace millfoam::averaging {

SphereTemplate::SphereTemplate(int points_per_diameter) : n_(points_per_diameter) {
  if (n_ < 2 || n_ > 200) {
    throw std::invalid_argument("the template has " + std::to_string(n_) +
                                " points along a diameter, expected 2 to 200");
  }
  const auto corners = static_cast<std::size_t>(n_) + 1;
  below_.assign(corners * corners * corners, 0);
  for (int k = 0; k < n_; ++k) {
    for (int j = 0; j < n_; ++j) {
      for (int i = 0; i < n_; ++i) {
        // A summed-volume table: each corner's number out of those of its seven lower neighbours.
        const auto at = [&](int di, int dj, int dk) { return below_[corner(i + di, j + dj, k + dk)]; };
        below_[corner(i + 1, j + 1, k + 1)] = (contains(i, j, k) ? 1 : 0) + at(0, 1, 1) + at(1, 0, 1) +
                                              at(1, 1, 0) - at(0, 0, 1) - at(0, 1, 0) - at(1, 0, 0) +
                                              at(0, 0, 0);
      }
    }
  }
  size_ = below_.back();
}

bool SphereTemplate::contains(int i, int j, int k) const {
  // In units of 1/n, so that points on the surface are decided in whole numbers.
  const auto squared = [this](int layer) { return (2 * layer + 1 - n_) * (2 * layer + 1 - n_); };
  return squared(i) + squared(j) + squared(k) <= n_ * n_;
}

int SphereTemplate::count(const Layers& x, const Layers& y, const Layers& z) const {
  const auto up_to = [&](int k) {
    return below_[corner(x.end, y.end, k)] - below_[corner(x.begin, y.end, k)] -
           below_[corner(x.end, y.begin, k)] + below_[corner(x.begin, y.begin, k)];
  };
  return up_to(z.end) - up_to(z.begin);
}

std::size_t SphereTemplate::corner(int i, int j, int k) const {
  const auto corners = static_cast<std::size_t>(n_) + 1;
  return (static_cast<std::size_t>(k) * corners + static_cast<std::size_t>(j)) * corners +
         static_cast<std::size_t>(i);
}

}  // namespace millfoam::averaging
