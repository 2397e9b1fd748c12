// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace millfoam::averaging {

/// What a column of a dump can hold; also its place in a row of values.
enum Quantity : int {
  quantity_id,
  quantity_position,
  quantity_velocity = quantity_position + 3,
  quantity_radius = quantity_velocity + 3,
  quantity_half_axes,
  quantity_blockiness = quantity_half_axes + 3,
  quantity_quaternion = quantity_blockiness + 2,
  quantities = quantity_quaternion + 4
};

/// The columns of a dump: which are read, and what they mean together.
struct DumpColumns {
  std::string names;                         ///< as in the file, separated by blanks
  std::vector<int> quantity;                 ///< [columns] what each one holds; -1 when it is passed over
  bool scaled = false;                       ///< positions are parts of the box: x = xlo + xs (xhi - xlo)
  bool shapes = false;                       ///< the particles are superquadrics
  std::array<std::string, quantities> name;  ///< of each quantity's column, empty without one
};

/// Finds the columns by their names.
/// @param names  separated by blanks
/// @param place  "file:line: " for messages
///
/// Throws DumpError for a column that is missing or appears twice, for more than one kind of position or a
/// mix of them, and for shapes that are not complete.
DumpColumns find_columns(std::string_view names, const std::string& place);

}  // namespace millfoam::averaging
