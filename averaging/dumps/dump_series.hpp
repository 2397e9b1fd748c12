// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "averaging/dumps/dump_header.hpp"

namespace millfoam::averaging {

/// One dump of a series.
struct DumpFile {
  std::filesystem::path path;  ///< as the pattern gives it
  long long step = 0;          ///< DEM time-step in its header
  /// Number of particles in its header; nothing where that is damaged.
  std::optional<long long> count;
};

/// Reads the part of a file, plain or gzip, before its particles. Throws DumpError as `read_header`, and as
/// `DumpInput`.
DumpHeader read_dump_header(const std::filesystem::path& file);

/// The dumps that a pattern matches (glob(3): * ? [ ] {a,b} and ~), in order of their time-steps, read from
/// their headers. Throws DumpError when none matches, a header cannot be read, or two have the same
/// time-step.
std::vector<DumpFile> find_dumps(const std::string& pattern);

}  // namespace millfoam::averaging
