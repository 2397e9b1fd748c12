// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "dem_driver/contact_work.hpp"

namespace millfoam::dem_driver {

/// Three corners, m.
using Triangle = std::array<std::array<double, 3>, 3>;

/// Sums over the contacts of one wall cell in some steps. The forces are those of the balls on the wall, in
/// the frame of the wall files, which turns with a wall that turns.
struct WallCellSums {
  double contacts = 0;               ///< times steps
  double push = 0;                   ///< forces along the contacts' normals, N times steps
  double shear = 0;                  ///< magnitudes of the tangential forces, N times steps
  std::array<double, 3> force = {};  ///< whole forces, N times steps
  double moment = 0;                 ///< of the forces about the axis, N m times steps
  double normal_work = 0;            ///< J
  double tangential_work = 0;        ///< J, of sliding, tangential damping and springs
};

/// The walls of a mill, cut into cells: each triangle of a wall file into n^2 equal ones, so that no edge is
/// longer than wished.
class WallCells {
 public:
  /// One part of the walls.
  struct Part {
    std::string name;                 ///< of its file, without .stl
    std::vector<Triangle> triangles;  ///< in the order of the file
    std::vector<int> divisions;       ///< n of each
    std::vector<std::size_t> first;   ///< the first cell of each
  };
  /// Reads `<folder>/<part>.stl` of each part. Throws std::runtime_error naming a file that cannot be read.
  /// @param folder  of the files
  /// @param parts  their names
  /// @param longest  of the cells' edges, m; a triangle is cut into `most_divisions`^2 cells at most
  WallCells(const std::filesystem::path& folder, const std::vector<std::string>& parts, double longest);
  static constexpr int most_divisions = 32;  ///< largest n
  /// In the order in which they were named.
  const std::vector<Part>& parts() const { return parts_; }
  /// Number of all cells.
  std::size_t size() const { return size_; }
  /// The cell of a point on a triangle; of a point beside it, a cell near by.
  /// @param part, triangle  from 0
  /// @param point  in the frame of the wall files, m
  std::size_t cell_of(std::size_t part, std::size_t triangle, const std::array<double, 3>& point) const;
  /// Corners of all cells of all parts, in order.
  std::vector<Triangle> corners() const;
  /// The part of each cell.
  std::vector<int> part_of_cells() const;

 private:
  std::vector<Part> parts_;
  std::size_t size_ = 0;
};

/// Area, m^2.
double area_of(const Triangle& triangle);

/// Numbers of one cell in `wall_numbers`' rows.
inline constexpr std::size_t numbers_per_wall_cell = 9;

/// Sums of all cells as one row of numbers, for MPI and files.
class WallSums {
 public:
  /// Sums of nothing.
  explicit WallSums(std::size_t cells) : numbers(cells * numbers_per_wall_cell) {}
  /// Adds a contact of one step.
  /// @param cell  its number
  /// @param contact  the force on the ball, in the frame of the wall files
  /// @param moment  of the force on the wall, N m
  /// @param work  of the contact in the step, J
  void add(std::size_t cell, const ContactForce& contact, double moment, const ContactWork& work);
  /// Adds numbers of a cell.
  void add(std::size_t cell, const double* values);
  /// Of one cell.
  WallCellSums of(std::size_t cell) const;
  /// Back to sums of nothing.
  void clear();
  std::vector<double> numbers;  ///< [cells][numbers_per_wall_cell]
};

}  // namespace millfoam::dem_driver
