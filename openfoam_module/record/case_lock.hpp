// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

namespace millfoam::record {

/// While it lives, no other program may have a lock on the same case. The lock is the system's (flock), not
/// the file's existence: a file that a killed program leaves does not block.
class CaseLock {
 public:
  /// @param folder  of the case; its file postProcessing/flow/.lock is locked
  /// @param program  name of the program, for the message of another one that finds the case locked
  ///
  /// Throws std::runtime_error when another program has the lock, after waiting for a second, or when the
  /// file cannot be written.
  CaseLock(const std::filesystem::path& folder, const std::string& program);
  ~CaseLock();
  CaseLock(const CaseLock&) = delete;
  CaseLock& operator=(const CaseLock&) = delete;

 private:
  int file_ = -1;
};

}  // namespace millfoam::record
