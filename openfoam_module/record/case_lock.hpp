// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "averaging/files/file_lock.hpp"

namespace millfoam::record {

/// Locks a case, so that one flow at a time writes there.
/// @param folder  of the case; its file postProcessing/flow/.lock is locked
/// @param program  name of the program, for the message of another one that finds the case locked
///
/// Throws std::runtime_error when another program has the lock, after waiting for a second, or when the file
/// cannot be written.
averaging::FileLock lock_case(const std::filesystem::path& folder, const std::string& program);

}  // namespace millfoam::record
