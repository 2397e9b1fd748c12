// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace millfoam::dem_driver {

/// Where `program` is on PATH, or nothing.
std::optional<std::filesystem::path> find_on_path(const std::string& program);

/// The largest resident memory, in bytes, of a program that this one has waited for, or of those that such a
/// program started.
double largest_child_memory();

/// A program that runs at the same time as this one; its output is read line by line. It is started without
/// a shell, so that no character of an argument or a folder has a meaning. It writes to a pseudo-terminal,
/// because programs buffer their output when they write to a pipe. Its stdin is empty. Destroying a child
/// that still runs ends it.
class ChildProcess {
 public:
  /// Starts `arguments[0]` (a path) in folder `directory`, with `environment` ("NAME=value") added to this
  /// process's. Throws std::runtime_error when it cannot be started.
  ChildProcess(const std::vector<std::string>& arguments, const std::filesystem::path& directory,
               const std::vector<std::string>& environment);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Next line of stdout or stderr, without its end; nothing when the program has closed both.
  std::optional<std::string> read_line();

  /// Waits for the end. Returns the exit code, or 128 + the signal that ended the program.
  int wait();

 private:
  bool fill_buffer();

  pid_t pid_ = -1;
  int terminal_ = -1;
  std::string buffer_;
};

}  // namespace millfoam::dem_driver
