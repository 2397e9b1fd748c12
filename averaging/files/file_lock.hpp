// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>

namespace millfoam::averaging {

/// How a file is locked.
struct LockRequest {
  std::filesystem::path file;                 ///< made where it is missing, in a folder that is there
  std::chrono::milliseconds longest_wait{0};  ///< for another process that has the lock
  /// The lock lasts until the programs that this process starts meanwhile have ended.
  bool inherited = false;
  bool temporary = false;  ///< the file is removed with the lock
};

/// While it lives, no other process can lock the same file. The lock is the system's (flock(2)), not the
/// file's existence: the file of a process that was killed does not block. On a file system that has no locks
/// it has no effect.
class FileLock {
 public:
  /// The lock, or nothing while another process has it. Throws std::runtime_error naming the file when it
  /// cannot be written or locked.
  static std::optional<FileLock> take(const LockRequest& request);
  ~FileLock();
  /// Takes over the lock; `other` holds none any more.
  FileLock(FileLock&& other) noexcept;
  FileLock& operator=(FileLock&&) = delete;
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

  /// Replaces the text of the file by the name of the holder, which is only for messages of others: the lock
  /// holds, too, where it cannot be written.
  void sign(const std::string& holder) const;

 private:
  /// Takes over an open file, which it closes.
  explicit FileLock(int file);

  int file_ = -1;
  std::filesystem::path removed_;  ///< with the lock; empty for none
};

}  // namespace millfoam::averaging
