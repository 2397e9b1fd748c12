// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "meshing/mill/mill.hpp"
#include "meshing/mill_mesh/stirred_divisions.hpp"

namespace millfoam::meshing {

/// The rings of cells about a stirred mill's shaft: where their points are, and which cells the impeller
/// takes. A cell lies between two lines in each direction: radii (`ring`), columns around the axis, and
/// heights
/// (`row`); it has the number of the first of both.
class StirredGrid {
 public:
  /// `geometry`, which has an impeller, must outlive the grid; `cell_size` as of stirred_divisions, m.
  StirredGrid(const Geometry& geometry, double cell_size);

  const StirredDivisions& lines() const { return lines_; }                  ///< of the cells
  int rings() const { return static_cast<int>(lines_.radii.size()) - 1; }   ///< number of cells
  int rows() const { return static_cast<int>(lines_.heights.size()) - 1; }  ///< number of cells
  int around() const { return lines_.around; }                              ///< number of columns

  /// The point at which three lines meet, m.
  Eigen::Vector3d place(int ring, int column, int row) const;

  /// Whether the impeller takes a cell.
  bool is_solid(int ring, int column, int row) const;

 private:
  /// An arm of the impeller on the grid.
  struct Arm {
    std::size_t level;  ///< number of its level
    double angle;       ///< rad, of its axis
    int column;         ///< number of the line at its axis, between 0 and `around`
  };

  /// A point in cylindrical coordinates about the axis: rad, m, m.
  struct Place {
    double angle;
    double radius;
    double z;
  };

  const PinLevel& level_of(const Arm& arm) const { return impeller_.pins[arm.level]; }
  void add_arm(std::size_t level, int number);
  double half_angle(std::size_t level, double radius) const;
  double shift(std::size_t level, int column, double radius) const;
  double share_of(std::size_t level, double radius, double z) const;
  double angle_of(int column, double radius, double z) const;
  std::pair<double, double> space_of(std::size_t level) const;
  double roundness(std::size_t level, int ring) const;
  Place rounded(const Arm& arm, int ring, const Place& at) const;

  const Geometry& geometry_;
  const Impeller& impeller_;
  StirredDivisions lines_;
  std::vector<Arm> arms_;
};

}  // namespace millfoam::meshing
