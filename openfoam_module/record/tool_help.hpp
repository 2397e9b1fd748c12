// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

namespace millfoam::record {

/// What a tool built on OpenFOAM says of itself.
struct ToolHelp {
  std::string name;                 ///< as the user types it
  std::string purpose;              ///< one sentence, without a full stop
  std::vector<std::string> usage;   ///< lines after the name, without OpenFOAM's own options
  std::vector<std::string> reads;   ///< lines "file  what for"
  std::vector<std::string> writes;  ///< the same
};

/// Answers `--help` and `--version`, which OpenFOAM itself refuses, on `out`. To be asked before OpenFOAM
/// looks at the arguments. Returns whether one of them was there: then there is nothing else to do.
bool told_of_itself(int argc, const char* const* argv, const ToolHelp& help, std::ostream& out);

}  // namespace millfoam::record
