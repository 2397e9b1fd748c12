// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "meshing/files/output_file.hpp"
#include "meshing/mill/mill_document.hpp"
#include "meshing/mill/mill_error.hpp"
#include "meshing/mill/mill_reader.hpp"
#include "meshing/mill/resolved_mill.hpp"
#include "millfoam_version.hpp"

namespace millfoam::meshing {

/// What every tool that reads a mill takes.
struct MillOptions {
  std::string file;              ///< mill.yaml, or a resolved mill.json
  std::vector<std::string> set;  ///< changes "path=value"
  std::string resolved;          ///< file that receives the resolved mill; empty: none is requested

  MillDescription read() const { return describe_mill(file, set); }
};

/// Adds the mill (a positional), `--set` and `--resolved`. The tool writes the resolved mill and stops where
/// `--resolved` is given.
inline CLI::Option* add_mill_options(CLI::App& app, MillOptions& options) {
  auto* mill =
      app.add_option("mill", options.file, "the mill's description, mill.yaml (or a resolved mill.json)");
  app.add_option("--set", options.set,
                 "PATH=VALUE in the place of a key of the mill, as in flow.law=Hill; ~ removes the key; may "
                 "be given again")
      ->expected(1)
      ->take_all()
      ->type_name("PATH=VALUE");
  app.add_option(
         "--resolved", options.resolved,
         "write the mill with every default and derived number to this file (- : standard output) and stop")
      ->type_name("FILE");
  return mill;
}

/// Runs `action`. A key of the mill of which it can make nothing is named with its place in the file.
template <typename Action>
void naming_place(const MillDescription& description, Action&& action) {
  try {
    action();
  } catch (const KeyError& error) {
    throw MillError(description.document->place(error.key()) + ": " + error.what());
  }
}

/// Runs `action`. Where it cannot make one of its folders or files, throws std::runtime_error that names the
/// place, and in the case's folder the option.
/// @param folder  of `--case`; empty: not given
template <typename Action>
void naming_case(const std::string& folder, Action&& action) {
  const auto named = [&](const std::string& sentence) {
    const bool of_case = !folder.empty() && sentence.rfind(folder, 0) == 0;
    return std::runtime_error((of_case ? "--case " + folder + ": " : "") + sentence);
  };
  try {
    action();
  } catch (const FolderError& error) {
    throw named(error.what());
  } catch (const std::filesystem::filesystem_error& error) {
    throw named(error.path1().string() + ": cannot be made or used: " + error.code().message());
  }
}

/// Adds `--version`, "<tool> <version>".
inline void add_version(CLI::App& app, const std::string& tool) {
  app.set_version_flag("--version", tool + " " + version());
}

}  // namespace millfoam::meshing
