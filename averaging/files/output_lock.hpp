// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "averaging/files/file_lock.hpp"

namespace millfoam::averaging {

/// Throws SolidsFileError when there is something at `path` that is no solids file, so that no other file is
/// lost to a name typed wrong. A solids file of any version, whole or not, may be replaced.
void require_solids_or_nothing(const std::filesystem::path& path);

/// Locks `output` + ".lock", which is there only meanwhile, so that two runs cannot write one solids file.
/// Throws SolidsFileError when another process has the lock, and std::runtime_error when that file cannot be
/// written.
FileLock lock_output(const std::filesystem::path& output);

}  // namespace millfoam::averaging
