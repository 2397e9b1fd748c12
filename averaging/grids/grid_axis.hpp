// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "averaging/grids/box_grid.hpp"
#include "averaging/grids/cylinder_grid.hpp"

namespace millfoam::averaging {

/// Equal steps along a straight axis of a grid, which may repeat without end. Cells beyond its ends are
/// called `outside`.
class GridAxis {
 public:
  /// Means a cell beyond the ends.
  static constexpr int outside = -1;

  /// @param name          for messages
  /// @param lower, upper  ends, m
  /// @param cells         number of steps
  /// @param periodic      whether the axis repeats
  GridAxis(char name, double lower, double upper, int cells, bool periodic)
      : name_(name),
        lower_(lower),
        upper_(upper),
        spacing_((upper - lower) / cells),
        cells_(cells),
        periodic_(periodic) {}

  /// An axis of a box, 0 to 2 for x, y, z.
  static GridAxis of(const BoxGrid& grid, std::size_t axis) {
    return {"xyz"[axis], grid.lower()[axis], grid.upper()[axis], grid.shape()[axis], grid.periodic()[axis]};
  }
  /// The axis of a cylinder.
  static GridAxis along_z(const CylinderGrid& grid) {
    return {'z', grid.ends()[0], grid.ends()[1], grid.shape()[2], grid.periodic_z()};
  }

  /// Cell, or `outside`, at a coordinate, m.
  int cell_at(double coordinate) const;

  /// Cells that a ball meets, from below, with `outside` beyond the ends, and the planes between them.
  /// @param centre  of the ball, m; @param radius  m; @param id  of the ball, for the message
  /// @param cells   overwritten: [met]
  /// @param planes  overwritten: [met - 1] relative to the centre, rising, m
  ///
  /// Throws std::invalid_argument, naming the ball, for one that spans more than 10 000 cells.
  void cut(double centre, double radius, long long id, std::vector<int>& cells,
           std::vector<double>& planes) const;

 private:
  char name_;
  double lower_;
  double upper_;
  double spacing_;
  int cells_;
  bool periodic_;
};

}  // namespace millfoam::averaging
