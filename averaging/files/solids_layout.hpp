// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "averaging/files/solids_file.hpp"

/// Names, units and homes of what solids.h5 holds: the one place that the writer, the reader and the .xdmf
/// share.
namespace millfoam::averaging::layout {

/// The attribute `format`.
inline constexpr const char* format = "millfoam-solids";

/// A data set over windows and cells: [window][z][y][x] on a box, [window][cell] on a mesh, see
/// `field_shape`; of vectors with [3] behind.
struct Field {
  const char* name;   ///< of the data set
  const char* units;  ///< its attribute `units`
  bool vector;        ///< three components per cell
  /// Where a window keeps it, [cells] or [cells][3].
  const std::vector<double>& (*of)(const WindowAverage&);
};

/// A field of a window, [cells] or [cells][3].
using Values = std::vector<double>;

/// The data sets over windows and cells, in the order of the file.
inline constexpr std::array<Field, 8> fields{{
    {"solidity", "1", false, [](const WindowAverage& w) -> const Values& { return w.mean.solidity; }},
    {"velocity", "m/s", true, [](const WindowAverage& w) -> const Values& { return w.mean.velocity; }},
    {"diameter", "m", false, [](const WindowAverage& w) -> const Values& { return w.mean.diameter; }},
    {"diameter43", "m", false, [](const WindowAverage& w) -> const Values& { return w.mean.diameter43; }},
    {"number", "1", false, [](const WindowAverage& w) -> const Values& { return w.number; }},
    {"solidity_deviation", "1", false,
     [](const WindowAverage& w) -> const Values& { return w.solidity_deviation; }},
    {"velocity_deviation", "m/s", true,
     [](const WindowAverage& w) -> const Values& { return w.velocity_deviation; }},
    {"granular_temperature", "m2/s2", false,
     [](const WindowAverage& w) -> const Values& { return w.granular_temperature; }},
}};

/// A data set [window][z][y][x] in /grid, there only where walls cut the cells.
inline constexpr Field inside_fraction{
    "insideFraction", "1", false,
    [](const WindowAverage& w) -> const Values& { return w.mean.inside_fraction; }};

/// A column of /ledger, m^3.
struct LedgerColumn {
  const char* name;       ///< of the data set
  double Ledger::*value;  ///< where a ledger keeps it
};

/// The columns of /ledger, in the order of the file.
inline constexpr std::array<LedgerColumn, 4> ledger{{{"volume_in", &Ledger::volume_in},
                                                     {"deposited", &Ledger::deposited},
                                                     {"outside", &Ledger::outside},
                                                     {"clipped", &Ledger::clipped}}};

}  // namespace millfoam::averaging::layout
