// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string_view>

namespace millfoam::averaging {

/// Decompresses gzip files by libdeflate, each in one go, about twice as fast as zlib does. It keeps its
/// memory, that of the largest file and its text, for the next file: fresh memory would cost a quarter of the
/// time.
class WholeGzip {
 public:
  /// The file's text, until the next call. Nothing for all that zlib should decide: a file that is not gzip,
  /// is damaged or made of several gzip streams, holds more than 1 GiB of text, or cannot be read; and always
  /// in a build without libdeflate.
  std::optional<std::string_view> inflate(const std::filesystem::path& file);

 private:
  /// Bytes that are not filled with anything.
  class Buffer {
   public:
    char* resize(std::size_t size) {
      if (size > capacity_) {
        bytes_.reset();
        bytes_.reset(new char[size]);
        capacity_ = size;
      }
      return bytes_.get();
    }

   private:
    std::unique_ptr<char[]> bytes_;
    std::size_t capacity_ = 0;
  };

  std::string_view read_gzip(const std::filesystem::path& file);

  Buffer gzip_;
  Buffer text_;
};

}  // namespace millfoam::averaging
