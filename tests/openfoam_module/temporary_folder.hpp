// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

/// A folder that goes when the test is over.
struct TemporaryFolder {
  std::filesystem::path path = make();

  TemporaryFolder() = default;
  ~TemporaryFolder() { std::filesystem::remove_all(path); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  static std::filesystem::path make() {
    std::string name = (std::filesystem::temp_directory_path() / "millfoam_XXXXXX").string();
    return mkdtemp(name.data());
  }
};

inline std::string text_of(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}
