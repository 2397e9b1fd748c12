// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/grids/grid_axis.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace millfoam::averaging {

namespace {

constexpr double most_cells = 10000;

/// As std::floor, of which the plain x86-64 has no instruction.
int whole_below(double value) {
  const int whole = static_cast<int>(value);
  return whole > value ? whole - 1 : whole;
}

}  // namespace

int GridAxis::cell_at(double coordinate) const {
  double place = std::floor((coordinate - lower_) / spacing_);
  if (periodic_) {
    place -= cells_ * std::floor(place / cells_);
  } else if (!(coordinate >= lower_ && coordinate < upper_)) {
    return outside;
  }
  // Rounding can put a point just below the upper end into the cell after the last; an absurd size gives no
  // number.
  return place > 0 ? static_cast<int>(std::min(place, cells_ - 1.0)) : 0;
}

void GridAxis::cut(double centre, double radius, long long id, std::vector<int>& cells,
                   std::vector<double>& planes) const {
  double first = (centre - radius - lower_) / spacing_, last = (centre + radius - lower_) / spacing_;
  if (!periodic_) {
    first = std::clamp(first, -0.5, cells_ + 0.5);
    last = std::clamp(last, -0.5, cells_ + 0.5);
  }
  if (!(last - first < most_cells)) {
    std::ostringstream message;
    message << "ball " << id << ": its radius of " << radius << " m spans more than " << most_cells
            << " cells along " << name_ << ", of " << spacing_ << " m each";
    throw std::invalid_argument(message.str());
  }
  const int begin = whole_below(first), end = whole_below(last) + 1;
  cells.clear();
  planes.clear();
  for (int n = begin; n < end; ++n) {
    if (n > begin) planes.push_back(lower_ + n * spacing_ - centre);
    const int image = !periodic_ || (n >= 0 && n < cells_) ? n : (n % cells_ + cells_) % cells_;
    cells.push_back(image < cells_ ? image : outside);
  }
}

}  // namespace millfoam::averaging
