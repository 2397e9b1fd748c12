// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "meshing/mill/mill.hpp"
#include "meshing/mill/mill_error.hpp"

namespace millfoam::meshing {

class MillDocument;

/// A mill and what it was read from.
struct MillDescription {
  Mill mill;                                     ///< in SI units
  std::shared_ptr<const MillDocument> document;  ///< its keys as they were read
};

/// Reads and checks a mill description. Every key is documented in meshing/README.md. The paths of variants
/// that are not used are checked too.
/// @param file  mill.yaml, or a resolved mill (mill.json)
/// @param set   changes "path=value" (MillDocument)
/// Throws MillError for a file that cannot be read, a missing or unknown key, a value of the wrong kind, or
/// one that is impossible (negative size, lifter longer than the radius, …).
MillDescription describe_mill(const std::filesystem::path& file, const std::vector<std::string>& set = {});

/// The mill alone.
Mill read_mill(const std::filesystem::path& file, const std::vector<std::string>& set = {});

}  // namespace millfoam::meshing
