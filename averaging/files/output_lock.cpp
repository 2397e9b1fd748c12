// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/files/output_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "averaging/files/hdf5_file.hpp"
#include "averaging/files/solids_layout.hpp"

namespace millfoam::averaging {

void require_solids_or_nothing(const std::filesystem::path& path) {
  hdf5::naming_file<SolidsFileError>(path, [&] { hdf5::require_format_or_nothing(path, layout::format); });
}

OutputLock::OutputLock(const std::filesystem::path& output) : path_(output.string() + ".lock") {
  while (!try_lock()) {
    const int reason = errno;
    close(file_);
    if (reason != EWOULDBLOCK) continue;
    throw SolidsFileError(output.string() + ": another millAverage is writing this file (it holds " +
                          path_.string() + "): wait for it, or give another name");
  }
}

/// False, with errno, when another process has the lock, or has just removed the file that was locked here.
bool OutputLock::try_lock() {
  file_ = open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (file_ < 0) {
    throw SolidsFileError(path_.string() + ": cannot create the file (is the folder there and writable?): " +
                          std::generic_category().message(errno));
  }
  if (flock(file_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) return false;
  struct stat locked {};
  struct stat named {};
  errno = 0;
  return fstat(file_, &locked) == 0 && stat(path_.c_str(), &named) == 0 && locked.st_ino == named.st_ino;
}

OutputLock::~OutputLock() {
  if (file_ < 0) return;
  unlink(path_.c_str());
  close(file_);
}

OutputLock::OutputLock(OutputLock&& other) noexcept
    : path_(std::move(other.path_)), file_(std::exchange(other.file_, -1)) {}

}  // namespace millfoam::averaging
