// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <string>

#include "averaging/dumps/dump_error.hpp"
#include "averaging/dumps/text_lines.hpp"

namespace millfoam::averaging {

/// The box of a dump.
struct DumpBox {
  std::array<double, 3> lower{},  ///< least x, y, z, m
      upper{};                    ///< largest x, y, z, m
  bool tilted = false;            ///< not along x, y and z
  /// Of its two ends along x, y and z, out of the item's name: `pp` where the balls repeat, `ff`, …; empty
  /// where the name has none.
  std::array<std::string, 3> flags{};
  /// Whether the balls are known to repeat along x, y and z.
  std::array<bool, 3> periodic() const { return {flags[0] == "pp", flags[1] == "pp", flags[2] == "pp"}; }
};

/// The part of a dump before its particles.
struct DumpHeader {
  std::optional<long long> step;   ///< DEM time-step
  std::optional<long long> count;  ///< of particles
  std::optional<DumpBox> box;      ///< nothing when the dump names none
  std::string columns;             ///< names, separated by blanks
};

/// Reads up to and with the line 'ITEM: ATOMS ...'. Items of other names are passed over. Throws DumpError
/// for text that is not a dump, an item that appears twice, an impossible value, units other than si, or a
/// missing time-step or number of atoms.
DumpHeader read_header(TextLines& lines);

/// Reads as far as the time-step only. Throws DumpError as `read_header`.
long long read_step(TextLines& lines);

/// Reads on from there to the number of particles; nothing where the text does not give it.
std::optional<long long> read_count(TextLines& lines);

/// The error that the text stops before what was expected.
DumpError truncated(TextLines& lines, const std::string& expected);

}  // namespace millfoam::averaging
