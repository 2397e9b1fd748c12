// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string_view>

namespace millfoam::averaging {

/// A text that was decompressed in one go.
class WholeText {
 public:
  WholeText(std::unique_ptr<char[]> bytes, std::size_t size) : bytes_(std::move(bytes)), size_(size) {}
  std::string_view view() const { return {bytes_.get(), size_}; }

 private:
  std::unique_ptr<char[]> bytes_;  ///< not a string, which would be filled with zeros first
  std::size_t size_;
};

/// Decompresses a gzip file by libdeflate, about twice as fast as zlib does, where the build has it. Nothing
/// for all that zlib should decide: a file that is not gzip, is damaged or made of several gzip streams,
/// holds more than 1 GiB of text, or cannot be read; and always without libdeflate.
std::optional<WholeText> inflate_whole(const std::filesystem::path& file);

}  // namespace millfoam::averaging
