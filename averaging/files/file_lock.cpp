// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/files/file_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>
#include <system_error>
#include <thread>
#include <utility>

namespace millfoam::averaging {

namespace {

enum class Attempt { locked, busy, removed };

/// Whether the error of flock is that the file system has no locks.
bool has_no_locks(int error) {
  return error == EOPNOTSUPP || error == ENOSYS || error == EINVAL;
}

int open_file(const LockRequest& request) {
  const int file = open(request.file.c_str(), O_RDWR | O_CREAT | (request.inherited ? 0 : O_CLOEXEC), 0666);
  if (file >= 0) return file;
  throw std::runtime_error(
      request.file.string() +
      ": cannot be written (is the folder there and writable?): " + std::generic_category().message(errno));
}

/// Whether an open file could be locked, and is still the one of its name: the process that had the lock may
/// just have removed it. Throws std::runtime_error where locking fails for another reason.
Attempt try_lock(int file, const std::filesystem::path& name) {
  const int error = flock(file, LOCK_EX | LOCK_NB) == 0 ? 0 : errno;
  if (error == EWOULDBLOCK || error == EINTR) return Attempt::busy;
  if (error != 0 && !has_no_locks(error))
    throw std::runtime_error(name.string() + ": cannot be locked: " + std::generic_category().message(error));
  struct stat locked {};
  struct stat named {};
  const bool is_named =
      fstat(file, &locked) == 0 && stat(name.c_str(), &named) == 0 && locked.st_ino == named.st_ino;
  return is_named ? Attempt::locked : Attempt::removed;
}

}  // namespace

std::optional<FileLock> FileLock::take(const LockRequest& request) {
  const auto end = std::chrono::steady_clock::now() + request.longest_wait;
  while (true) {
    // It has the file from the beginning, and closes it where locking throws
    std::optional<FileLock> lock = FileLock(open_file(request));
    const Attempt attempt = try_lock(lock->file_, request.file);
    if (attempt == Attempt::locked) {
      if (request.temporary) lock->removed_ = request.file;
      return lock;
    }
    lock.reset();
    if (attempt == Attempt::removed) continue;
    if (std::chrono::steady_clock::now() >= end) return std::nullopt;
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
}

FileLock::FileLock(int file) : file_(file) {}

FileLock::FileLock(FileLock&& other) noexcept
    : file_(std::exchange(other.file_, -1)), removed_(std::move(other.removed_)) {}

FileLock::~FileLock() {
  if (file_ < 0) return;
  if (!removed_.empty()) unlink(removed_.c_str());
  close(file_);
}

void FileLock::sign(const std::string& holder) const {
  const bool is_signed = ftruncate(file_, 0) == 0 && pwrite(file_, holder.data(), holder.size(), 0) >= 0;
  static_cast<void>(is_signed);
}

}  // namespace millfoam::averaging
