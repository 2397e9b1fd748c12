// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

namespace millfoam::record {

/// The help of a tool that is built on OpenFOAM.
struct ToolHelp {
  std::string name;                 ///< as the user types it
  std::string purpose;              ///< one sentence, without a full stop
  std::vector<std::string> usage;   ///< lines after the name, without OpenFOAM's own options
  std::vector<std::string> reads;   ///< lines "file  what for"
  std::vector<std::string> writes;  ///< the same
};

/// Prints the answer to `--help` or `--version`, which OpenFOAM itself refuses, on `out`. Call it before
/// OpenFOAM reads the arguments. Returns whether one of them was there: then there is nothing else to do.
bool printed_help_or_version(int argc, const char* const* argv, const ToolHelp& help, std::ostream& out);

}  // namespace millfoam::record
