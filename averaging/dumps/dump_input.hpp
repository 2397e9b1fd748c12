// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "averaging/dumps/text_lines.hpp"

namespace millfoam::averaging {

/// A file, plain or gzip, that is read block by block: the text that is parsed is still in the cache, and
/// memory does not grow with the file.
class DumpInput {
 public:
  /// Throws DumpError when the file cannot be opened.
  /// @param file   plain or gzip
  /// @param block  bytes that are read at a time
  explicit DumpInput(const std::filesystem::path& file, std::size_t block = std::size_t{1} << 18U);
  ~DumpInput();
  DumpInput(const DumpInput&) = delete;
  DumpInput& operator=(const DumpInput&) = delete;

  /// The file's lines, which live as long as this object. Reading them throws DumpError for a file that
  /// cannot be read to its end, and for a line of more than 1 MiB.
  TextLines lines();

 private:
  struct File;

  std::string_view more(std::string_view rest);

  std::string name_;
  std::unique_ptr<File> file_;
  std::size_t block_;
  std::vector<char> buffer_;
};

}  // namespace millfoam::averaging
