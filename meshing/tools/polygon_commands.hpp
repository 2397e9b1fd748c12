// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>

namespace millfoam::meshing {

/// Adds the subcommands for geometry of other programs: `assemble` (polygons), `surface` (STL), and `faces`,
/// which writes polygons.
void add_polygon_commands(CLI::App& app);

}  // namespace millfoam::meshing
