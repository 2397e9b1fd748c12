// SPDX-License-Identifier: GPL-3.0-or-later
#include "openfoam_module/record/tool_help.hpp"

#include <algorithm>
#include <ostream>

#include "millfoam_version.hpp"

namespace millfoam::record {

namespace {

void print_lines(std::ostream& out, const char* title, const std::vector<std::string>& lines) {
  if (lines.empty()) return;
  out << '\n' << title << '\n';
  for (const std::string& line : lines) out << "  " << line << '\n';
}

void print_help(const ToolHelp& help, std::ostream& out) {
  out << help.purpose << ".\n\n";
  for (const std::string& line : help.usage) out << "Usage: " << help.name << ' ' << line << '\n';
  print_lines(out, "Reads:", help.reads);
  print_lines(out, "Writes:", help.writes);
  print_lines(out, "Options:",
              {"--help     this text", "--version  version of millFoam that the tool was built from",
               "-help      all options, with OpenFOAM's own"});
}

}  // namespace

bool printed_help_or_version(int argc, const char* const* argv, const ToolHelp& help, std::ostream& out) {
  const auto asked = [&](const char* option) {
    return std::any_of(argv + 1, argv + std::max(argc, 1),
                       [&](const std::string& word) { return word == option; });
  };
  if (asked("--help")) {
    print_help(help, out);
    return true;
  }
  if (asked("--version")) {
    out << help.name << ' ' << version() << '\n';
    return true;
  }
  return false;
}

}  // namespace millfoam::record
