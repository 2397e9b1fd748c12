// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>

namespace millfoam::meshing {

/// Adds the subcommands that turn faces into meshes and back: `assemble` and `faces`.
void add_polygon_commands(CLI::App& app);

}  // namespace millfoam::meshing
