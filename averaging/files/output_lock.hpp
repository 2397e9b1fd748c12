// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

namespace millfoam::averaging {

/// Throws SolidsFileError when there is something at `path` that is no solids file, so that no other file is
/// lost to a name typed wrong. A solids file of any version, whole or not, may be replaced.
void require_solids_or_nothing(const std::filesystem::path& path);

/// While it lives, no other process can take the same lock: two runs cannot write one solids file. The file
/// `output` + ".lock" is only there meanwhile; that of a run that was killed does not block. On a file system
/// that has no locks (flock(2)) it has no effect.
class OutputLock {
 public:
  /// Throws SolidsFileError when another process holds the lock, or its file cannot be made.
  explicit OutputLock(const std::filesystem::path& output);
  ~OutputLock();
  /// Takes over the lock; `other` holds none any more.
  OutputLock(OutputLock&& other) noexcept;
  OutputLock& operator=(OutputLock&&) = delete;
  OutputLock(const OutputLock&) = delete;
  OutputLock& operator=(const OutputLock&) = delete;

 private:
  bool try_lock();

  std::filesystem::path path_;
  int file_ = -1;
};

}  // namespace millfoam::averaging
