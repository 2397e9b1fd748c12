// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/dumps/dump_input.hpp"

#include <zlib.h>

#include <cstring>

#include "averaging/dumps/dump_error.hpp"

namespace millfoam::averaging {

namespace {

constexpr std::size_t longest_line = std::size_t{1} << 20U;

}  // namespace

/// zlib reads plain and gzip alike, and straight into the caller's memory where that is larger than its own.
struct DumpInput::File {
  gzFile handle = nullptr;
};

DumpInput::DumpInput(const std::filesystem::path& file, std::size_t block)
    : name_(file.string()), file_(std::make_unique<File>()), block_(block) {
  file_->handle = gzopen(file.c_str(), "rb");
  if (file_->handle == nullptr) throw DumpError(name_ + ": cannot open this file");
  gzbuffer(file_->handle, 1U << 16U);
}

DumpInput::~DumpInput() {
  gzclose_r(file_->handle);
}

TextLines DumpInput::lines() {
  return TextLines([this](std::string_view rest) { return more(rest); }, name_);
}

std::string_view DumpInput::more(std::string_view rest) {
  if (rest.size() > longest_line) {
    throw DumpError(name_ + ": a line is longer than " + std::to_string(longest_line) +
                    " bytes, expected the text of a dump");
  }
  if (buffer_.size() < rest.size() + block_) {
    std::vector<char> larger(2 * rest.size() + block_);
    std::copy(rest.begin(), rest.end(), larger.begin());
    buffer_ = std::move(larger);
  } else {
    std::memmove(buffer_.data(), rest.data(), rest.size());
  }
  const int got = gzread(file_->handle, buffer_.data() + rest.size(), static_cast<unsigned>(block_));
  int status = Z_OK;
  const char* const reason = gzerror(file_->handle, &status);
  // A gzip stream that stops before its end gives its last bytes and only then, as Z_BUF_ERROR, the failure.
  if (got < 0 || status != Z_OK) {
    throw DumpError(name_ + ": cannot be read to its end (" + reason + "); the dump is truncated or damaged");
  }
  return {buffer_.data(), rest.size() + static_cast<std::size_t>(got)};
}

}  // namespace millfoam::averaging
