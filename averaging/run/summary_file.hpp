// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "averaging/run/solids_summary.hpp"

namespace millfoam::averaging {

/// The name of the summary of a solids file: NAME.json for NAME.h5. Throws SolidsFileError when the solids
/// file itself has this name.
std::filesystem::path summary_path(const std::filesystem::path& solids_file);

/// Throws SolidsFileError when there is something at `path` that is no summary of a solids file.
void require_summary_or_nothing(const std::filesystem::path& path);

/// The run of whose averages a summary is (`run_id`); empty where that is not known, or where the file is no
/// whole summary.
std::string run_of_summary(const std::filesystem::path& path);

/// The summary as JSON, see FORMATS.md: what `report` prints, as numbers with units in their keys.
/// What is not known is null.
/// @param summary  of a solids file
/// @param writer  the program that writes it, with its version
std::string as_json(const SolidsSummary& summary, const std::string& writer);

/// Writes that into a file, replacing an older one only when it is complete. Throws SolidsFileError.
void write_summary(const std::filesystem::path& path, const SolidsSummary& summary,
                   const std::string& writer);

}  // namespace millfoam::averaging
