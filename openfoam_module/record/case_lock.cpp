// SPDX-License-Identifier: GPL-3.0-or-later
#include "openfoam_module/record/case_lock.hpp"

#include <unistd.h>

#include <fstream>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace millfoam::record {

namespace {

/// What the program that has the lock wrote into its file: its name and process.
std::string holder(const std::filesystem::path& file) {
  std::string text;
  std::getline(std::ifstream(file), text);
  return text.empty() ? "another program" : text;
}

}  // namespace

averaging::FileLock lock_case(const std::filesystem::path& folder, const std::string& program) {
  const std::filesystem::path file = folder / "postProcessing" / "flow" / ".lock";
  std::error_code failed;  // take() reports the failure
  if (std::filesystem::is_directory(folder)) std::filesystem::create_directories(file.parent_path(), failed);
  // A run that was just killed may still be ending
  if (auto lock = averaging::FileLock::take({file, std::chrono::seconds(1)})) {
    lock->sign(program + " (process " + std::to_string(getpid()) + ")");
    return std::move(*lock);
  }
  throw std::runtime_error(folder.string() + ": " + holder(file) +
                           " works in this case, expected one flow at a time." +
                           " Wait for its end, or copy the case");
}

}  // namespace millfoam::record
