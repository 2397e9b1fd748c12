// SPDX-License-Identifier: GPL-3.0-or-later
#include "openfoam_module/record/case_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <array>
#include <stdexcept>
#include <system_error>

namespace millfoam::record {

namespace {

constexpr int longest_wait = 10;  // tenths of a second: a run that was just killed may still be ending

/// What the program that has the lock wrote into its file: its name and process.
std::string holder(int file) {
  std::array<char, 128> text{};
  const ssize_t size = pread(file, text.data(), text.size(), 0);
  return size > 0 ? std::string(text.data(), static_cast<std::size_t>(size)) : "another program";
}

void sign(int file, const std::string& program) {
  const std::string text = program + " (process " + std::to_string(getpid()) + ")";
  const bool is_signed = ftruncate(file, 0) == 0 && pwrite(file, text.data(), text.size(), 0) >= 0;
  static_cast<void>(is_signed);  // only a name for messages: the lock holds without it
}

}  // namespace

CaseLock::CaseLock(const std::filesystem::path& folder, const std::string& program) {
  const std::filesystem::path path = folder / "postProcessing" / "flow" / ".lock";
  std::error_code failed;  // open() below reports the failure
  if (std::filesystem::is_directory(folder)) std::filesystem::create_directories(path.parent_path(), failed);
  file_ = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (file_ < 0) throw std::runtime_error(path.string() + ": cannot be written");
  for (int tenth = 0; flock(file_, LOCK_EX | LOCK_NB) != 0; ++tenth) {
    if (tenth == longest_wait) {
      const std::string other = holder(file_);
      close(file_);
      throw std::runtime_error(folder.string() + ": " + other +
                               " works in this case, expected one flow at a time." +
                               " Wait for its end, or copy the case");
    }
    usleep(100000);
  }
  sign(file_, program);
}

CaseLock::~CaseLock() {
  close(file_);
}

}  // namespace millfoam::record
