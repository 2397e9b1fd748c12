// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/dumps/whole_gzip.hpp"

#ifdef MILLFOAM_LIBDEFLATE
#include <libdeflate.h>

#include <cstdint>
#include <fstream>
#endif

namespace millfoam::averaging {

#ifdef MILLFOAM_LIBDEFLATE

namespace {

constexpr std::size_t most_text = std::size_t{1} << 30U;
constexpr std::size_t most_ratio = 1032;   // what deflate can reach at best
constexpr std::size_t shortest_file = 18;  // header and trailer of gzip

/// The length of the text, which is in the last four bytes.
std::size_t text_length(std::string_view gzip) {
  std::size_t length = 0;
  for (std::size_t byte = gzip.size(); byte-- > gzip.size() - 4;) {
    length = length << 8U | static_cast<unsigned char>(gzip[byte]);
  }
  return length;
}

}  // namespace

std::string_view WholeGzip::read_gzip(const std::filesystem::path& file) {
  std::ifstream input(file, std::ios::binary);
  char magic[2] = {};
  if (!input.read(magic, 2) || magic[0] != '\x1f' || magic[1] != '\x8b') return {};
  std::error_code unknown;
  const std::uintmax_t size = std::filesystem::file_size(file, unknown);
  if (unknown || size < shortest_file || size > most_text) return {};
  char* const bytes = gzip_.resize(static_cast<std::size_t>(size));
  input.seekg(0);
  if (!input.read(bytes, static_cast<std::streamsize>(size))) return {};
  return {bytes, static_cast<std::size_t>(size)};
}

std::optional<std::string_view> WholeGzip::inflate(const std::filesystem::path& file) {
  const std::string_view gzip = read_gzip(file);
  if (gzip.empty()) return std::nullopt;
  const std::size_t size = text_length(gzip);
  if (size > most_text || size / most_ratio > gzip.size()) return std::nullopt;

  const std::unique_ptr<libdeflate_decompressor, void (*)(libdeflate_decompressor*)> inflater(
      libdeflate_alloc_decompressor(), libdeflate_free_decompressor);
  if (!inflater) return std::nullopt;
  char* const text = text_.resize(size + 1);
  std::size_t read = 0, written = 0;
  const libdeflate_result result =
      libdeflate_gzip_decompress_ex(inflater.get(), gzip.data(), gzip.size(), text, size, &read, &written);
  if (result != LIBDEFLATE_SUCCESS || read != gzip.size() || written != size) return std::nullopt;
  return std::string_view(text, size);
}

#else

std::optional<std::string_view> WholeGzip::inflate(const std::filesystem::path& /*file*/) {
  return std::nullopt;
}

#endif

}  // namespace millfoam::averaging
