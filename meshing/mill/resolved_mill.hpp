// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "meshing/mill/mill_reader.hpp"

namespace millfoam::meshing {

/// The resolved mill: every key with its value, defaults filled in; derived numbers with units in their
/// names; fingerprints. It can be read again as a mill description and gives the same mill. Layout:
/// FORMATS.md.
/// @param description  the mill as its file gives it
/// @param program  that writes it, "millMesh"
nlohmann::ordered_json resolved_mill(const MillDescription& description, const std::string& program);

/// Name of the resolved mill in a case's folder.
inline constexpr const char* resolved_mill_name = "mill.json";

/// Writes the resolved mill; "-" is the standard output. Throws std::runtime_error where it cannot.
void write_resolved_mill(const MillDescription& description, const std::string& program,
                         const std::filesystem::path& file);

/// A result's head: its format, the program with its version, and the fingerprints that it belongs to.
nlohmann::ordered_json result_head(const std::string& format, const std::string& program,
                                   const nlohmann::ordered_json& mill);

}  // namespace millfoam::meshing
