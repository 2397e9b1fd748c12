// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <yaml-cpp/yaml.h>

#include <string>

namespace millfoam::meshing {

/// The keys of a mill.yaml, or of a mill.json, as its text has them, with a copy for each use of an alias.
/// Throws MillError naming file and line for a text that is not UTF-8, has tabs where YAML allows none, is no
/// YAML, empty, several documents, no map, or more than can be written out.
/// @param file   name of the file, for messages
/// @param bytes  that the file holds
YAML::Node load_mill_text(const std::string& file, const std::string& bytes);

}  // namespace millfoam::meshing
